import { formatNumber } from "@/format";
import type { Calibration, CalibrationDetail } from "./types";
import { say } from "./words";

type Name = keyof typeof say.numbers.names;

const DEGREES = 180 / Math.PI;
/** The skew of both rails is solved for as one angle between them. */
const SIGMA_OF: Partial<Record<Name, string>> = { left_rail_rad: "half_skew_rad", right_rail_rad: "half_skew_rad" };

/** Every number of a version, with its standard deviation where that is known. */
export function Numbers({ version }: { version: CalibrationDetail }) {
  const sigma = version.evidence?.sigma ?? {};
  return (
    <details class="calibration-numbers">
      <summary>{say.numbers.title}</summary>
      <dl class="list">
        {numbersOf(version).map(([name, value]) => (
          <div key={name}>
            <dt>{say.numbers.names[name]}</dt>
            <dd>{shown(name, value, sigma[SIGMA_OF[name] ?? name])}</dd>
          </div>
        ))}
      </dl>
    </details>
  );
}

function numbersOf({ values }: Calibration): [Name, number][] {
  const all: Record<string, number> = {};
  if (values.kind === "robot") {
    const [camera_x_rad, camera_y_rad, camera_z_rad] = values.camera_rotation_rad;
    Object.assign(all, values.mechanism, { camera_x_rad, camera_y_rad, camera_z_rad });
  } else if (values.kind === "socket") Object.assign(all, values.socket);
  else Object.assign(all, values.camera);
  return (Object.entries(all) as [Name, number][]).filter(([name]) => name in say.numbers.names);
}

/** Lengths in millimetres, angles in degrees, belts as what a hundred commanded millimetres are. */
function shown(name: Name, value: number, sigma: number | undefined): string {
  const [factor, digits, unit] = unitOf(name);
  const text = formatNumber(value * factor, digits);
  return `${text}${sigma === undefined ? "" : ` ± ${formatNumber(sigma * factor, digits)}`} ${unit}`;
}

function unitOf(name: Name): [factor: number, digits: number, unit: string] {
  if (name.endsWith("_rad")) return [DEGREES, 3, "°"];
  if (name.endsWith("_mm")) return [1, 2, "mm"];
  return name.endsWith("_scale") ? [100, 3, "%"] : [1, 1, "px"];
}
