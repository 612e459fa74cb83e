import type { CameraInspection } from "@/api/wire";
import { formatNumber } from "@/format";
import { Figures } from "../parts/figures";
import { Panel } from "../parts/panel";
import { TroubleNote } from "../parts/trouble";
import { HealthFigures, HealthOverTime, share } from "./health";
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
      <div class="panel-figures" data-old={trouble.value !== null}>
        <PoseFigures label={now?.inspection.label ?? null} />
        <HealthFigures inspection={now?.inspection ?? null} />
      </div>
      <HealthOverTime shown={shown} old={trouble.value !== null} />
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

/** A value and its standard deviation, with as many digits as that deserves. */
function within(value: number, sigma: number, unit: string): string {
  const digits = sigma > 0 ? Math.min(Math.max(1 - Math.floor(Math.log10(sigma)), 1), 4) : 3;
  return `${formatNumber(value, Math.min(digits, 3))} ± ${formatNumber(sigma, digits)} ${unit}`;
}
