/** The force over the way of the slide, from the last minute's samples. */
import type { Columns } from "./history";

/** Samples nearer together than this are one place. */
export const PLACE_MM = 0.5;
/** What moves less between two samples stands, as far as its encoder can tell. */
const STANDS_MM = 0.02;

/** One point for each place, the places in order. */
export interface ForceOverWay {
  readonly way_mm: readonly number[];
  /** Largest force on the way out, to the car; null where it was not passed that way. */
  readonly out_n: readonly (number | null)[];
  /** Largest pull on the way back. */
  readonly back_n: readonly (number | null)[];
}

/** What force the slide met where. Of several strokes the largest counts. */
export function forceOverWay({ rho3, force }: Columns): ForceOverWay {
  const out = new Map<number, number>();
  const back = new Map<number, number>();
  let before: number | null = null;
  rho3.forEach((way, sample) => {
    const met = force[sample] ?? null;
    const moved = way === null || before === null ? 0 : way - before;
    before = way;
    if (way === null || met === null || Math.abs(moved) < STANDS_MM) return;
    const place = Math.round(way / PLACE_MM);
    const [passed, larger] = moved > 0 ? [out, Math.max] as const : [back, Math.min] as const;
    passed.set(place, larger(passed.get(place) ?? met, met));
  });
  const places = [...new Set([...out.keys(), ...back.keys()])].sort((one, other) => one - other);
  return {
    way_mm: places.map((place) => place * PLACE_MM),
    out_n: places.map((place) => out.get(place) ?? null),
    back_n: places.map((place) => back.get(place) ?? null),
  };
}
