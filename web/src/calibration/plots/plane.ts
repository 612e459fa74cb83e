/** Places in front of the wall as a drawing, one millimetre as long across as up. */
import type { Place } from "../types";

/** A drawing of places; y goes up in the world and down on the screen. */
export interface Plane {
  readonly width: number;
  readonly height: number;
  /** Length of one millimetre in the drawing. */
  readonly scale: number;
  readonly at: (place: Place) => readonly [x: number, y: number];
}

const WIDTH = 320;
const MARGIN = 34;
const LEAST_HEIGHT = 120;

/** A drawing in which all places have room. */
export function planeAround(places: readonly Place[]): Plane {
  const [left, right] = ends(places.map(({ x_mm }) => x_mm));
  const [low, high] = ends(places.map(({ y_mm }) => y_mm));
  const inner = WIDTH - 2 * MARGIN;
  const scale = inner / Math.max(right - left, high - low, 1);
  const height = Math.max((high - low) * scale + 2 * MARGIN, LEAST_HEIGHT);
  const middle = { x: (left + right) / 2, y: (low + high) / 2 };
  return {
    width: WIDTH,
    height,
    scale,
    at: ({ x_mm, y_mm }) => [WIDTH / 2 + (x_mm - middle.x) * scale, height / 2 - (y_mm - middle.y) * scale],
  };
}

function ends(values: readonly number[]): [number, number] {
  return values.length === 0 ? [0, 1] : [Math.min(...values), Math.max(...values)];
}

/**
 * How many times larger small distances are drawn: 1, 2 or 5 times a power of ten.
 *
 * @param longest The longest of them [mm].
 * @param room How long that may become [mm].
 */
export function enlargement(longest: number, room: number): number {
  if (!(longest > 0 && room > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(room / longest));
  const step = [5, 2, 1].find((each) => each * power * longest <= room) ?? 1;
  return Math.max(step * power, 1);
}
