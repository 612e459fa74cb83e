import type { CameraInspection } from "@/api/wire";
import { magnification, side_px, SIGMAS_95 } from "./ellipse";

type SeenLabel = NonNullable<CameraInspection["label"]>;
type Pose = NonNullable<SeenLabel["pose"]>;
type Pixel = SeenLabel["centre_px"];

const AXES = ["x", "y", "z"] as const;

/** What was found in the picture, drawn over it in the pixels of the camera. */
export function Overlay({ width, height, label }: { width: number; height: number; label: SeenLabel }) {
  const points = label.outline_px.map((point) => point.join(",")).join(" ");
  const { pose } = label;
  return (
    <svg
      class="camera-overlay"
      viewBox={`0 0 ${String(width)} ${String(height)}`}
      data-trusted={pose?.source === "edges"}
      aria-hidden="true"
    >
      <polygon class="halo" points={points} />
      <polygon class="outline" points={points} />
      {pose !== null && <Axes from={label.centre_px} pose={pose} />}
      {pose !== null && <Ellipses label={label} pose={pose} />}
    </svg>
  );
}

function Axes({ from, pose }: { from: Pixel; pose: Pose }) {
  const [x, y] = from;
  return (
    <>
      {AXES.map((name, number) => {
        const [endX, endY] = pose.axes_px[number]!;
        const line = { x1: x, y1: y, x2: endX, y2: endY };
        return (
          <g key={name} data-axis={name}>
            <line class="halo" {...line} />
            <line class="axis" {...line} />
          </g>
        );
      })}
    </>
  );
}

function Ellipses({ label, pose }: { label: SeenLabel; pose: Pose }) {
  const { major_px, minor_px, angle_rad } = pose.ellipse;
  const times = magnification(major_px, side_px(label));
  const [x, y] = label.centre_px;
  const turned = `translate(${String(x)} ${String(y)}) rotate(${String((angle_rad * 180) / Math.PI)})`;
  return (
    <g transform={turned}>
      {[SIGMAS_95, 1].map((sigmas) => {
        const axes = { rx: major_px * times * sigmas, ry: minor_px * times * sigmas };
        return (
          <g key={sigmas}>
            <ellipse class="halo" {...axes} />
            <ellipse class={sigmas === 1 ? "sigma" : "sigma most"} {...axes} />
          </g>
        );
      })}
    </g>
  );
}
