/** The newest frames, never more than fit, and which of them somebody wants to see. */
import type { ProtocolFrame } from "@/api/wire";

export const KEPT = 4000;

/** What passes all the time and says little. */
const ROUTINE: ReadonlySet<string> = new Set(["Heartbeat", "Clock", "ClockReply", "Ack", "Telemetry"]);

export interface Filter {
  readonly direction: "both" | ProtocolFrame["direction"];
  /** "all", "worth" for all but the routine, or the name of a kind. */
  readonly kind: string;
  readonly errorsOnly: boolean;
  readonly search: string;
}

export const WORTH_SEEING: Filter = { direction: "both", kind: "worth", errorsOnly: false, search: "" };

/** The frames before with new ones after them; the oldest are forgotten. */
export function grown(frames: readonly ProtocolFrame[], more: readonly ProtocolFrame[]): readonly ProtocolFrame[] {
  if (more.length === 0) return frames;
  return [...frames, ...more].slice(-KEPT);
}

export function matches(frame: ProtocolFrame, { direction, kind, errorsOnly, search }: Filter): boolean {
  if (direction !== "both" && frame.direction !== direction) return false;
  if (errorsOnly && !frame.error) return false;
  if (kind === "worth" ? ROUTINE.has(frame.kind) && !frame.error : kind !== "all" && frame.kind !== kind) return false;
  const wanted = search.trim().toLowerCase();
  return wanted === "" || `${frame.kind} ${frame.words}`.toLowerCase().includes(wanted);
}

/** One frame in a line of text. */
export function lineOf({ at, direction, kind, size_bytes, words }: ProtocolFrame): string {
  const arrow = direction === "to_board" ? "->" : "<-";
  const size = size_bytes === null ? "" : ` ${String(size_bytes)} B`;
  return `${at} ${arrow} ${kind}${size} ${words}`;
}

/** The time of day to the millisecond, as it stands in the list. */
export const timeOf = (at: string): string => {
  const date = new Date(at);
  const two = (value: number): string => String(value).padStart(2, "0");
  const seconds = `${two(date.getSeconds())}.${String(date.getMilliseconds()).padStart(3, "0")}`;
  return `${two(date.getHours())}:${two(date.getMinutes())}:${seconds}`;
};
