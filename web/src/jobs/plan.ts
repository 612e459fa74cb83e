/** From what stands on the clock of a plan to the dates of a job. */
import type { JobRequest } from "@/api/wire";

/** What somebody has entered; null where the choice is open. */
export interface Plan {
  readonly vehicle_id: string;
  /** "HH:MM" by the reader's clock. */
  readonly begin: string | null;
  readonly ready: string | null;
  readonly energy_kwh: number | null;
}

/** The next time that a clock shows "HH:MM" after a date, by the reader's own time zone. */
export function nextTime(clock: string, after: Date): Date {
  const [hours = 0, minutes = 0] = clock.split(":").map(Number);
  const date = new Date(after);
  date.setHours(hours, minutes, 0, 0);
  if (date <= after) date.setDate(date.getDate() + 1);
  return date;
}

/**
 * The job of a plan, reckoned from the robot's own date: the reader's clock may be wrong, and a
 * simulator's may run faster. Ready is after the beginning.
 */
export function jobOf(plan: Plan, now: Date): JobRequest {
  const begin = plan.begin === null ? null : nextTime(plan.begin, now);
  const ready = plan.ready === null ? null : nextTime(plan.ready, begin ?? now);
  return {
    type: "charge",
    vehicle_id: plan.vehicle_id,
    not_before: begin?.toISOString() ?? null,
    unplug_by: ready?.toISOString() ?? null,
    target_energy_wh: plan.energy_kwh === null ? null : plan.energy_kwh * 1000,
  };
}
