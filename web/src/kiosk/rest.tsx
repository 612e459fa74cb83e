import { useEffect } from "preact/hooks";
import { description } from "@/robot/view";
import { words } from "@/words";
import { Clock } from "./clock";
import { resting, watchHands } from "./resting";

/** A dark clock with the state in one line. The touch that wakes it presses nothing else. */
export function Rest() {
  useEffect(() => watchHands(), []);
  if (!resting.value) return null;
  const { headline, tone } = description.value;
  return (
    <button
      type="button"
      class="rest"
      data-tone={tone}
      // On the click, not on the first contact: the finger has left before anything else is there.
      onClick={() => {
        resting.value = false;
      }}
    >
      <Clock />
      <span class="rest-state">{headline}</span>
      <span class="unseen">{words.action.wake}</span>
    </button>
  );
}
