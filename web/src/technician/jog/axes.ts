/** The ways the robot can be jogged, and what stands on their buttons. */
import type { JogAxis } from "@/api/wire";

export type Frame = "base" | "joints";
export type Direction = -1 | 1;

/** One way to move: an axis and a sense. */
export interface Way {
  readonly axis: JogAxis;
  readonly direction: Direction;
}

export const FRAMES: Readonly<Record<Frame, readonly JogAxis[]>> = {
  base: ["x", "y", "insertion"],
  joints: ["rho1", "rho2", "rho3"],
};

/** The keys that stand for a way while the pad has the focus. */
export const KEYS: Readonly<Record<string, { readonly column: 0 | 1 | 2; readonly direction: Direction }>> = {
  ArrowLeft: { column: 0, direction: -1 },
  ArrowRight: { column: 0, direction: 1 },
  ArrowDown: { column: 1, direction: -1 },
  ArrowUp: { column: 1, direction: 1 },
  PageDown: { column: 2, direction: -1 },
  PageUp: { column: 2, direction: 1 },
};

/** The way of a key in a frame; null for any other key. */
export function wayOfKey(key: string, frame: Frame): Way | null {
  const found = KEYS[key];
  if (found === undefined) return null;
  return { axis: FRAMES[frame][found.column]!, direction: found.direction };
}

export const sameWay = (a: Way | null, b: Way | null): boolean =>
  a?.axis === b?.axis && a?.direction === b?.direction;
