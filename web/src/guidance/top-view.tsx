import { useRef } from "preact/hooks";
import type { Guidance, GuidedCar } from "@/api/wire";
import {
  HEIGHT,
  WIDTH,
  frameFor,
  middleOf,
  placed,
  scaleOf,
  uncertainty,
  wayOf,
} from "./view";
import type { Frame } from "./view";
import { say } from "./words";

const SHORTEST_ARROW = 26;
const HEAD = 15;
const LEGEND_WIDTH = 62;
/** Of the scale: the robot is large enough for its name. */
const NAMED_FROM = 0.42;

/** Robot, zones and socket from above, the driver looking up the picture. */
export function TopView({ guidance }: { guidance: Guidance }) {
  const before = useRef<Frame | null>(null);
  const frame = frameFor(guidance, before.current);
  before.current = frame;
  const { car, zones } = guidance;
  const outline = (points: readonly (readonly number[])[]): string =>
    points.map(([x = 0, z = 0]) => placed(frame, x, z).map((v) => v.toFixed(1)).join()).join(" ");
  return (
    <svg class="top-view" viewBox={`0 0 ${String(WIDTH)} ${String(HEIGHT)}`} role="img">
      <title>{say.picture}</title>
      <Robot frame={frame} x_mm={middleOf(zones)} />
      {car !== null && <Car car={car} frame={frame} />}
      <polygon class="zone reachable" points={outline(zones.reachable)} />
      <polygon class="zone best" points={outline(zones.good)} />
      <Legend guidance={guidance} frame={frame} />
      {car !== null && <Way guidance={guidance} car={car} frame={frame} />}
      {car !== null && <Socket car={car} frame={frame} />}
    </svg>
  );
}

function Robot({ frame, x_mm }: { frame: Frame; x_mm: number }) {
  const [u, v] = placed(frame, x_mm, 0);
  const scale = scaleOf(frame);
  const down = frame.turned ? -1 : 1;
  const wide = 120 * scale;
  return (
    <g class="robot-above" transform={`translate(${u.toFixed(1)} ${v.toFixed(1)}) scale(1 ${String(down)})`}>
      <rect class="wall" x={-WIDTH} y={-60} width={2 * WIDTH} height={60} />
      <rect class="rail" x={-4.2 * wide} y={0} width={8.4 * wide} height={14 * scale} />
      <rect class="body" x={-wide / 2} y={0} width={wide} height={105 * scale} rx={10 * scale} />
      <rect class="tip" x={-wide / 5} y={100 * scale} width={(2 * wide) / 5} height={70 * scale} rx={5 * scale} />
      {scale > NAMED_FROM && (
        <text y={down * 62 * scale} text-anchor="middle" transform={`scale(1 ${String(down)})`}>
          {say.robot}
        </text>
      )}
    </g>
  );
}

/** The nose of a car about its socket; how wide the car is, nobody knows. */
function Car({ car, frame }: { car: GuidedCar; frame: Frame }) {
  const [u, v] = placed(frame, car.x_mm, car.z_mm);
  const scale = scaleOf(frame);
  const turn = car.turned_deg + (frame.turned ? 180 : 0);
  return (
    <g
      class="car-above"
      style={{
        transform: `translate(${u.toFixed(1)}px, ${v.toFixed(1)}px) rotate(${turn.toFixed(1)}deg) scale(${scale.toFixed(4)})`,
      }}
    >
      <path
        class="bonnet"
        d="M-640 1500V330C-640 150-470 40-240 8Q0-8 240 8C470 40 640 150 640 330V1500Z"
      />
      <path class="crease" d="M-430 1500V360C-400 210-260 120 0 112S400 210 430 360V1500" />
      <path class="lamp" d="M-600 250C-570 160-480 100-380 70L-350 120C-440 150-520 200-560 270Z" />
      <path class="lamp" d="M600 250C570 160 480 100 380 70L350 120C440 150 520 200 560 270Z" />
    </g>
  );
}

function Socket({ car, frame }: { car: GuidedCar; frame: Frame }) {
  const [u, v] = placed(frame, car.x_mm, car.z_mm);
  const { long, short, turn_deg } = uncertainty(car, frame);
  return (
    <g class="socket-above" style={{ transform: `translate(${u.toFixed(1)}px, ${v.toFixed(1)}px)` }}>
      <ellipse class="doubt" rx={long} ry={short} transform={`rotate(${turn_deg.toFixed(1)})`} />
      <circle class="ring" r={9} />
      <circle class="dot" r={3.5} />
    </g>
  );
}

/** An arrow as long as the way. */
function Way({ guidance, car, frame }: { guidance: Guidance; car: GuidedCar; frame: Frame }) {
  if (guidance.state !== "move" && guidance.state !== "thin") return null;
  const [dx, dz] = wayOf(guidance);
  const [u0, v0] = placed(frame, car.x_mm, car.z_mm);
  const [u1, v1] = placed(frame, car.x_mm + dx, car.z_mm + dz);
  const length = Math.hypot(u1 - u0, v1 - v0);
  if (length < SHORTEST_ARROW) return null;
  const [eu, ev] = [(u1 - u0) / length, (v1 - v0) / length];
  const at = (along: number, aside: number): string =>
    `${(u0 + along * eu - aside * ev).toFixed(1)} ${(v0 + along * ev + aside * eu).toFixed(1)}`;
  const neck = length - HEAD;
  return (
    <g class="way">
      <path class="shaft" d={`M${at(12, 0)}L${at(neck, 0)}`} />
      <path class="head" d={`M${at(length, 0)}L${at(neck - 2, 10)}L${at(neck - 2, -10)}Z`} />
    </g>
  );
}

function Legend({ guidance, frame }: { guidance: Guidance; frame: Frame }) {
  const { zones } = guidance;
  const right = Math.max(...zones.reachable.map(([x]) => x));
  const top = Math.min(...zones.reachable.map(([, z]) => z));
  const [u, v] = placed(frame, right, top);
  if (frame.turned || WIDTH - u < LEGEND_WIDTH) return null;
  return (
    <g class="legend" aria-hidden="true">
      <text x={u + 6} y={v + 9}>
        {say.legendReach}
      </text>
    </g>
  );
}
