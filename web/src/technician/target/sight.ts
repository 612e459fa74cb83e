/** From a click in the 3D picture to a place in the base frame. */

/** A line of sight in the base frame, as the frame of the 3D picture tells it. */
export interface Sight {
  readonly origin_mm: readonly [number, number, number];
  readonly direction: readonly [number, number, number];
}

export interface Place {
  readonly x_mm: number;
  readonly y_mm: number;
}

/** Nearly along the wall a click says nothing about a place. */
const LEAST_SLOPE = 0.05;
const TENTH = 10;

/** Reads a message of the frame; null if it is about something else. */
export function sightIn(data: unknown): Sight | null {
  if (typeof data !== "object" || data === null) return null;
  const { twin, origin_mm, direction } = data as Record<string, unknown>;
  if (twin !== "picked" || !isTriple(origin_mm) || !isTriple(direction)) return null;
  return { origin_mm, direction };
}

/** Where a line of sight meets the plane of the plug's tip; null if it does not, or too flatly. */
export function placeAt({ origin_mm, direction }: Sight, tipZ_mm: number): Place | null {
  const [dx, dy, dz] = direction;
  if (Math.abs(dz) < LEAST_SLOPE) return null;
  const along = (tipZ_mm - origin_mm[2]) / dz;
  if (along <= 0) return null;
  const round = (value: number): number => Math.round(value * TENTH) / TENTH;
  return { x_mm: round(origin_mm[0] + along * dx), y_mm: round(origin_mm[1] + along * dy) };
}

function isTriple(value: unknown): value is [number, number, number] {
  return Array.isArray(value) && value.length === 3 && value.every((each) => Number.isFinite(each));
}
