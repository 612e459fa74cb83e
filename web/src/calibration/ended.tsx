import { TroubleWords } from "@/technician/parts/trouble";
import { CheckView } from "./check";
import { open, putAway } from "./desk";
import type { Routine } from "./types";
import { VersionView } from "./version";
import { say } from "./words";

/** How the routine ended: what came of it, or why nothing did. */
export function Ended({ routine }: { routine: Routine }) {
  const { kind, calibration_id, check_id, problem, state, figures } = routine;
  const words = say.routines[kind];
  if (calibration_id !== null) {
    return <VersionView id={calibration_id} title={words.done} figures={figures ?? []} onClose={putAway} />;
  }
  if (check_id != null) return <CheckView id={check_id} title={words.done} onClose={putAway} />;
  return (
    <section class="calibration-ended">
      <h3>{words.name}</h3>
      <p>
        <strong>{state === "failed" ? say.ended.failed : say.ended.cancelled}.</strong> {say.ended.nothing}
      </p>
      {problem !== null && <TroubleWords trouble={problem} />}
      <div class="calibration-actions">
        <button
          type="button"
          class="button primary"
          onClick={() => {
            putAway();
            open({ what: "guide", kind });
          }}
        >
          {say.ended.again}
        </button>
        <button type="button" class="button" onClick={putAway}>
          {say.ended.close}
        </button>
      </div>
    </section>
  );
}
