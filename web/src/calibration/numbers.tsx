import { formatNumber } from "@/format";
import type { Calibration, CalibrationDetail, Figure } from "./types";
import { say } from "./words";

type Name = keyof typeof say.numbers.names;

const DEGREES = 180 / Math.PI;
/** Where the standard deviation stands; the skew of both rails is solved for as one angle between them. */
const SIGMA_OF: Partial<Record<Name, string>> = {
  left_rail_rad: "half_skew_rad",
  right_rail_rad: "half_skew_rad",
  left_spread_mm: "left_sigma_mm",
  right_spread_mm: "right_sigma_mm",
  left_mm: "left_sigma_mm",
  right_mm: "right_sigma_mm",
  friction_n: "friction_sigma_n",
  offset_n: "offset_sigma_n",
  scale: "scale_sigma",
};

/** What a routine calls its figures, as far as they are numbers of the version. */
const NAME_OF: Readonly<Record<string, Name>> = {
  left_leg_mm: "left_leg_mm",
  right_leg_mm: "right_leg_mm",
  left_scale: "left_scale",
  right_scale: "right_scale",
  socket_x_mm: "x_mm",
  socket_y_mm: "y_mm",
  socket_z_mm: "z_mm",
  switch_left_mm: "left_spread_mm",
  switch_right_mm: "right_spread_mm",
  play_left_mm: "left_mm",
  play_right_mm: "right_mm",
  lag_left_mm: "left_following_mm",
  lag_right_mm: "right_following_mm",
  friction_n: "friction_n",
  offset_n: "offset_n",
  lag_slide_mm: "following_mm",
  force_scale: "scale",
  fx: "fx",
  cx: "cx",
  cy: "cy",
};
/** Of these there is nothing else to be seen. */
const MEASURED: readonly string[] = ["switches", "play", "force"];
/** These stand in the drawing of before and after. */
const DRAWN = ["error", "error_in_use"];

/** What a routine has found, at one glance; a figure that is not known stays as the server calls it. */
export function Figures({ figures }: { figures: readonly Figure[] }) {
  const listed = figures.filter(({ code }) => !DRAWN.includes(code));
  if (listed.length === 0) return null;
  return (
    <dl class="list calibration-figures">
      {listed.map(({ code, label, value, sigma, unit }) => {
        const name = NAME_OF[code];
        return (
          <div key={code}>
            <dt>{name === undefined ? label : say.numbers.names[name]}</dt>
            <dd>{name === undefined ? written(value, sigma, [1, 2, unit]) : shown(name, value, sigma)}</dd>
          </div>
        );
      })}
    </dl>
  );
}

/** Every number of a version, with its standard deviation where that is known. */
export function Numbers({ version, folded }: { version: CalibrationDetail; folded: boolean }) {
  const beside = Object.entries(version.values).filter(([name]) => name.includes("sigma"));
  const sigma: Record<string, unknown> = {
    ...version.evidence?.sigma,
    ...version.camera_evidence?.sigma,
    ...Object.fromEntries(beside),
  };
  return (
    <details class="calibration-numbers" open={!folded && MEASURED.includes(version.kind)}>
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
  else if (values.kind === "camera") Object.assign(all, values.camera);
  else {
    Object.assign(all, values);
    if (values.kind === "force" && values.scale_sigma === null) delete all["scale"]; // not measured
  }
  return (Object.entries(all) as [Name, number][]).filter(([name]) => name in say.numbers.names);
}

/** Lengths in millimetres, angles in degrees, belts as what a hundred commanded millimetres are. */
const shown = (name: Name, value: number, sigma: unknown): string => written(value, sigma, unitOf(name));

function written(value: number, sigma: unknown, [factor, digits, unit]: Shape): string {
  const text = formatNumber(value * factor, digits);
  return `${text}${typeof sigma === "number" ? ` ± ${formatNumber(sigma * factor, digits)}` : ""} ${unit}`.trimEnd();
}

type Shape = readonly [factor: number, digits: number, unit: string];

function unitOf(name: Name): Shape {
  if (name.endsWith("_n")) return [1, 1, "N"];
  if (name === "scale") return [1, 3, ""];
  if (name === "approaches") return [1, 0, ""];
  if (name.endsWith("_rad")) return [DEGREES, 3, "°"];
  if (name.endsWith("_mm")) return [1, 2, "mm"];
  return name.endsWith("_scale") ? [100, 3, "%"] : [1, 1, "px"];
}
