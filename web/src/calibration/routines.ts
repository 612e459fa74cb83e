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
}

export interface Description {
  readonly drawing: DrawingName;
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

export const ROUTINES: Readonly<Record<RoutineKind, Description>> = {
  robot: {
    drawing: "looks",
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
  socket: { drawing: "mated", looks: 2, lookTakes_s: 15, plugIn: true, fields: [] },
  check: {
    drawing: "nine",
    looks: 9,
    lookTakes_s: 55,
    plugIn: false,
    fields: [{ name: "approaches", path: ["approaches"], initial: 3, least: 3, most: 30, whole: true }],
  },
};

export const ROUTINE_KINDS = Object.keys(ROUTINES) as RoutineKind[];
