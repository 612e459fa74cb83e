import { useComputed } from "@preact/signals";
import type { Robot } from "@/api/wire";
import { formatNumber } from "@/format";
import { store } from "@/live/page";
import { say } from "../words";

const JOINTS = ["rho1", "rho2", "rho3"] as const;
/** Never a zero with a minus. */
const ROUNDED_TO_ZERO_MM = 0.005;
type Joint = (typeof JOINTS)[number];

/** Commanded and measured joints side by side, the plug tip and the force. */
export function Values() {
  const stale = store.stale.value || store.robotStale.value;
  return (
    <section class="card values" data-stale={stale}>
      <h2>{say.values.title}</h2>
      <table>
        <thead>
          <tr>
            <th scope="col">{say.values.joint}</th>
            <th scope="col">
              {say.values.commanded} <small>{say.values.unit}</small>
            </th>
            <th scope="col">
              {say.values.measured} <small>{say.values.unit}</small>
            </th>
            <th scope="col">
              {say.values.error} <small>{say.values.unit}</small>
            </th>
          </tr>
        </thead>
        <tbody>
          {JOINTS.map((joint) => (
            <tr key={joint}>
              <th scope="row">{say.values.joints[joint]}</th>
              <Cell show={(robot) => millimetres(robot.commanded?.joints[`${joint}_mm`])} />
              <Cell show={(robot) => millimetres(robot.measured?.joints[`${joint}_mm`])} />
              <Cell show={(robot) => errorOf(robot, joint)} />
            </tr>
          ))}
        </tbody>
      </table>
      <dl class="list">
        <Line label={say.values.tip} show={tipOf} />
        <Line label={say.values.force} show={forceOf} />
      </dl>
    </section>
  );
}

function Cell({ show }: { show: (robot: Robot) => string }) {
  const text = useComputed(() => textOf(show));
  return <td>{text}</td>;
}

function Line({ label, show }: { label: string; show: (robot: Robot) => string }) {
  const text = useComputed(() => textOf(show));
  return (
    <div>
      <dt>{label}</dt>
      <dd>{text}</dd>
    </div>
  );
}

function textOf(show: (robot: Robot) => string): string {
  const robot = store.live.value?.robot;
  return robot === undefined ? say.values.unknown : show(robot);
}

const millimetres = (value: number | undefined): string => value === undefined ? say.values.unknown : formatNumber(value, 2);

/** Measured less commanded [mm]; null while one of them is unknown. */
export function followingError(robot: Robot, joint: Joint): number | null {
  const { measured, commanded } = robot;
  if (measured === null || commanded === null) return null;
  return measured.joints[`${joint}_mm`] - commanded.joints[`${joint}_mm`];
}

function errorOf(robot: Robot, joint: Joint): string {
  const error = followingError(robot, joint);
  if (error === null) return say.values.unknown;
  return formatNumber(Math.abs(error) < ROUNDED_TO_ZERO_MM ? 0 : error, 2);
}

function tipOf({ measured }: Robot): string {
  if (measured?.tip == null) return say.values.unknown;
  const { x_mm, y_mm, z_mm } = measured.tip;
  return `${[x_mm, y_mm, z_mm].map((each) => formatNumber(each, 2)).join(" / ")} mm`;
}

const forceOf = ({ measured }: Robot): string =>
  measured === null ? say.values.unknown : `${formatNumber(measured.force_n, 1)} N`;
