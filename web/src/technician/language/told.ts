/** What only technicians get to see of the server's problems, in the reader's language. */
import { formatNumber } from "@/format";
import { told } from "@/language/problems";
import type { Told } from "@/language/problems";
import { bench } from "./spoken";

export const BENCH_PROBLEM_CODES = [
  "calibration_routine", "calibration_running", "calibration_none", "calibration_label_moved",
  "calibration_label_lost", "calibration_plug_not_in", "calibration_axes_swapped",
  "calibration_motor_reversed", "robot_calibration", "robot_calibration_looks",
  "robot_calibration_fit", "calibration_version", "calibration_not_found", "calibration_worse",
  "calibration_misfit", "calibration_nothing_before", "settings_invalid", "setting_fixed",
  "no_such_version", "precondition_failed", "vision_error", "no_code", "picture_too_dark",
  "picture_too_bright", "wrong_payload", "label_ambiguous", "pose_rejected", "mirrored_code",
  "fit_failed", "tilt_ambiguous", "label_cut_off", "edges_do_not_fit", "edges_disagree",
  "modules_disagree", "distance_implausible", "tilt_implausible", "label_jumped",
  "calibration_no_question", "calibration_answer", "calibration_lost", "calibration_slide_hit",
  "calibration_no_spring", "calibration_check_not_found", "camera_calibration",
  "calibration_no_board", "calibration_mixed_resolution", "calibration_wrong_board",
  "calibration_diverged", "calibration_board_blurred", "calibration_too_few_views",
] as const;

type Code = (typeof BENCH_PROBLEM_CODES)[number];

/** Title and remedy of each code, and the one detail that has a number to be told. */
export interface BenchProblems {
  readonly byCode: Readonly<Record<Code, readonly [title: string, remedy: string]>>;
  readonly moved: (distance_mm: string) => string;
}

interface Problem extends Told {
  readonly code: string;
  readonly context?: Readonly<Record<string, unknown>> | undefined;
}

/** A problem in the reader's language, as far as it is known there. */
export function toldOnBench(problem: Problem): Told {
  const { problems } = bench;
  if (problems === null || !isOurs(problem.code)) return told(problem);
  const [title, remedy] = problems.byCode[problem.code];
  const moved_mm = problem.context?.["moved_mm"];
  return { title, detail: typeof moved_mm === "number" ? problems.moved(formatNumber(moved_mm, 1)) : "", remedy };
}

const isOurs = (code: string): code is Code => (BENCH_PROBLEM_CODES as readonly string[]).includes(code);
