/** Where a look was taken, and which way it is off, by the numbers of a calibration. */
import type { Look, Mechanism, Place, RobotValues } from "./types";

/**
 * Where the platform stands: the legs meet on the car's side of the line through the two feet.
 * Null where they do not reach each other.
 */
export function platformAt(built: Mechanism, { rho1_mm, rho2_mm }: Pick<Look, "rho1_mm" | "rho2_mm">): Place | null {
  const { left_rail_rad = 0, right_rail_rad = 0, left_scale = 1, right_scale = 1 } = built;
  const left_mm = left_scale * rho1_mm;
  const right_mm = right_scale * rho2_mm;
  const x1 = built.left_foot_x_mm + left_mm * Math.cos(left_rail_rad);
  const y1 = built.left_foot_y_mm + left_mm * Math.sin(left_rail_rad);
  const dx = built.right_foot_x_mm - right_mm * Math.cos(right_rail_rad) - x1;
  const dy = built.right_foot_y_mm - right_mm * Math.sin(right_rail_rad) - y1;
  const apart2 = dx * dx + dy * dy;
  const along = 0.5 + (0.5 * (built.left_leg_mm ** 2 - built.right_leg_mm ** 2)) / apart2;
  const rise2 = built.left_leg_mm ** 2 / apart2 - along * along;
  if (!(rise2 >= 0)) return null;
  const rise = Math.sqrt(rise2);
  return { x_mm: x1 + along * dx - rise * dy, y_mm: y1 + along * dy + rise * dx };
}

/** What is left over of a look, turned from the camera frame to the base frame [mm]. */
export function leftOver({ residual_mm }: Pick<Look, "residual_mm">, turn: RobotValues["camera_rotation_rad"]): Place {
  const [x, y] = turned(residual_mm, turn);
  return { x_mm: x, y_mm: y };
}

type Vector = readonly [number, number, number];

/** A vector turned by a rotation vector [rad] (Rodrigues). */
export function turned(v: readonly number[], by: readonly number[]): Vector {
  const [x = 0, y = 0, z = 0] = v;
  const angle = Math.hypot(...by);
  if (angle === 0) return [x, y, z];
  const [kx = 0, ky = 0, kz = 0] = by.map((each) => each / angle);
  const dot = kx * x + ky * y + kz * z;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const part = (own: number, cross: number, axis: number): number => own * cos + cross * sin + axis * dot * (1 - cos);
  return [part(x, ky * z - kz * y, kx), part(y, kz * x - kx * z, ky), part(z, kx * y - ky * x, kz)];
}
