/** Whether this software has been updated since somebody looked at this page in this browser. */
import { computed, effect, signal } from "@preact/signals";
import { store } from "@/live/page";
import { keep, kept } from "../parts/kept";

const KEPT_AS = "plugpilot.version.seen";

const running = computed(() => store.live.value?.service.version ?? null);
const seen = signal(kept("localStorage", KEPT_AS));

/** The version that is new here; null when somebody has seen it. */
export const updatedTo = computed(() =>
  seen.value === null || seen.value === running.value ? null : running.value,
);

/** Somebody wants to read what is new. */
export const newsWanted = signal(false);

/** What is new has been read, or put away. */
export function putAway(): void {
  seen.value = running.value;
  keep("localStorage", KEPT_AS, running.value ?? "");
}

/** A browser that was never here has nothing to compare with. */
export const watchForFirstVisit = (): (() => void) =>
  effect(() => {
    if (running.value !== null && seen.value === null) putAway();
  });
