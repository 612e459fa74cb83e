/** The life of a job as the page sees it. */
import type { Job, JobPhase, JobType, Live } from "@/api/wire";

export type ActiveJob = Job & { readonly state: "queued" | "running" };

export function isActive(job: Job | null): job is ActiveJob {
  return job !== null && (job.state === "queued" || job.state === "running");
}

/** In all other phases the robot stands still with the plug in the car. */
export function isMovingPhase(phase: JobPhase): boolean {
  return phase !== "plugged" && phase !== "charging";
}

const PHASES: Record<JobType, readonly JobPhase[]> = {
  charge: ["locating", "aligning", "inserting", "charging", "releasing", "withdrawing", "parking"],
  plug_in: ["locating", "aligning", "inserting", "plugged"],
  unplug: ["releasing", "withdrawing", "parking"],
};

export type StepState = "done" | "now" | "failed" | "open";

export interface Step {
  readonly phase: JobPhase;
  readonly state: StepState;
}

/** The steps of a job, each with how far it got. */
export function stepsOf(job: Job): readonly Step[] {
  const phases = PHASES[job.type];
  // Preflight comes before every step; waiting for the current belongs to charging.
  const phase = job.type === "charge" && job.phase === "plugged" ? "charging" : job.phase;
  const reached = phases.indexOf(phase);
  return phases.map((each, index) => {
    if (job.state === "succeeded" || index < reached) return { phase: each, state: "done" };
    if (index > reached) return { phase: each, state: "open" };
    return { phase: each, state: isActive(job) ? "now" : "failed" };
  });
}

/**
 * Seconds since the phase began, by the server's clock alone: the reader's may be wrong, and a
 * simulator's may run faster.
 */
export function phaseElapsedS({ robot, job }: Live): number {
  if (job === null) return 0;
  const nowMs = Math.max(Date.parse(robot.updated_at), Date.parse(job.updated_at));
  return Math.max(0, (nowMs - Date.parse(job.phase_started_at)) / 1000);
}
