import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { may } from "@/access/session";
import type { Trouble } from "@/api/client";
import { formatNumber } from "@/format";
import { store } from "@/live/page";
import { followPictures } from "@/technician/camera/follow";
import type { Pictured } from "@/technician/camera/follow";
import { TroubleNote } from "@/technician/parts/trouble";
import "./board.css";
import { answer, busy } from "../desk";
import { CoverageMap } from "../plots/coverage";
import type { BoardLook, Question } from "../types";
import { say } from "../words";
import { HandButtons, holdAt } from "./hand";
import { BoardOverlay } from "./overlay";
import { holdFor } from "./wish";

/** Where there is nothing left to be watched: the routine has just ended, and the page will say so. */
const OVER = "calibration_none";

/** The live picture, what to do next, and where the board has been. */
export function BoardWatch({ asks }: { asks: Question | null }) {
  const shown = useSignal<Pictured<BoardLook> | null>(null);
  const trouble = useSignal<Trouble | null>(null);
  useEffect(
    () =>
      followPictures<BoardLook>("/calibrations/routine/board", {
        show: (next) => {
          trouble.value = null;
          shown.value = next;
        },
        fail: (why) => {
          trouble.value = why.code === OVER ? null : why;
        },
      }),
    [],
  );
  const look = shown.value?.look ?? null;
  const byHand = (store.live.value?.service.simulated_parts.includes("camera") ?? false) && may("service");
  return (
    <div class="board">
      <Wanted look={look} />
      <div class="board-views">
        <Picture shown={shown.value} byHand={byHand} />
        {look !== null && <CoverageMap counts={look.coverage} />}
      </div>
      <TroubleNote trouble={trouble.value} />
      <p class="soft small">{say.board.sides}</p>
      {byHand && look !== null && <HandButtons wish={look.wish} />}
      {asks !== null && (
        <div class="board-enough">
          <p class="soft small">{say.board.enoughHint}</p>
          <button type="button" class="button" disabled={busy.value || !may("service")} onClick={() => void answer(asks.code, null)}>
            {say.board.enough}
          </button>
        </div>
      )}
    </div>
  );
}

const TONES = {
  no_board: "ask",
  other_board: "problem",
  show_more: "ask",
  moving: "ask",
  blurred: "problem",
  known: "calm",
  taken: "good",
} as const;

/** What the newest picture is good for, and what would tell most next. */
function Wanted({ look }: { look: BoardLook | null }) {
  if (look === null) return <p class="board-wish">{say.board.loading}</p>;
  const { place, attitude } = look.wish;
  return (
    <div class="board-wish">
      <p aria-live="polite">
        {place !== null && <strong>{say.board.places[place]}</strong>}{" "}
        {attitude !== null && <strong>{say.board.attitudes[attitude]}</strong>}
      </p>
      <p>
        <span class="chip" data-tone={TONES[look.notice]}>
          {say.board.notices[look.notice]}
        </span>
      </p>
    </div>
  );
}

interface PictureProps {
  readonly shown: Pictured<BoardLook> | null;
  readonly byHand: boolean;
}

function Picture({ shown, byHand }: PictureProps) {
  if (shown === null) {
    return (
      <div class="camera-picture">
        <p class="view-note">{say.board.loading}</p>
      </div>
    );
  }
  const { look, picture } = shown;
  const { width_px, height_px, wish, notice } = look;
  const hold = (event: MouseEvent): void => {
    const box = (event.currentTarget as Element).getBoundingClientRect();
    const right = (2 * (event.clientX - box.left)) / box.width - 1;
    void holdAt({ ...holdFor(wish), right, down: (2 * (event.clientY - box.top)) / box.height - 1 });
  };
  return (
    <div
      class="camera-picture"
      data-taken={notice === "taken"}
      style={{ aspectRatio: `${String(width_px)} / ${String(height_px)}` }}
      {...(byHand ? { onClick: hold } : {})}
    >
      <img src={picture} alt={`${say.board.alt}. ${say.board.notices[notice]}, ${formatNumber(look.corners_px.length, 0)}`} />
      <BoardOverlay look={look} />
    </div>
  );
}
