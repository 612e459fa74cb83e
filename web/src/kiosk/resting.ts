/** When the screen rests, and what wakes it. */
import { effect, signal } from "@preact/signals";
import { description } from "@/robot/view";

/** So long after the last touch, or the last thing worth looking at. */
export const REST_AFTER_MS = 60_000;

export const resting = signal(false);

/** Nothing moves and nobody is asked: a dark screen loses nothing. */
function mayRest(): boolean {
  const { tone, stoppable, help } = description.value;
  return !stoppable && help === null && (tone === "calm" || tone === "good");
}

/** Watches the state and the hands; gives back how to end that. */
export function watchHands(): () => void {
  let timer: ReturnType<typeof setTimeout> | null = null;
  const stay = (): void => {
    if (timer !== null) clearTimeout(timer);
    timer = setTimeout(() => {
      const busy = document.querySelector("dialog[open]") !== null;
      if (mayRest() && !busy) resting.value = true;
      else stay();
    }, REST_AFTER_MS);
  };
  // Another headline is worth a look, and whatever may move is never in the dark.
  const endWatch = effect(() => {
    void description.value.headline;
    if (!mayRest()) resting.value = false;
    stay();
  });
  const touched = (): void => stay();
  addEventListener("pointerdown", touched, { capture: true });
  addEventListener("keydown", touched, { capture: true });
  return () => {
    endWatch();
    if (timer !== null) clearTimeout(timer);
    removeEventListener("pointerdown", touched, { capture: true });
    removeEventListener("keydown", touched, { capture: true });
  };
}
