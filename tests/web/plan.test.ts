import { describe, expect, test } from "vitest";
import { jobOf, nextTime } from "@/jobs/plan";

const EVENING = new Date(2026, 2, 1, 18, 4, 5);
const OPEN = { vehicle_id: "zoe", begin: null, ready: null, energy_kwh: null };

describe("the next time on the clock", () => {
  test("is today while it is to come, tomorrow when it is past", () => {
    expect(nextTime("22:00", EVENING)).toEqual(new Date(2026, 2, 1, 22, 0));
    expect(nextTime("07:00", EVENING)).toEqual(new Date(2026, 2, 2, 7, 0));
    expect(nextTime("18:04", EVENING)).toEqual(new Date(2026, 2, 2, 18, 4));
  });
});

describe("a plan", () => {
  test("that leaves all open is a plain charge", () => {
    expect(jobOf(OPEN, EVENING)).toEqual({
      type: "charge",
      vehicle_id: "zoe",
      not_before: null,
      unplug_by: null,
      target_energy_wh: null,
    });
  });

  test("is ready after it began, on the next day if need be", () => {
    const job = jobOf({ ...OPEN, begin: "22:00", ready: "21:00", energy_kwh: 12.5 }, EVENING);
    expect(job.not_before).toBe(new Date(2026, 2, 1, 22, 0).toISOString());
    expect(job.unplug_by).toBe(new Date(2026, 2, 2, 21, 0).toISOString());
    expect(job.target_energy_wh).toBe(12_500);
  });
});
