/** The place somebody has pointed at, the way there, and the hand that lets the robot go. */
import { computed, effect, signal } from "@preact/signals";
import { call, Refusal } from "@/api/client";
import type { Trouble } from "@/api/client";
import type { MoveTarget, Robot } from "@/api/wire";
import { channel, store } from "@/live/page";
import { Grip } from "../jog/dead-man";
import { speed_mm_s, troubleOf } from "../jog/jog";
import { say as bench } from "../words";
import type { Place } from "./sight";

const THERE_MM = 0.2;
/** The server takes a way only from where it begins; positions come rounded to micrometres. */
const LEFT_MM = 0.003;

/** The way that was planned and checked; null while there is none. */
export const target = signal<MoveTarget | null>(null);
export const choosing = signal(false);
export const arrived = signal(false);
export const trouble = signal<Trouble | null>(null);

export const grip = new Grip<string>(
  channel,
  (a, b) => a === b,
  (ending) => {
    const robot = store.live.peek()?.robot;
    const chosen = target.value;
    if (chosen !== null && robot !== undefined && isThere(robot, chosen)) arrive();
    else if (chosen !== null && ending.kind === "refused" && ending.problem?.code === "target_gone")
      void choose({ x_mm: chosen.tip.x_mm, y_mm: chosen.tip.y_mm }); // shown anew, to be held anew
    else trouble.value = ending.kind === "no_answer" ? bench.jog.noAnswer : troubleOf(ending.problem);
  },
);

/** The way shown is one that the robot can go now: it begins where the robot stands. */
export const beginsHere = computed(() => {
  const robot = store.live.value?.robot;
  return robot !== undefined && target.value !== null && !choosing.value && !hasLeft(robot, target.value);
});

/** Asks for the way to a place; nothing moves. */
export async function choose(place: Place): Promise<void> {
  grip.release();
  choosing.value = true;
  arrived.value = false;
  trouble.value = null;
  try {
    const body = { ...place, speed_mm_s: speed_mm_s.peek() };
    target.value = await call<MoveTarget>("/robot/target", { method: "POST", body });
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    target.value = null;
    trouble.value = error.trouble;
  } finally {
    choosing.value = false;
  }
}

/** A hand holds the button: the robot may go. */
export function hold(): void {
  const chosen = target.value;
  if (chosen === null) return;
  trouble.value = null;
  grip.take(chosen.id, { type: "move_to", target_id: chosen.id });
}

/** Nobody wants to go there any more. */
export async function forget(): Promise<void> {
  grip.release();
  target.value = null;
  trouble.value = null;
  try {
    await call("/robot/target", { method: "DELETE" });
  } catch (error) {
    if (!(error instanceof Refusal)) throw error; // it is forgotten when the robot moves
  }
}

/**
 * Watches where the robot is: at the place the hand has nothing more to do; on the way, after
 * letting go, the way that is left is asked for.
 */
export function followTarget(): () => void {
  let plannedFrom = "";
  return effect(() => {
    const robot = store.live.value?.robot;
    const chosen = target.value;
    if (robot === undefined || chosen === null || robot.mode !== "ready") return;
    if (isThere(robot, chosen)) arrive();
    else if (grip.held.value === null && !choosing.value && hasLeft(robot, chosen)) {
      const from = JSON.stringify(robot.commanded?.joints);
      if (from === plannedFrom) return; // once from each place, whatever the answer says
      plannedFrom = from;
      void choose({ x_mm: chosen.tip.x_mm, y_mm: chosen.tip.y_mm });
    }
  });
}

function arrive(): void {
  grip.release();
  target.value = null;
  arrived.value = true;
}

const isThere = ({ commanded }: Robot, { joints }: MoveTarget): boolean =>
  commanded !== null && farthest(commanded.joints, joints) < THERE_MM;

function hasLeft({ commanded }: Robot, { way }: MoveTarget): boolean {
  const [from] = way;
  if (commanded?.tip == null || from === undefined) return false;
  const { x_mm, y_mm, z_mm } = commanded.tip;
  return Math.hypot(x_mm - from.x_mm, y_mm - from.y_mm, z_mm - from.z_mm) > LEFT_MM;
}

const farthest = (a: MoveTarget["joints"], b: MoveTarget["joints"]): number =>
  Math.max(
    Math.abs(a.rho1_mm - b.rho1_mm),
    Math.abs(a.rho2_mm - b.rho2_mm),
    Math.abs(a.rho3_mm - b.rho3_mm),
  );
