/** What the technician has chosen for jogging, and what the buttons do. */
import { computed, signal } from "@preact/signals";
import { may } from "@/access/session";
import type { Trouble } from "@/api/client";
import type { Problem } from "@/api/wire";
import { otherHolder } from "@/control/state";
import { channel, store } from "@/live/page";
import { canAct } from "@/robot/view";
import { words } from "@/words";
import { say } from "../words";
import type { Frame, Way } from "./axes";
import { DeadMan } from "./dead-man";

export const SPEEDS_MM_S = [1, 2, 5, 10, 20] as const;
/** Hold-to-move, or steps of so many millimetres. */
export const STEPS_MM = ["hold", 0.1, 1, 10] as const;
export type Step = (typeof STEPS_MM)[number];

/** The frame of the buttons. */
export const frame = signal<Frame>("base");
export const step = signal<Step>("hold");
/** Slow until somebody asks for more. */
export const speed_mm_s = signal<(typeof SPEEDS_MM_S)[number]>(5);
/** Why the last motion did not happen or ended. */
export const trouble = signal<Trouble | null>(null);
/** A step that is under way. */
export const stepping = signal(false);

const STEP_PATIENCE_MS = 20_000;

export const deadMan = new DeadMan(channel, (ending) => {
  trouble.value = ending.kind === "no_answer" ? say.jog.noAnswer : troubleOf(ending.problem);
});

/** Why nothing can be jogged now; null when it can. */
export const hindrance = computed((): string | null => {
  const robot = store.live.value?.robot;
  if (!may("service")) return say.jog.notAllowed;
  if (robot === undefined || !canAct.value) return say.jog.notLive;
  if (otherHolder.value !== null) return say.jog.controlled(otherHolder.value.person.name);
  const mine = deadMan.held.value !== null || stepping.value;
  switch (robot.mode) {
    case "ready":
      break;
    case "moving":
      if (!mine) return say.jog.busy;
      break;
    default:
      return say.jog.not[robot.mode];
  }
  if (robot.control !== null && robot.control.kind !== "jog") {
    const doing = words.control.doing[robot.control.kind];
    return say.jog.controlled(doing.charAt(0).toUpperCase() + doing.slice(1));
  }
  return null;
});

/** The plug may be in a socket: out of it along the axis is the only way to move. */
export const onlyOut = computed(() => {
  const plug = store.live.value?.robot.plug;
  return plug === "inserted" || plug === "unknown";
});

/** Whether a way is open now, as far as the page knows; the server decides. */
export function isOpen({ axis, direction }: Way): boolean {
  if (hindrance.value !== null) return false;
  const out = (axis === "insertion" || axis === "rho3") && direction === -1;
  return out || !onlyOut.value;
}

/** A button went down. */
export function press(way: Way): void {
  if (!isOpen(way) || stepping.value) return;
  trouble.value = null;
  if (step.value === "hold") deadMan.hold(way, speed_mm_s.value);
  else void moveBy(way, step.value);
}

async function moveBy({ axis, direction }: Way, distance_mm: number): Promise<void> {
  stepping.value = true;
  try {
    const reply = await channel.ask(
      {
        type: "jog_step",
        step: { axis, distance_mm: direction * distance_mm, speed_mm_s: speed_mm_s.value },
      },
      STEP_PATIENCE_MS,
    );
    if (reply === null) trouble.value = say.jog.noAnswer;
    else if (!reply.ok) trouble.value = troubleOf(reply.problem ?? null);
  } finally {
    stepping.value = false;
  }
}

export function troubleOf(problem: Problem | null): Trouble {
  if (problem === null) return say.jog.noAnswer;
  const { code, title, detail, remedy } = problem;
  return { code, title, detail, remedy };
}
