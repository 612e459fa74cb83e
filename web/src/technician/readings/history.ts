/** The last minute of the robot's measurements, for the plots. */
import type { Robot } from "@/api/wire";
import { append, noPast } from "./past";
import type { Past } from "./past";
import { followingError } from "./values";

export const SPAN_S = 60;

const CURVES = ["rho1", "rho2", "rho3", "error1", "error2", "error3", "force"] as const;
export type Curve = (typeof CURVES)[number];
export type Columns = Past<Curve>;

export const empty = (): Columns => noPast(CURVES);

/** Adds a state; one that is not newer changes nothing. */
export function record(columns: Columns, robot: Robot): boolean {
  const joints = robot.measured?.joints;
  return append(
    columns,
    Date.parse(robot.updated_at) / 1000,
    {
      rho1: joints?.rho1_mm ?? null,
      rho2: joints?.rho2_mm ?? null,
      rho3: joints?.rho3_mm ?? null,
      error1: followingError(robot, "rho1"),
      error2: followingError(robot, "rho2"),
      error3: followingError(robot, "rho3"),
      force: robot.measured?.force_n ?? null,
    },
    SPAN_S,
  );
}
