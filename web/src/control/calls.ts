/** Calls about control: asking for it, giving it, keeping it. */
import { call } from "@/api/client";
import type { Control } from "@/api/wire";

const ROOT = "/robot/control";

export const askForControl = (): Promise<Control> => call(`${ROOT}/request`, { method: "POST" });
export const withdrawRequest = (): Promise<Control> =>
  call(`${ROOT}/request`, { method: "DELETE" });
export const giveControlBack = (): Promise<Control> => call(ROOT, { method: "DELETE" });
export const answerRequest = (requestId: string, give: boolean): Promise<Control> =>
  call(`${ROOT}/answer`, { method: "POST", body: { request_id: requestId, give } });
