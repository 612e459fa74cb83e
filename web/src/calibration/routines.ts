/**
 * What the page knows about each routine.
 *
 * A further routine of the server is a further entry here, with its words under `routines` and
 * `fields` and a drawing; the guide, the progress and the result follow from that.
 */
import type { CalibrationWords } from "@/technician/language/types";
import type { DrawingName } from "./drawings";
import type { RoutineKind } from "./types";

/** Something the technician has measured, or wants. */
export interface Field {
  readonly name: keyof CalibrationWords["fields"];
  /** Where it stands in the request. A part of the request with an empty field is left out. */
  readonly path: readonly [string, ...string[]];
  /** What stands there first; null: nothing. */
  readonly initial: number | null;
  readonly least: number;
  readonly most: number;
  readonly whole?: true;
  /** Typed in per cent, sent as a share. */
  readonly percent?: true;
}

export interface Description {
  readonly drawing: DrawingName;
  /** A car with a label has to stand before the robot; the others look at nothing. */
  readonly needsLabel: boolean;
  /** Usual number of places, until the server has chosen them, and the time each takes. */
  readonly looks: number;
  readonly lookTakes_s: number;
  /** The plug has to be brought in by hand; for the others it must be out. */
  readonly plugIn: boolean;
  readonly fields: readonly Field[];
  readonly fieldHint?: keyof CalibrationWords["fieldHints"];
}

const sent_mm = { initial: 300, least: 50, most: 2000 } as const;
const went_mm = { initial: null, least: 50, most: 2000 } as const;
const repeated = { path: ["approaches"], least: 3, most: 30, whole: true } as const;

/** In the order in which a new robot wants them. */
export const ROUTINES: Readonly<Record<RoutineKind, Description>> = {
  camera: {
    drawing: "board",
    needsLabel: false,
    looks: 15,
    lookTakes_s: 15,
    plugIn: false,
    fields: [{ name: "square", path: ["square_mm"], initial: 24, least: 5, most: 200 }],
  },
  switches: {
    drawing: "switches",
    needsLabel: true,
    looks: 10,
    lookTakes_s: 15,
    plugIn: false,
    fields: [{ name: "homings", initial: 5, ...repeated }],
  },
  play: {
    drawing: "play",
    needsLabel: true,
    looks: 16,
    lookTakes_s: 8,
    plugIn: false,
    fields: [{ name: "reversals", initial: 4, ...repeated }],
  },
  belts: {
    drawing: "belts",
    needsLabel: false,
    looks: 2,
    lookTakes_s: 90,
    plugIn: false,
    fields: [
      { name: "distance", path: ["distance_mm"], initial: 300, least: 50, most: 400 },
      { name: "reading", path: ["reading_sigma_mm"], initial: 0.1, least: 0.01, most: 2 },
    ],
  },
  robot: {
    drawing: "looks",
    needsLabel: true,
    looks: 25,
    lookTakes_s: 18,
    plugIn: false,
    fields: [
      { name: "leftSent", path: ["left_belt", "commanded_mm"], ...sent_mm },
      { name: "leftWent", path: ["left_belt", "measured_mm"], ...went_mm },
      { name: "rightSent", path: ["right_belt", "commanded_mm"], ...sent_mm },
      { name: "rightWent", path: ["right_belt", "measured_mm"], ...went_mm },
      { name: "label", path: ["label_sigma_mm"], initial: 0.15, least: 0.01, most: 2 },
    ],
    fieldHint: "belts",
  },
  force: {
    drawing: "force",
    needsLabel: false,
    looks: 6,
    lookTakes_s: 15,
    plugIn: false,
    fields: [
      { name: "strokes", path: ["strokes"], initial: 3, least: 2, most: 20, whole: true },
      { name: "stroke", path: ["stroke_mm"], initial: 12, least: 5, most: 100 },
      { name: "spring", path: ["spring_n_mm"], initial: null, least: 0.1, most: 50 },
      { name: "springKnown", path: ["spring_sigma"], initial: 2, least: 0.1, most: 20, percent: true },
    ],
    fieldHint: "spring",
  },
  socket: { drawing: "mated", needsLabel: true, looks: 2, lookTakes_s: 15, plugIn: true, fields: [] },
  check: {
    drawing: "nine",
    needsLabel: true,
    looks: 9,
    lookTakes_s: 55,
    plugIn: false,
    fields: [{ name: "approaches", initial: 3, ...repeated }],
  },
};

/** The same order in groups: a list of all would be long on a phone. */
export const GROUPS = {
  camera: ["camera"],
  axes: ["switches", "play", "belts"],
  whole: ["robot", "force"],
  use: ["socket", "check"],
} as const satisfies Readonly<Record<string, readonly RoutineKind[]>>;
