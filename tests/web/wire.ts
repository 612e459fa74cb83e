/** What a page may send: every type is one of the published API. */
export type { ClientMessage } from "@/api/wire";
