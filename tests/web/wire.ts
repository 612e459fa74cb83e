/** What a page may send: every type is one of the published API. */
import type { components } from "../../web/src/api/schema";

type Schemas = components["schemas"];

export type ClientMessage =
  | Schemas["StopMessage"]
  | Schemas["EmergencyStopMessage"]
  | Schemas["ResyncMessage"];
