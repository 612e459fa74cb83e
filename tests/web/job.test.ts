import { describe, expect, test } from "vitest";
import { formatDuration, formatEnergy, formatPower } from "@/format";
import { isActive, phaseElapsedS, stepsOf } from "@/robot/job";
import type { ActiveJob } from "@/robot/job";
import type { Job } from "@/api/wire";
import { PHASES, TYPES, at, job, live, robot } from "./states";

function steps(changes: Partial<Job>): string {
  const each = job(changes);
  if (!isActive(each)) throw new Error("the test needs a running job");
  return stepsOf(each satisfies ActiveJob)
    .map((step) => `${step.phase}:${step.state}`)
    .join(" ");
}

describe("the steps of a job", () => {
  test("count what is done", () => {
    expect(steps({ type: "plug_in", phase: "inserting" })).toBe(
      "locating:done aligning:done inserting:now plugged:open",
    );
  });

  test("are all open while the robot gets ready", () => {
    expect(steps({ phase: "preflight" })).not.toMatch(/done|now/);
  });

  test("count waiting for the current as charging", () => {
    expect(steps({ phase: "plugged" })).toContain("inserting:done charging:now releasing:open");
  });

  test("count the charge as done when the robot comes back from it", () => {
    expect(steps({ phase: "withdrawing", result: { plugged_after_s: 21 } })).toContain(
      "charging:done releasing:done withdrawing:now parking:open",
    );
  });

  test("never claim a charge that did not happen", () => {
    expect(steps({ phase: "parking", cancel_requested: true })).toBe("parking:now");
    expect(steps({ type: "plug_in", phase: "releasing", result: { plugged_after_s: 21 } })).toBe(
      "releasing:now withdrawing:open parking:open",
    );
  });

  test.each(TYPES)("of %s have one current step at most, in every phase", (type) => {
    for (const phase of PHASES) {
      expect(steps({ type, phase }).match(/now/g)?.length ?? 0).toBeLessThanOrEqual(1);
    }
  });
});

test("the time of a phase is the server's, not the reader's", () => {
  const running = job({ phase_started_at: at(0), updated_at: at(1) });
  expect(phaseElapsedS(live({ robot: robot({ updated_at: at(12) }), job: running }))).toBe(12);
  expect(phaseElapsedS(live({ robot: robot({ updated_at: at(-5) }), job: running }))).toBe(1);
});

test("figures are short and keep their unit", () => {
  expect([0, 59.9, 60, 187, 3725].map(formatDuration)).toEqual([
    "0\u00a0s",
    "59\u00a0s",
    "1:00",
    "3:07",
    "1\u00a0h\u00a002",
  ]);
  expect([0, 999, 1000, 15_340].map(formatEnergy)).toEqual([
    "0\u00a0Wh",
    "999\u00a0Wh",
    "1.0\u00a0kWh",
    "15.3\u00a0kWh",
  ]);
  expect(formatPower(10_980)).toBe("11.0\u00a0kW");
});
