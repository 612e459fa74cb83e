import type { CameraInspection } from "@/api/wire";
import { formatNumber } from "@/format";
import { Panel } from "../parts/panel";
import { TroubleNote } from "../parts/trouble";
import { Picture, sentenceOf, useCamera } from "./picture";
import { say } from "./words";

type SeenLabel = NonNullable<CameraInspection["label"]>;

/** The camera's picture with what is found in it; nothing is asked for before it is opened. */
export function CameraPanel() {
  return <Panel title={say.title} hint={say.hint} body={Camera} />;
}

function Camera() {
  const { shown, trouble } = useCamera();
  const now = shown.value;
  return (
    <>
      <Picture shown={now} old={trouble.value !== null} />
      <TroubleNote trouble={trouble.value} />
      <p class="panel-note camera-note">{now === null ? say.loading : sentenceOf(now.inspection)}</p>
      <div class="camera-figures">
        <PoseFigures label={now?.inspection.label ?? null} />
        <Health inspection={now?.inspection ?? null} />
      </div>
    </>
  );
}

function PoseFigures({ label }: { label: SeenLabel | null }) {
  const pose = label?.pose ?? null;
  const place = (number: 0 | 1 | 2): string =>
    pose === null ? say.unknown : within(pose.position_mm[number], pose.position_sigma_mm[number], "mm");
  const turn = (number: 0 | 1 | 2): string =>
    pose === null ? say.unknown : within(pose.turn_deg[number], pose.turn_sigma_deg[number], "°");
  return (
    <Figures
      title={say.pose.title}
      lines={[
        [say.pose.x, place(0)],
        [say.pose.y, place(1)],
        [say.pose.z, place(2)],
        [say.pose.turnX, turn(0)],
        [say.pose.turnY, turn(1)],
        [say.pose.turnZ, turn(2)],
        [say.pose.residual, pose === null ? say.unknown : `${formatNumber(pose.residual_px, 3)} px`],
        [say.pose.inliers, pose === null ? say.unknown : say.inliers(share(pose.inlier_share), formatNumber(pose.measurements, 0))],
        [say.pose.vehicle, label?.vehicle_id ?? say.unknown],
      ]}
    />
  );
}

function Health({ inspection }: { inspection: CameraInspection | null }) {
  const show = (value: number | null | undefined, digits: number, unit: string): string =>
    value == null ? say.unknown : `${formatNumber(value, digits)}${unit}`;
  return (
    <Figures
      title={say.health.title}
      lines={[
        [say.health.rate, show(inspection?.frames_per_s, 1, " /s")],
        [say.health.age, show(inspection && inspection.age_s * 1000, 0, " ms")],
        [say.health.exposure, show(inspection?.exposure_ms, 1, " ms")],
        [say.health.brightness, show(inspection?.brightness, 0, "")],
        [say.health.dark, inspection === null ? say.unknown : share(inspection.dark_share)],
        [say.health.bright, inspection === null ? say.unknown : share(inspection.bright_share)],
      ]}
    />
  );
}

function Figures({ title, lines }: { title: string; lines: readonly (readonly [string, string])[] }) {
  return (
    <div>
      <h3>{title}</h3>
      <dl class="list">
        {lines.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </div>
  );
}

const share = (part: number): string => `${formatNumber(100 * part, 1)} %`;

/** A value and its standard deviation, with as many digits as that deserves. */
function within(value: number, sigma: number, unit: string): string {
  const digits = sigma > 0 ? Math.min(Math.max(1 - Math.floor(Math.log10(sigma)), 1), 4) : 3;
  return `${formatNumber(value, Math.min(digits, 3))} ± ${formatNumber(sigma, digits)} ${unit}`;
}
