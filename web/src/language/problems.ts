/**
 * What the server says about a problem, in the reader's language.
 *
 * The server speaks English and names each problem by a stable code. A code that is not known
 * here (from a newer server, say) keeps the server's own sentences.
 */
import { signal } from "@preact/signals";
import { language } from "./language";
import type { Language } from "./language";

/** What a family may get to see; what only programs can do wrong stays in English. */
export const PROBLEM_CODES = [
  "internal", "error", "invalid_request", "not_simulated", "control", "control_busy",
  "control_lost", "control_held", "not_in_control", "nobody_asks", "control_request_pending",
  "robot_offline", "robot_not_ready", "stopped", "telemetry_stale",
  "release_refused", "emergency_stopped", "robot_fault", "fault_remains", "slide_stalled",
  "following_error", "motion_refused", "lateral_motion_forbidden", "out_of_reach",
  "actuator_overload", "force_limit", "force_above_band", "force_below_band", "under_load",
  "station_unsafe", "emergency_stop", "limit_switch", "stall", "queue_underrun", "heartbeat_lost",
  "segment_mismatch", "homing_failed", "watchdog", "board_not_found", "board_silent",
  "wrong_firmware", "link_lost", "board_refused", "job", "job_queue_full", "job_needs_person",
  "job_not_found", "job_ended", "cannot_pause", "not_paused", "schedule", "schedule_missed",
  "not_charging", "unknown_vehicle", "vehicle_required", "vehicle_in_use", "plug_state", "plug_seen_in_car",
  "plug_not_seen", "target_gone", "calibration_held", "calibration_unusable",
  "interrupted", "socket_too_skewed", "insertion_jammed", "insertion_depth", "plug_missed",
  "no_contact", "connector_locked", "car_gone", "restarted_too_often", "long_outage",
  "charge_point", "charge_point_resting", "charge_point_unplugging", "localisation",
  "label_not_found", "socket_unreachable", "pose_uncertain", "label_size_wrong",
  "place_implausible", "camera_down", "storage", "disk_full", "disk_read_only", "disk_error",
  "database_busy", "database_broken", "database_unreachable", "recording", "no_recording",
  "recording_running", "playback_failed", "access", "not_paired", "forbidden", "wrong_origin",
  "unknown_host", "invitation", "too_many_attempts", "last_owner", "no_such_entry", "passkey",
  "push", "push_refused",
] as const;

export type ProblemCode = (typeof PROBLEM_CODES)[number];
export type ProblemWords = Readonly<Record<ProblemCode, readonly [title: string, remedy: string]>>;

type Translated = Exclude<Language, "en">;

const FILES: Readonly<Record<Translated, () => Promise<{ readonly problems: ProblemWords }>>> = {
  fr: () => import("./fr/problems"),
  de: () => import("./de/problems"),
  it: () => import("./it/problems"),
};

const spoken = signal<{ readonly language: Language; readonly words: ProblemWords } | null>(null);

/** Loads what is said about problems; later than the rest, since the page opens without. */
export async function loadProblems(): Promise<void> {
  const now = language.value;
  if (now === "en" || spoken.value?.language === now) return;
  const { problems } = await FILES[now]();
  spoken.value = { language: now, words: problems };
}

/** The parts of a problem that a person reads. */
export interface Told {
  readonly title: string;
  /** This occurrence in a sentence; empty where only the server can say it, in English. */
  readonly detail: string;
  readonly remedy: string;
}

/** The problem in the language in force. */
export function told(problem: Told & { readonly code: string }): Told {
  const { title, detail, remedy } = problem;
  const words = spoken.value;
  if (words === null || words.language !== language.value) return { title, detail, remedy };
  const found = Object.hasOwn(words.words, problem.code)
    ? words.words[problem.code as ProblemCode]
    : undefined;
  if (found === undefined) return { title, detail, remedy };
  return { title: found[0], detail: "", remedy: found[1] };
}
