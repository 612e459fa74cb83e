import { describe, expect, test } from "vitest";
import { forceOverWay, PLACE_MM } from "@/technician/readings/force-way";
import { empty } from "@/technician/readings/history";
import type { Columns } from "@/technician/readings/history";

/** A stroke as telemetry would bring it: place by place, with the force that was met there. */
function passed(...samples: readonly (readonly [number | null, number | null])[]): Columns {
  const columns = empty();
  for (const [way_mm, force_n] of samples) {
    columns.rho3.push(way_mm);
    columns.force.push(force_n);
  }
  return columns;
}

describe("the force over the way", () => {
  test("is the largest push on the way out, the largest pull on the way back", () => {
    const found = forceOverWay(passed([9, 0], [10, 4], [10.1, 6], [11, 30], [10, -12], [10.1, 7], [9, -8]));
    expect(found.way_mm).toEqual([9, 10, 11]);
    expect(found.out_n).toEqual([null, 7, 30]);
    expect(found.back_n).toEqual([-8, -12, null]);
  });

  test("leaves out where the slide stands, and what was not measured", () => {
    const found = forceOverWay(passed([10, 0], [10.005, 50], [null, null], [20, 9], [20.5, null], [21, 3]));
    expect(found.way_mm).toEqual([21]);
    expect(found.out_n).toEqual([3]);
  });

  test("has its places in order, so that a curve can be drawn", () => {
    const samples = Array.from({ length: 200 }, (_, sample) => [80 - sample * 0.37, sample] as const);
    const { way_mm } = forceOverWay(passed(...samples));
    expect(way_mm.length).toBeGreaterThan(100);
    way_mm.slice(1).forEach((way, index) => expect(way - way_mm[index]!).toBeGreaterThanOrEqual(PLACE_MM));
  });
});
