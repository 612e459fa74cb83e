import { pressStop, stopping } from "@/robot/actions";
import { description } from "@/robot/view";
import { words } from "@/words";

/** Stop, set apart from every other button and never asked about, while anything moves. */
export function StopBar() {
  if (!description.value.stoppable) return null;
  return (
    <section class="stop-bar" aria-label={words.action.stopHint}>
      <button
        type="button"
        class="stop"
        // Stops as soon as the finger touches, not when it lifts.
        onPointerDown={() => pressStop("stop")}
        onClick={(event) => {
          if (event.detail === 0) pressStop("stop"); // from a keyboard or a screen reader
        }}
      >
        <svg viewBox="0 0 24 24" aria-hidden="true">
          <path d="M8 2h8l6 6v8l-6 6H8l-6-6V8z" />
        </svg>
        {stopping.value ? words.action.stopping : words.action.stop}
      </button>
    </section>
  );
}
