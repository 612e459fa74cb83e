/** The state of the robot in a sentence, a picture and one thing to do. */
import type { Job, JobPhase, Live, NeedsPerson, Robot } from "@/api/wire";
import { formatDate, formatEnergy } from "@/format";
import { told } from "@/language/problems";
import { words } from "@/words";
import { isActive, isMovingPhase, isReturning, isUnderWay } from "./job";
import { armOf, sceneOf } from "./scene";
import type { Scene } from "./scene";

export type Tone = "calm" | "busy" | "good" | "ask" | "problem";

/** What the big button does. */
export type ActionKind =
  | "charge"
  | "plan"
  | "finish"
  | "unplug"
  | "cancel"
  | "pause"
  | "resume"
  | "reset"
  | "confirm_plug";

export interface Action {
  readonly kind: ActionKind;
  readonly label: string;
}

export interface Description {
  readonly headline: string;
  readonly detail: string;
  /** What a person can do about a problem; empty when there is none. */
  readonly remedy: string;
  readonly tone: Tone;
  readonly scene: Scene;
  readonly action: Action | null;
  /** What else can be done, shown smaller. */
  readonly others: readonly Action[];
  /** The stop button is shown: something moves or is about to. */
  readonly stoppable: boolean;
  /** What a person is asked about, as a code: there are steps to follow. Null when nobody is. */
  readonly help: string | null;
}

interface Sentence {
  readonly headline: string;
  readonly detail: string;
}

/** So long a finished charge stays the headline. */
const NEWS_MS = 30 * 60 * 1000;
/** So long before its time a planned job counts as about to move. */
const SOON_MS = 60 * 1000;

/**
 * Describes every live state.
 *
 * @param dismissedJobId the failed job whose message the reader has put away.
 */
export function describe(live: Live, dismissedJobId: string | null = null): Description {
  const { robot, job } = live;
  const running = isActive(job) ? job : null;
  const stoppable = isStoppable(robot, running);
  const base: Base = { remedy: "", stoppable, others: [], help: null };
  return (
    describeHalt(robot, base) ??
    (running !== null ? describeJob(robot, running, base) : null) ??
    describeQuestion(robot, base) ??
    describeOwnMotion(robot, base) ??
    describeFailure(robot, job, dismissedJobId, base) ??
    describeRest(live, base)
  );
}

type Base = Pick<Description, "remedy" | "stoppable" | "others" | "help">;

/** True while anything moves or may begin to move without another press. */
function isStoppable(robot: Robot, running: Job | null): boolean {
  switch (robot.mode) {
    case "homing":
    case "moving":
    case "stopping":
      return true;
    case "offline":
    case "stopped":
    case "emergency_stop":
    case "fault":
      return false;
    case "off":
    case "not_homed":
    case "ready":
      if (running === null || !isUnderWay(running) || untilBeginMs(robot, running) > SOON_MS) return false;
      return isMovingPhase(running.phase) || running.cancel_requested;
  }
}

/** How long a planned job still waits for its time, by the robot's clock; 0 when it does not. */
function untilBeginMs(robot: Robot, job: Job): number {
  if (job.state !== "queued" || job.not_before == null) return 0;
  return Math.max(0, Date.parse(job.not_before) - Date.parse(robot.updated_at));
}

/** Offline, latched and stopping states come before everything else. */
function describeHalt(robot: Robot, base: Base): Description | null {
  const alert: Scene = { arm: armOf(robot), mark: "alert" };
  switch (robot.mode) {
    case "offline":
      return {
        ...base,
        ...withPlugNote(faultSentence(robot) ?? words.state.offline, robot),
        remedy: remedyOf(robot) ?? "",
        tone: "problem",
        scene: { arm: armOf(robot), mark: "asleep" },
        action: null,
        help: robot.fault?.code ?? "robot_offline",
      };
    case "emergency_stop":
      return {
        ...base,
        ...withPlugNote(words.state.emergency, robot),
        remedy: remedyOf(robot) ?? words.state.emergencyRemedy,
        tone: "problem",
        scene: alert,
        help: "emergency_stop",
        action: { kind: "reset", label: words.action.release },
      };
    case "fault":
      return {
        ...base,
        ...withPlugNote(faultSentence(robot) ?? words.state.faultUnnamed, robot),
        remedy: remedyOf(robot) ?? "",
        tone: "problem",
        scene: alert,
        help: robot.fault?.code ?? "robot_fault",
        action: { kind: "reset", label: words.action.clear },
      };
    case "stopped":
      return {
        ...base,
        ...withPlugNote(words.state.stopped, robot),
        tone: "ask",
        scene: alert,
        help: robot.fault?.code ?? "stopped",
        action: { kind: "reset", label: words.action.release },
      };
    case "stopping":
      return { ...base, ...words.state.stopping, tone: "ask", scene: alert, action: null };
    default:
      return null;
  }
}

function describeJob(robot: Robot, job: Job, base: Base): Description {
  if (job.state === "queued") {
    const action = job.cancel_requested ? null : cancel();
    const scene: Scene = { arm: armOf(robot), mark: "sync" };
    const start = job.not_before ?? null;
    if (start === null || untilBeginMs(robot, job) === 0) {
      return { ...base, ...words.state.queued, tone: "busy", scene, action };
    }
    const planned = words.state.planned(formatDate(start), job.unplug_by == null ? null : formatDate(job.unplug_by));
    const others = action === null ? [] : [{ ...action, label: words.action.cancelPlan }];
    return { ...base, ...planned, tone: "calm", scene: { ...scene, mark: "none" }, action: null, others };
  }
  if (!isUnderWay(job)) return describeWaiting(robot, job, base);
  const scene = sceneOf(job, robot);
  if (job.cancel_requested && !isReturning(job.phase)) {
    const sentence = isMovingPhase(job.phase) ? words.state.cancelling : words.state.ending;
    return { ...base, ...sentence, tone: "busy", scene, action: null };
  }
  const findsPosition = job.phase === "preflight" && robot.mode === "homing";
  const { headline, detail } = findsPosition ? words.state.homing : words.phases[job.phase];
  const tone = job.phase === "charging" || job.phase === "plugged" ? "good" : "busy";
  const others = isPausable(job.phase) ? [pause()] : [];
  return { ...base, headline, detail, tone, scene, action: actionOf(job), others };
}

/** Paused, or waiting for a person to decide. */
function describeWaiting(robot: Robot, job: Job, base: Base): Description {
  const arm = armOf(robot);
  const giveUp: Action = { kind: "cancel", label: words.action.giveUp };
  const goOn: Action = { kind: "resume", label: words.action.goOn };
  const needs = job.needs_person ?? null;
  if (needs === null) {
    const scene: Scene = { arm, mark: "none" };
    return { ...base, ...words.state.paused, tone: "ask", scene, action: goOn, others: [giveUp] };
  }
  const choices = needs.choices.map((choice) => (choice === "resume" ? goOn : giveUp));
  const [action = null, ...others] = choices;
  return {
    ...base,
    headline: words.state.needsPerson,
    ...askedOf(needs),
    tone: "ask",
    scene: { arm, mark: "question" },
    action,
    others,
    help: needs.code,
  };
}

/** The plug is not on its way out: a pause leaves it where it is safe. */
function isPausable(phase: JobPhase): boolean {
  return phase !== "preflight" && !isReturning(phase);
}

function actionOf(job: Job): Action | null {
  switch (job.phase) {
    case "preflight":
    case "locating":
    case "aligning":
    case "inserting":
      return cancel();
    case "plugged":
      // There is no charge to finish yet; a cancelled job unplugs as well.
      return { kind: "cancel", label: words.action.finish };
    case "charging":
      return { kind: "finish", label: words.action.finish };
    case "releasing":
    case "withdrawing":
    case "parking":
      return null; // On its way home already: only Stop is left.
  }
}

function describeQuestion(robot: Robot, base: Base): Description | null {
  if (robot.plug !== "unknown") return null;
  const scene: Scene = { arm: "near", mark: "question" };
  const action: Action = { kind: "confirm_plug", label: words.action.plugOut };
  return { ...base, ...words.state.askPlug, tone: "ask", scene, action, help: "plug_unknown" };
}

/** Motion without a job: homing, or somebody at the controls. */
function describeOwnMotion(robot: Robot, base: Base): Description | null {
  const scene: Scene = { arm: armOf(robot), mark: "sync" };
  if (robot.mode === "homing") return { ...base, ...words.state.homing, tone: "busy", scene, action: null };
  if (robot.mode !== "moving") return null;
  const { control } = robot;
  const detail =
    control === null
      ? words.state.moving.detail
      : control.kind === "job"
        ? words.state.movingByJob
        : words.state.movingBy(control.name);
  return { ...base, ...words.state.moving, detail, tone: "busy", scene, action: null };
}

function describeFailure(
  robot: Robot,
  job: Job | null,
  dismissedJobId: string | null,
  base: Base,
): Description | null {
  if (job?.state !== "failed" || job.id === dismissedJobId) return null;
  const error = job.error === null ? null : told(job.error);
  const detail = error === null ? words.state.failedUnnamed : error.detail || `${error.title}.`;
  const headline = {
    charge: words.state.chargeFailed,
    plug_in: words.state.plugInFailed,
    unplug: words.state.unplugFailed,
  }[job.type];
  return {
    ...base,
    ...withPlugNote({ headline, detail }, robot),
    remedy: error?.remedy ?? "",
    tone: "problem",
    scene: { arm: armOf(robot), mark: "alert" },
    help: job.error?.code ?? "job",
    action:
      robot.plug === "inserted"
        ? { kind: "unplug", label: words.action.unplug }
        : { kind: "charge", label: job.type === "unplug" ? words.action.charge : words.action.again },
  };
}

function describeRest({ robot, job, station }: Live, base: Base): Description {
  if (robot.plug === "inserted") {
    const charges = station.online && station.power_w > 0;
    const sentence = charges ? words.state.charging : words.state.pluggedIn;
    const scene: Scene = { arm: "in", mark: charges ? "bolt" : "none" };
    const action: Action = { kind: "unplug", label: words.action.unplug };
    return { ...base, ...sentence, tone: "good", scene, action };
  }
  const scene: Scene = { arm: armOf(robot), mark: "none" };
  const action: Action = { kind: "charge", label: words.action.charge };
  const others: Action[] = [{ kind: "plan", label: words.action.plan }];
  return { ...base, ...restSentence(robot, job), tone: "calm", scene, action, others };
}

function restSentence(robot: Robot, job: Job | null): Sentence {
  if (robot.mode === "off") return words.state.off;
  if (robot.mode === "not_homed") return words.state.notHomed;
  if (job?.type === "charge" && job.state === "succeeded" && isRecent(robot, job)) {
    const energy_wh = job.result.energy_wh ?? null;
    if (energy_wh === null || energy_wh <= 0) return words.state.readyAfterCharge;
    return { ...words.state.readyAfterCharge, detail: words.state.charged(formatEnergy(energy_wh)) };
  }
  return robot.plug === "free" ? words.state.free : words.state.ready;
}

/** By the server's clock alone. */
function isRecent(robot: Robot, job: Job): boolean {
  return Date.parse(robot.updated_at) - Date.parse(job.updated_at) < NEWS_MS;
}

function pause(): Action {
  return { kind: "pause", label: words.action.pause };
}

function cancel(): Action {
  return { kind: "cancel", label: words.action.cancel };
}

/** Why the robot stands still. */
function faultSentence({ fault }: Robot): Sentence | null {
  if (fault === null) return null;
  const { title, detail } = told(fault);
  return { headline: title, detail };
}

function remedyOf({ fault }: Robot): string | null {
  return fault === null ? null : told(fault).remedy;
}

/** What a person is asked: in the server's one sentence, or translated in two. */
function askedOf({ code, sentence }: NeedsPerson): Pick<Description, "detail" | "remedy"> {
  const { title, detail, remedy } = told({ code, title: "", detail: sentence, remedy: "" });
  return { detail: title === "" ? detail : `${title}.`, remedy };
}

function withPlugNote({ headline, detail }: Sentence, robot: Robot): Sentence {
  if (robot.plug !== "inserted") return { headline, detail };
  return { headline, detail: `${words.state.stillPlugged} ${detail}`.trimEnd() };
}
