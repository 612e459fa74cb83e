import { useEffect } from "preact/hooks";
import { pressStop, stopping } from "@/robot/actions";
import type { StopKind } from "@/api/wire";
import { description } from "@/robot/view";
import { words } from "@/words";
import { deadMan } from "./jog/jog";
import { grip } from "./target/target";
import { say } from "./words";

/** Both stops, always in sight. While anything moves, the space bar and Escape press the first. */
export function Stops() {
  useEffect(() => {
    const onKey = (event: KeyboardEvent): void => {
      if (event.repeat || (event.key !== " " && event.key !== "Escape")) return;
      const held = deadMan.held.peek() ?? grip.held.peek();
      if (!description.peek().stoppable && held === null) return;
      event.preventDefault();
      event.stopPropagation();
      stopNow("stop");
    };
    addEventListener("keydown", onKey, { capture: true });
    return () => removeEventListener("keydown", onKey, { capture: true });
  }, []);
  return <StopButtons />;
}

/** The two buttons. */
export function StopButtons() {
  return (
    <section class="stops" aria-label={say.stop.hint}>
      <StopButton kind="stop" label={stopping.value ? words.action.stopping : say.stop.protective} />
      <StopButton kind="emergency_stop" label={say.stop.emergency} />
    </section>
  );
}

function stopNow(kind: StopKind): void {
  deadMan.release();
  grip.release();
  pressStop(kind);
}

function StopButton({ kind, label }: { kind: StopKind; label: string }) {
  return (
    <button
      type="button"
      class={kind === "stop" ? "stop" : "stop emergency"}
      // Stops as soon as the finger touches, not when it lifts.
      onPointerDown={() => stopNow(kind)}
      onClick={(event) => {
        if (event.detail === 0) stopNow(kind); // from a keyboard or a screen reader
      }}
    >
      {label}
    </button>
  );
}
