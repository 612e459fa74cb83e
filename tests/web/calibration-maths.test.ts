import { describe, expect, test } from "vitest";
import openapi from "../../web/openapi.json";
import { leftOver, platformAt } from "@/calibration/mechanism";
import { secondsLeft } from "@/calibration/pace";
import { enlargement, planeAround } from "@/calibration/plots/plane";
import { numberIn, requestOf } from "@/calibration/request";
import { GROUPS, ROUTINES } from "@/calibration/routines";
import type { CalibrationDetail } from "@/calibration/types";

const VERSION = openapi.paths["/api/v1/calibrations/{calibration_id}"].get.responses["200"].content["application/json"]
  .example as unknown as CalibrationDetail;

describe("the routines", () => {
  test("are all there, in groups that keep their order", () => {
    expect(Object.values(GROUPS).flat()).toEqual(Object.keys(ROUTINES));
    expect([...Object.keys(ROUTINES)].sort()).toEqual([...openapi.components.schemas.Routine.properties.kind.enum].sort());
  });
});

describe("the mechanism", () => {
  const { values } = VERSION;
  if (values.kind !== "robot") throw new Error("the example is no robot");

  test("stands where the server has it", () => {
    // Both from twin.as_built.PlanarAsBuilt.forward and cv2.Rodrigues with the same numbers.
    const place = platformAt(
      {
        left_leg_mm: 533.21, right_leg_mm: 530.87, left_foot_x_mm: 55, left_foot_y_mm: 0,
        right_foot_x_mm: 1246.42, right_foot_y_mm: -1.13, left_rail_rad: 0.0021, right_rail_rad: -0.0021,
        left_scale: 1.0024, right_scale: 0.9981,
      },
      { rho1_mm: 212.4, rho2_mm: 180.9 },
    );
    expect(place?.x_mm).toBeCloseTo(668.9753, 3);
    expect(place?.y_mm).toBeCloseTo(351.8144, 3);
    const left = leftOver({ residual_mm: [0.011, -0.004, 0.052] }, [0.013, -0.021, 3.127]);
    expect(left.x_mm).toBeCloseTo(-0.010513, 6);
    expect(left.y_mm).toBeCloseTo(0.003457, 6);
  });

  test("whose legs do not reach each other stands nowhere", () => {
    expect(platformAt({ ...values.mechanism, left_leg_mm: 10 }, { rho1_mm: 0, rho2_mm: 0 })).toBeNull();
  });
});

describe("drawings", () => {
  test("keep all places inside, up above down", () => {
    const places = [{ x_mm: 500, y_mm: 100 }, { x_mm: 900, y_mm: 100 }, { x_mm: 700, y_mm: 400 }];
    const plane = planeAround(places);
    for (const place of places) {
      const [x, y] = plane.at(place);
      expect(x).toBeGreaterThan(0);
      expect(x).toBeLessThan(plane.width);
      expect(y).toBeGreaterThan(0);
      expect(y).toBeLessThan(plane.height);
    }
    expect(plane.at(places[2]!)[1]).toBeLessThan(plane.at(places[0]!)[1]);
  });

  test("enlarge by 1, 2 or 5 and never beyond their room", () => {
    for (const longest of [0.0007, 0.013, 0.4, 3]) {
      const times = enlargement(longest, 20);
      expect(longest * times).toBeLessThanOrEqual(20);
      expect(longest * times).toBeGreaterThan(7.9);
      expect([1, 2, 5]).toContain(Number(times.toExponential()[0]));
    }
    expect(enlargement(0, 20)).toBe(1);
    expect(enlargement(50, 20)).toBe(1);
  });
});

test("the time left follows the pace that was seen", () => {
  const first = { done: 3, at_ms: 1000 };
  expect(secondsLeft(10, first, first, 6)).toBe(60);
  expect(secondsLeft(10, first, { done: 7, at_ms: 9000 }, 6)).toBe(20);
});

test("numbers are read with the comma of the reader's country", () => {
  expect(numberIn(" 300,7 ")).toBe(300.7);
  expect(numberIn("300.7")).toBe(300.7);
  for (const text of ["", " ", "1,2,3", "abc"]) expect(numberIn(text)).toBeNull();
});

test("a whole number has no fraction, and an empty optional one is left out", () => {
  expect(requestOf("check", ROUTINES.check, { approaches: "3.5" }, null).wrong).toEqual({ approaches: "noNumber" });
  expect(requestOf("check", ROUTINES.check, { approaches: "" }, null)).toEqual({ body: { kind: "check" }, wrong: {} });
});
