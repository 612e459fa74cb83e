/** The life of a job as the page sees it. */
import type { Job, JobPhase, JobType, Live } from "@/api/wire";

export type ActiveJob = Job & { readonly state: "queued" | "running" };

export function isActive(job: Job | null): job is ActiveJob {
  return job !== null && (job.state === "queued" || job.state === "running");
}

/** It neither rests nor waits for a person. */
export function isUnderWay(job: Job): boolean {
  return job.paused !== true && job.needs_person == null;
}

/** In all other phases the robot stands still with the plug in the car. */
export function isMovingPhase(phase: JobPhase): boolean {
  return phase !== "plugged" && phase !== "charging";
}

/** On its way back to the parking place, whether all went well or not. */
export function isReturning(phase: JobPhase): boolean {
  return RETURN.includes(phase);
}

const RETURN: readonly JobPhase[] = ["releasing", "withdrawing", "parking"];
const PHASES: Record<JobType, readonly JobPhase[]> = {
  charge: ["locating", "aligning", "inserting", "charging", ...RETURN],
  plug_in: ["locating", "aligning", "inserting", "plugged"],
  unplug: RETURN,
};

export interface Step {
  readonly phase: JobPhase;
  readonly state: "done" | "now" | "open";
}

/** The steps of a running job, each with how far it got. */
export function stepsOf(job: ActiveJob): readonly Step[] {
  const phases = stepsAhead(job);
  // Preflight comes before every step; waiting for the current belongs to charging.
  const phase = job.type === "charge" && job.phase === "plugged" ? "charging" : job.phase;
  const reached = phases.indexOf(phase);
  return phases.map((each, index) => {
    if (index < reached) return { phase: each, state: "done" };
    return { phase: each, state: index === reached ? "now" : "open" };
  });
}

/** A job that turned back early never does the steps it left out: only the way home is left. */
function stepsAhead(job: ActiveJob): readonly JobPhase[] {
  const plugged = job.type === "unplug" || job.result.plugged_after_s != null;
  const turnedBack = isReturning(job.phase) && (job.type === "plug_in" || !plugged);
  return turnedBack ? RETURN.slice(RETURN.indexOf(job.phase)) : PHASES[job.type];
}

/**
 * Seconds since the phase began, by the server's clock alone: the reader's may be wrong, and a
 * simulator's may run faster.
 */
export function phaseElapsedS(live: Live): number {
  if (live.job === null) return 0;
  return Math.max(0, (serverNowMs(live) - Date.parse(live.job.phase_started_at)) / 1000);
}

/** The newest date that the server has told: it tells one several times a second. */
export function serverNowMs({ robot, job, station }: Live): number {
  const told = [robot.updated_at, job?.updated_at, station.updated_at];
  return Math.max(...told.map((date) => (date == null ? 0 : Date.parse(date))));
}
