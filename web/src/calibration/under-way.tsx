import { may } from "@/access/session";
import { formatDate, formatDuration } from "@/format";
import { TroubleWords } from "@/technician/parts/trouble";
import { busy, cancel, resume } from "./desk";
import { BoardWatch } from "./board/watch";
import { useTimeLeft } from "./pace";
import { CameraSwitch } from "./picture";
import { LookMap } from "./plots/look-map";
import { QuestionForm } from "./question";
import { ROUTINES } from "./routines";
import { doingOf, DOINGS } from "./translated";
import type { Routine, RoutineKind } from "./types";
import { say } from "./words";

const ROUND_S = 5;

/** How far the routine is. It can be ended at any time, and goes on where it was interrupted. */
export function UnderWay({ routine }: { routine: Routine }) {
  const { kind, done, looks, begun_by, begun_at, problem, state } = routine;
  const total = routine.total || ROUTINES[kind].looks;
  const left_s = Math.ceil(useTimeLeft(routine) / ROUND_S) * ROUND_S;
  const interrupted = state === "interrupted";
  const asks = interrupted ? null : (routine.asks ?? null);
  const { needsLabel, plugIn } = ROUTINES[kind];
  const name = say.routines[kind].name;
  const watching = kind === "camera" && !interrupted && routine.doing === DOINGS.board;
  return (
    <section class="calibration-run" data-tone={interrupted || (asks !== null && !watching) ? "ask" : "busy"}>
      <h3>{name}</h3>
      {watching ? (
        <BoardWatch asks={asks} />
      ) : asks === null ? (
        <p role="status">
          <strong>{interrupted ? say.underWay.interrupted : doingOf(routine.doing)}</strong>
        </p>
      ) : (
        <QuestionForm key={asks.code} asks={asks} />
      )}
      <progress max={total} value={Math.min(done, total)} aria-label={name} />
      <p class="calibration-pace">
        <span>{counted(kind, done, total)}</span>
        {!interrupted && asks === null && kind !== "camera" && <span class="soft">{say.underWay.left(formatDuration(left_s))}</span>}
      </p>
      {problem !== null && <TroubleWords trouble={problem} />}
      {interrupted && (needsLabel || kind === "camera") && !plugIn && <p class="soft small">{say.underWay.interruptedHint}</p>}
      {looks.length > 1 && !plugIn && <LookMap looks={looks} />}
      {needsLabel && <CameraSwitch />}
      <p class="soft small">{say.underWay.by(begun_by, formatDate(begun_at))}</p>
      <div class="calibration-actions">
        {interrupted && (
          <button
            type="button"
            class="button primary"
            disabled={busy.value || !may("service")}
            onClick={() => void resume()}
          >
            {say.underWay.resume}
          </button>
        )}
        <button type="button" class="button" disabled={busy.value || !may("service")} onClick={() => void cancel()}>
          {busy.value ? say.underWay.ending : say.underWay.end}
        </button>
      </div>
    </section>
  );
}

function counted(kind: RoutineKind, done: number, total: number): string {
  if (kind === "camera") return say.board.views(done, total);
  return ROUTINES[kind].needsLabel ? say.underWay.place(done, total) : say.underWay.step(done, total);
}
