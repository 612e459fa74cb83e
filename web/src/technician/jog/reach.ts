/** How far each axis can still go, asked for whenever the robot has come to rest somewhere else. */
import { effect, signal } from "@preact/signals";
import { readReach, Refusal } from "@/api/client";
import type { Reach, Robot } from "@/api/wire";
import { store } from "@/live/page";
import type { Way } from "./axes";

/** Null while nobody knows: the robot moves, is not homed, or did not answer. */
export const reach = signal<Reach | null>(null);

export function wayLeft_mm({ axis, direction }: Way): number | null {
  const found = reach.value?.[axis];
  if (found === undefined) return null;
  return direction === -1 ? found.back_mm : found.on_mm;
}

/** Keeps the reach up to date while the pad is shown. Returns how to end it. */
export function followReach(): () => void {
  let known = "";
  return effect(() => {
    const robot = store.live.value?.robot;
    const place = robot === undefined ? "" : placeOf(robot);
    if (place === known) return;
    known = place;
    reach.value = null;
    if (place === "") return;
    readReach().then(
      (found) => {
        if (known === place) reach.value = found;
      },
      (error: unknown) => {
        if (!(error instanceof Refusal)) throw error;
        if (known === place) known = "";
      },
    );
  });
}

/** Where the robot stands, as far as that matters to its reach; empty while it moves. */
function placeOf({ mode, homed, commanded }: Robot): string {
  if (mode !== "ready" || !homed || commanded === null) return "";
  const { rho1_mm, rho2_mm, rho3_mm } = commanded.joints;
  return [rho1_mm, rho2_mm, rho3_mm].map((each) => each.toFixed(1)).join(" ");
}
