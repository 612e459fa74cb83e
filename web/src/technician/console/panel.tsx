import { useComputed, useSignal } from "@preact/signals";
import type { Signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { call } from "@/api/client";
import type { Trouble } from "@/api/client";
import type { ProtocolFrame, ProtocolFrames } from "@/api/wire";
import { download } from "../parts/download";
import { Panel } from "../parts/panel";
import { poll } from "../parts/poll";
import { TroubleNote } from "../parts/trouble";
import { grown, lineOf, matches, timeOf, WORTH_SEEING } from "./tail";
import type { Filter } from "./tail";
import { say } from "./words";

const PAUSE_MS = 150;
const SHOWN = 300;

/** What goes over the link to the motion board; the server listens only while this is open. */
export function ConsolePanel() {
  return <Panel title={say.title} hint={say.hint} body={Console} />;
}

function Console() {
  const frames = useSignal<readonly ProtocolFrame[]>([]);
  const available = useSignal(true);
  const lost = useSignal(0);
  const paused = useSignal(false);
  const trouble = useSignal<Trouble | null>(null);
  const filter = useSignal<Filter>(WORTH_SEEING);
  const fitting = useComputed(() => frames.value.filter((frame) => matches(frame, filter.value)));
  useEffect(() => {
    let known = 0;
    return poll(
      async () => {
        const found = await call<ProtocolFrames>(`/robot/frames?after=${String(known)}`);
        known = found.newest;
        trouble.value = null;
        available.value = found.available;
        if (paused.peek()) return;
        lost.value += found.lost;
        frames.value = grown(frames.peek(), found.frames);
      },
      (why) => {
        trouble.value = why;
      },
      PAUSE_MS,
    );
  }, []);
  if (!available.value) return <p class="panel-note">{say.unavailable}</p>;
  return (
    <>
      <Filters filter={filter} kinds={kindsOf(frames.value)} />
      <div class="console-actions">
        <Toggle pressed={filter.value.errorsOnly} label={say.errors} press={() => {
          filter.value = { ...filter.value, errorsOnly: !filter.value.errorsOnly };
        }} />
        <Toggle pressed={paused.value} label={paused.value ? say.go : say.pause} press={() => {
          paused.value = !paused.value;
        }} />
        <button type="button" class="button" onClick={() => {
          frames.value = [];
          lost.value = 0;
        }}>
          {say.clear}
        </button>
        <button type="button" class="button" disabled={fitting.value.length === 0} onClick={() => {
          const text = `${fitting.value.map(lineOf).join("\n")}\n`;
          download(new Blob([text], { type: "text/plain" }), say.file);
        }}>
          {say.download}
        </button>
      </div>
      <Frames frames={fitting.value.slice(-SHOWN)} />
      <p class="soft console-count">
        {say.count(fitting.value.length, frames.value.length)} {paused.value && say.paused}{" "}
        {lost.value > 0 && say.lost(lost.value)}
      </p>
      <TroubleNote trouble={trouble.value} />
    </>
  );
}

function Toggle({ pressed, label, press }: { pressed: boolean; label: string; press: () => void }) {
  return (
    <button type="button" class="button" aria-pressed={pressed} onClick={press}>
      {label}
    </button>
  );
}

function Filters({ filter, kinds }: { filter: Signal<Filter>; kinds: readonly string[] }) {
  const change = (changes: Partial<Filter>): void => {
    filter.value = { ...filter.value, ...changes };
  };
  return (
    <div class="console-filters">
      <label class="field">
        <span>{say.direction}</span>
        <select
          value={filter.value.direction}
          onChange={(event) => change({ direction: event.currentTarget.value as Filter["direction"] })}
        >
          {(["both", "to_board", "from_board"] as const).map((each) => (
            <option key={each} value={each}>
              {say.directions[each]}
            </option>
          ))}
        </select>
      </label>
      <label class="field">
        <span>{say.kind}</span>
        <select value={filter.value.kind} onChange={(event) => change({ kind: event.currentTarget.value })}>
          <option value="worth">{say.kinds.worth}</option>
          <option value="all">{say.kinds.all}</option>
          {kinds.map((kind) => (
            <option key={kind} value={kind}>
              {kind}
            </option>
          ))}
        </select>
      </label>
      <label class="field">
        <span>{say.search}</span>
        <input
          type="search"
          value={filter.value.search}
          autoComplete="off"
          spellcheck={false}
          onInput={(event) => change({ search: event.currentTarget.value })}
        />
      </label>
    </div>
  );
}

/** The list; it stays at its end unless somebody has scrolled up to read. */
function Frames({ frames }: { frames: readonly ProtocolFrame[] }) {
  const list = useRef<HTMLOListElement>(null);
  const atEnd = useRef(true);
  useEffect(() => {
    const { current } = list;
    if (current !== null && atEnd.current) current.scrollTop = current.scrollHeight;
  }, [frames]);
  return (
    <ol
      ref={list}
      class="console-frames"
      tabIndex={0}
      aria-label={say.list}
      onScroll={({ currentTarget: box }) => {
        atEnd.current = box.scrollHeight - box.scrollTop - box.clientHeight < 24;
      }}
    >
      {frames.length === 0 && <li class="soft">{say.waiting}</li>}
      {frames.map((frame) => (
        <li key={frame.number} lang="en" data-direction={frame.direction} data-error={frame.error}>
          <time dateTime={frame.at}>{timeOf(frame.at)}</time>
          <span class="console-arrow">{frame.direction === "to_board" ? "→" : "←"}</span>
          <strong>{frame.kind}</strong> <span>{frame.words}</span>
        </li>
      ))}
    </ol>
  );
}

const kindsOf = (frames: readonly ProtocolFrame[]): readonly string[] =>
  [...new Set(frames.map(({ kind }) => kind))].sort();
