/** What the guidance card shows, worked out from the live state. */
import type { Guidance, GuidanceStep, GuidedCar } from "@/api/wire";
import type { Tone } from "@/robot/describe";

export type Icon =
  | GuidanceStep["direction"]
  | "stop"
  | "good"
  | "thin"
  | "askew"
  | "look"
  | "alert"
  | "closed";

const TONES: Record<Guidance["state"], Tone> = {
  paused: "calm",
  searching: "calm",
  unreadable: "ask",
  lost: "problem",
  move: "busy",
  stop: "problem",
  good: "good",
  thin: "ask",
  skewed: "problem",
};

/** Without guidance a car may come in by eye; for these reasons it must not. */
const CLOSED: readonly Guidance["reason"][] = ["robot_busy", "robot_not_parked", "plug_held"];

const isClosed = ({ state, reason }: Guidance): boolean =>
  state === "paused" && CLOSED.includes(reason);

export const toneOf = (guidance: Guidance): Tone =>
  isClosed(guidance) ? "ask" : TONES[guidance.state];

export function iconOf(guidance: Guidance): Icon {
  const { state, steps } = guidance;
  switch (state) {
    case "move":
      return steps[0]?.direction ?? "look";
    case "stop":
      return "stop";
    case "good":
      return "good";
    case "thin":
      return "thin";
    case "skewed":
      return "askew";
    case "lost":
    case "unreadable":
      return "alert";
    case "paused":
      return isClosed(guidance) ? "closed" : "look";
    case "searching":
      return "look";
  }
}

/** Only a car that is to be moved gets a number; up and down cannot be driven. */
export function bigStep({ state, steps }: Guidance): GuidanceStep | null {
  const [first] = steps;
  if (state !== "move" || first === undefined) return null;
  return first.direction === "up" || first.direction === "down" ? null : first;
}

/** The picture in its own units; one of them is a CSS pixel on a phone. */
export const WIDTH = 350;
export const HEIGHT = 290;
/** How many millimetres the height may show; the robot's wall is always in it. */
const SPANS_MM = [460, 660, 950, 1400] as const;
/** Of a span: zooming in needs so much room to spare, or the picture would pump. */
const SPARE = 0.85;
const BEHIND_WALL_MM = 34;
const AROUND_CAR_MM = 90;

export interface Frame {
  readonly span_mm: number;
  readonly middle_x_mm: number;
  /** Drivers who come in backwards see the robot below. */
  readonly turned: boolean;
}

export const middleOf = (zones: Guidance["zones"]): number => {
  const xs = zones.good.map(([x]) => x);
  return (Math.min(...xs) + Math.max(...xs)) / 2;
};

/** The smallest frame that shows wall, zones and car. */
export function frameFor(guidance: Guidance, before: Frame | null): Frame {
  const { car, zones, driver_faces } = guidance;
  const middle_x_mm = middleOf(zones);
  const needed = neededMm(car, zones, middle_x_mm);
  const largest = SPANS_MM[SPANS_MM.length - 1] ?? 1400;
  const fitting = SPANS_MM.find((span) => {
    const zoomsIn = before !== null && span < before.span_mm;
    return needed <= span * (zoomsIn ? SPARE : 1);
  });
  return { span_mm: fitting ?? largest, middle_x_mm, turned: driver_faces === "away" };
}

function neededMm(car: GuidedCar | null, zones: Guidance["zones"], middle: number): number {
  const deepest = Math.max(...zones.reachable.map(([, z]) => z));
  const depth = Math.max(deepest, car?.z_mm ?? 0) + AROUND_CAR_MM;
  const aside = Math.abs((car?.x_mm ?? middle) - middle) + AROUND_CAR_MM;
  return Math.max(depth, (aside * 2 * HEIGHT) / WIDTH) + BEHIND_WALL_MM;
}

export const scaleOf = (frame: Frame): number => HEIGHT / frame.span_mm;

/** A place of the base frame in the picture; what is too far away stays at its edge. */
export function placed(frame: Frame, x_mm: number, z_mm: number): [number, number] {
  const scale = scaleOf(frame);
  const u = WIDTH / 2 + (x_mm - frame.middle_x_mm) * scale;
  const v = (z_mm + BEHIND_WALL_MM) * scale;
  return frame.turned ? [WIDTH - u, HEIGHT - v] : [u, v];
}

export interface Ellipse {
  readonly long: number;
  readonly short: number;
  /** Of the long axis against the picture's x. */
  readonly turn_deg: number;
}

/** Twice the standard deviations of the socket's place, in the picture. */
export function uncertainty(car: GuidedCar, frame: Frame): Ellipse {
  const { sigma_x_mm: sx, sigma_z_mm: sz, correlation_xz: r } = car;
  const [a, b, c] = [sx * sx, r * sx * sz, sz * sz];
  const half = Math.hypot((a - c) / 2, b);
  const scale = 2 * scaleOf(frame);
  return {
    long: Math.sqrt((a + c) / 2 + half) * scale,
    short: Math.sqrt(Math.max(0, (a + c) / 2 - half)) * scale,
    turn_deg: (Math.atan2(2 * b, a - c) * 90) / Math.PI,
  };
}

/** How far the socket has to go, along x and z of the base frame [mm]. */
export function wayOf({ steps, driver_faces }: Guidance): [number, number] {
  const facing = driver_faces === "robot" ? 1 : -1;
  const of = (direction: GuidanceStep["direction"]): number =>
    steps.find((step) => step.direction === direction)?.distance_mm ?? 0;
  return [facing * (of("right") - of("left")), facing * (of("back") - of("forward"))];
}
