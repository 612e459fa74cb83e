/** What the buttons do. One at a time; what goes wrong is shown beside them. */
import { signal } from "@preact/signals";
import {
  cancelJob,
  commandRobot,
  confirmPlugIsOut,
  finishJob,
  listVehicles,
  pauseJob,
  Refusal,
  resumeJob,
  startJob,
} from "@/api/client";
import type { RobotCommand, Trouble } from "@/api/client";
import type { Job, JobRequest, StopKind, Vehicle } from "@/api/wire";
import { stop, store } from "@/live/page";
import { words } from "@/words";
import type { ActionKind } from "./describe";
import { isActive } from "./job";

/** A press whose answer is not there yet. */
export const pending = signal(false);
export const stopping = signal(false);
/** Why the last press did not work. */
export const trouble = signal<Trouble | null>(null);
/** The question on the screen, if any. */
export const question = signal<"reset" | "plug" | null>(null);
/** The cars to choose from, while the choice is open. */
export const choice = signal<readonly Vehicle[] | null>(null);

/** The cars to plan for, while the plan is open. */
export const planning = signal<readonly Vehicle[] | null>(null);

async function attempt(work: () => Promise<unknown>): Promise<void> {
  if (pending.value) return;
  pending.value = true;
  trouble.value = null;
  try {
    await work();
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    trouble.value = error.trouble;
  } finally {
    pending.value = false;
  }
}

/** The car in front of the robot, as far as anyone knows. */
function lastVehicleId(): string | null {
  return store.live.value?.job?.vehicle_id ?? null;
}

/** Charges the only car, or asks which one; the car of the last job comes first. */
async function charge(): Promise<void> {
  const { items } = await listVehicles();
  const [first, ...others] = items;
  if (first === undefined) {
    trouble.value = words.noCar;
  } else if (others.length === 0) {
    await startJob({ type: "charge", vehicle_id: first.id });
  } else {
    const last = lastVehicleId();
    choice.value = [...items].sort((a, b) => Number(b.id === last) - Number(a.id === last));
  }
}

async function openPlan(): Promise<void> {
  const { items } = await listVehicles();
  if (items.length === 0) trouble.value = words.noCar;
  else planning.value = items;
}

/** Starts a planned charge. */
export function plan(job: JobRequest): void {
  planning.value = null;
  void attempt(() => startJob(job));
}

async function withRunningJob(work: (id: string) => Promise<Job>): Promise<void> {
  const job = store.live.value?.job ?? null;
  if (isActive(job)) await work(job.id);
}

async function withWaitingJob(work: (id: string) => Promise<Job>): Promise<void> {
  const job = store.live.value?.queue?.waiting ?? null;
  if (job !== null) await work(job.id);
}

/** The job that waits does not begin at all. */
export function cancelWaiting(): void {
  void attempt(() => withWaitingJob(cancelJob));
}

/** A paused job that waits begins when its time has come. */
export function resumeWaiting(): void {
  void attempt(() => withWaitingJob(resumeJob));
}

/** The big button. */
export function press(kind: ActionKind): void {
  switch (kind) {
    case "charge":
      void attempt(charge);
      break;
    case "finish":
      void attempt(() => withRunningJob(finishJob));
      break;
    case "cancel":
      void attempt(() => withRunningJob(cancelJob));
      break;
    case "pause":
      void attempt(() => withRunningJob(pauseJob));
      break;
    case "resume":
      void attempt(() => withRunningJob(resumeJob));
      break;
    case "plan":
      void attempt(openPlan);
      break;
    case "unplug":
      void attempt(() => startJob({ type: "unplug", vehicle_id: lastVehicleId() }));
      break;
    case "reset":
      question.value = "reset";
      break;
    case "confirm_plug":
      question.value = "plug";
      break;
  }
}

/** The button at the end of a guide, which has asked already what a question would ask. */
export function carryOut(kind: ActionKind): void {
  press(kind);
  if (question.value !== null) answerYes();
}

export function chargeVehicle(vehicle: Vehicle): void {
  choice.value = null;
  void attempt(() => startJob({ type: "charge", vehicle_id: vehicle.id }));
}

/** The reader said yes to the open question. */
export function answerYes(): void {
  const asked = question.value;
  question.value = null;
  if (asked === "reset") void attempt(() => commandRobot("reset"));
  if (asked === "plug") void attempt(confirmPlugIsOut);
}

export function command(name: RobotCommand): void {
  void attempt(() => commandRobot(name));
}

/** Never waits for another press to end. */
export function pressStop(kind: StopKind): void {
  stopping.value = true;
  stop(kind)
    .catch((error: unknown) => {
      if (!(error instanceof Refusal)) throw error;
      trouble.value = error.answered ? error.trouble : words.trouble.stopUnsure;
    })
    .finally(() => {
      stopping.value = false;
    });
}
