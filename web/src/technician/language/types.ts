/** What every language has to say on the technician's page: all that English says. */
import type { bench } from "./en/bench";
import type { calibration } from "./en/calibration";
import type { camera } from "./en/camera";
import type { config } from "./en/config";
import type { console } from "./en/console";
import type { diagnostics } from "./en/diagnostics";
import type { link } from "./en/link";
import type { target } from "./en/target";

export type BenchWords = typeof bench;
export type CalibrationWords = typeof calibration;
export type CameraWords = typeof camera;
export type ConfigWords = typeof config;
export type ConsoleWords = typeof console;
export type DiagnosticsWords = typeof diagnostics;
export type LinkWords = typeof link;
export type TargetWords = typeof target;

/** One language: its file is loaded with the technician's page only. */
export interface Spoken {
  readonly bench: BenchWords;
  readonly calibration: CalibrationWords;
  readonly camera: CameraWords;
  readonly config: ConfigWords;
  readonly console: ConsoleWords;
  readonly diagnostics: DiagnosticsWords;
  readonly link: LinkWords;
  readonly target: TargetWords;
}
