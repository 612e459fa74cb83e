/** The last minute of the robot's measurements, for the plots. */
import type { Robot } from "@/api/wire";
import { followingError } from "./values";

export const SPAN_S = 60;
const MOST = 1500;

/** One column of numbers for each curve; null where nothing was measured. */
export interface Columns {
  readonly t_s: number[];
  readonly rho1: (number | null)[];
  readonly rho2: (number | null)[];
  readonly rho3: (number | null)[];
  readonly error1: (number | null)[];
  readonly error2: (number | null)[];
  readonly error3: (number | null)[];
  readonly force: (number | null)[];
}

export const empty = (): Columns => ({
  t_s: [],
  rho1: [],
  rho2: [],
  rho3: [],
  error1: [],
  error2: [],
  error3: [],
  force: [],
});

/**
 * Adds a state, by the time of its own measurement; one that is not newer changes nothing, and
 * what is older than the span is forgotten. A clock that went back begins anew.
 */
export function record(columns: Columns, robot: Robot): boolean {
  const t_s = Date.parse(robot.updated_at) / 1000;
  const last_s = columns.t_s.at(-1) ?? -Infinity;
  if (t_s === last_s) return false;
  if (t_s < last_s) for (const column of Object.values(columns) as unknown[][]) column.length = 0;
  const joints = robot.measured?.joints;
  columns.t_s.push(t_s);
  columns.rho1.push(joints?.rho1_mm ?? null);
  columns.rho2.push(joints?.rho2_mm ?? null);
  columns.rho3.push(joints?.rho3_mm ?? null);
  columns.error1.push(followingError(robot, "rho1"));
  columns.error2.push(followingError(robot, "rho2"));
  columns.error3.push(followingError(robot, "rho3"));
  columns.force.push(robot.measured?.force_n ?? null);
  let old = columns.t_s.findIndex((each) => each >= t_s - SPAN_S);
  old = Math.max(old, columns.t_s.length - MOST);
  if (old > 0) for (const column of Object.values(columns) as unknown[][]) column.splice(0, old);
  return true;
}
