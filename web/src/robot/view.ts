/** What the page shows now: the description of the live state, or of the lack of one. */
import { computed, signal } from "@preact/signals";
import { may } from "@/access/session";
import { store } from "@/live/page";
import { words } from "@/words";
import { describe } from "./describe";
import type { Description } from "./describe";

/** The failed job whose message the reader has put away. */
export const dismissedJobId = signal<string | null>(null);

const withoutRobot = (sentence: { headline: string; detail: string }): Description => ({
  ...sentence,
  remedy: "",
  tone: "calm",
  scene: { arm: "parked", mark: "asleep" },
  action: null,
  others: [],
  stoppable: false,
  help: null,
});

function describePage(): Description {
  const live = store.live.value;
  if (store.outdated.value) return withoutRobot(words.state.outdated);
  if (live === null) {
    return withoutRobot(store.unreachable.value ? words.state.unreachable : words.state.connecting);
  }
  const description = describe(live, dismissedJobId.value);
  if (!store.unreachable.value) return description;
  // Stop stays where it was: it is tried over REST even without the live connection.
  const { scene, stoppable } = description;
  return {
    ...withoutRobot(words.state.unreachable),
    tone: "problem",
    scene: { arm: scene.arm, mark: "asleep" },
    stoppable,
  };
}

let newest: Description | null = null;

/** Changes only when something to be read or seen changes, not with every measurement. */
export const description = computed(() => {
  const next = describePage();
  if (JSON.stringify(next) !== JSON.stringify(newest)) newest = next;
  return newest ?? next;
});

/** Buttons work only on what is known now, and for those who may operate the robot. */
export const canAct = computed(
  () => store.link.value === "live" && !store.stale.value && may("operate"),
);
