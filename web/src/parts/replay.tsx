import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Job, Playback } from "@/api/wire";
import { formatDate, formatDuration } from "@/format";
import {
  chapterAt,
  chaptersOf,
  closeReplay,
  playback,
  playbackAddress,
  replayed,
  replayTrouble,
} from "@/jobs/replay";
import { told } from "@/language/problems";
import { words } from "@/words";
import { Modal } from "./modal";

/** A recorded job in the 3D view, over the page. */
export function ReplayDialog() {
  const job = replayed.value;
  if (job === null) return null;
  const trouble = replayTrouble.value === null ? null : told(replayTrouble.value);
  return (
    <Modal key={job.id} title={formatDate(job.created_at)} wide onClose={closeReplay}>
      {trouble !== null && (
        <p role="alert">
          <strong>{trouble.title}.</strong> {trouble.remedy}
        </p>
      )}
      {trouble === null && playback.value === null && (
        <p class="replay replay-note" role="status">
          {words.history.preparing}
        </p>
      )}
      {playback.value !== null && <Player job={job} playback={playback.value} />}
      <button type="button" class="button" onClick={closeReplay}>
        {words.history.close}
      </button>
    </Modal>
  );
}

/** What the 3D view is told, and what it says, about the playback. */
interface PlayerState {
  readonly at: number;
  readonly playing: boolean;
}

/** The 3D view draws and keeps the time; the player around it belongs to the page. */
function Player({ job, playback: { duration_s, marks } }: { job: Job; playback: Playback }) {
  const frame = useRef<HTMLIFrameElement>(null);
  const state = useSignal<PlayerState>({ at: 0, playing: false });
  useEffect(() => {
    const listen = (event: MessageEvent<unknown>): void => {
      if (event.origin !== location.origin) return;
      if (event.source !== frame.current?.contentWindow) return;
      const { data } = event;
      if (typeof data !== "object" || data === null || !("playback" in data)) return;
      state.value = data.playback as PlayerState;
    };
    addEventListener("message", listen);
    return () => removeEventListener("message", listen);
  }, []);
  const tell = (player: Partial<PlayerState>): void => {
    frame.current?.contentWindow?.postMessage({ player }, location.origin);
  };
  const { at, playing } = state.value;
  const chapters = chaptersOf({ duration_s, marks });
  const current = chapterAt(chapters, at);
  const say = words.history;
  return (
    <>
      <iframe ref={frame} class="replay" src={playbackAddress(job)} title={say.player} />
      <div class="player-bar">
        <button
          type="button"
          class="button"
          aria-label={playing ? say.pause : say.play}
          onClick={() => tell({ playing: !playing })}
        >
          <svg viewBox="0 0 24 24" aria-hidden="true">
            <path d={playing ? PAUSE : PLAY} />
          </svg>
        </button>
        <div class="scrub">
          <input
            type="range"
            min={0}
            max={duration_s}
            step={0.05}
            value={at}
            aria-label={say.time}
            aria-valuetext={chapters[current]?.text}
            onInput={(event) => tell({ at: event.currentTarget.valueAsNumber })}
          />
          {chapters.map((chapter) => (
            <i
              key={`${String(chapter.at_s)} ${chapter.text}`}
              data-alarm={chapter.alarm}
              style={{ left: `${String((100 * chapter.at_s) / Math.max(duration_s, 1))}%` }}
            />
          ))}
        </div>
        <span class="player-time">
          {formatDuration(at)} / {formatDuration(duration_s)}
        </span>
      </div>
      <ol class="chapters" aria-label={say.chapters}>
        {chapters.map((chapter, index) => (
          <li key={`${String(chapter.at_s)} ${chapter.text}`}>
            <button
              type="button"
              class="button"
              data-alarm={chapter.alarm}
              aria-current={index === current ? "step" : undefined}
              onClick={() => tell({ at: chapter.at_s, playing: true })}
            >
              {chapter.text}
            </button>
          </li>
        ))}
      </ol>
      <p class="soft">{say.shortened}</p>
    </>
  );
}

const PLAY = "M8 5v14l11-7z";
const PAUSE = "M7 5h4v14H7zM13 5h4v14h-4z";
