import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { late } from "@/api/late";
import { formatDate } from "@/format";
import type { TrailWords } from "@/language/types";
import { listTrail, TRAIL_EXPORT } from "./calls";
import type { TrailEntry } from "./calls";
import type { Run } from "./menu";
import { callerOf, titleOf } from "./trail-entry";
import { trailWords } from "./trail-words";
import { say } from "./words";

/** Who did what, from where. */
export function Trail({ run }: { run: Run }) {
  const security = useSignal(true);
  const entries = useSignal<readonly TrailEntry[] | null>(null);
  const next = useSignal<string | null>(null);
  const spoken = useSignal<TrailWords | null>(null);
  const load = async (cursor: string | null): Promise<void> => {
    const [page, loaded] = await Promise.all([listTrail(security.value, cursor), late(trailWords())]);
    spoken.value = loaded;
    entries.value = [...(cursor === null ? [] : (entries.value ?? [])), ...page.items];
    next.value = page.next_cursor;
  };
  useEffect(() => run(() => load(null)), [security.value]);
  const words = spoken.value;
  if (entries.value === null || words === null) return <p class="soft">{say.loading}</p>;
  return (
    <>
      <div class="switch" role="group" aria-label={say.tabs.trail}>
        {[true, false].map((only) => (
          <button
            key={String(only)}
            type="button"
            class="button"
            aria-pressed={security.value === only}
            onClick={() => {
              security.value = only;
            }}
          >
            {only ? say.trail.security : say.trail.everything}
          </button>
        ))}
      </div>
      {entries.value.length === 0 && <p class="soft">{say.none}</p>}
      <ol class="entries trail">
        {entries.value.map((entry) => (
          <li key={entry.sequence} data-event={entry.event}>
            <p>
              {titleOf(entry, words)}
            </p>
            <p class="soft">
              {formatDate(entry.at)}, {callerOf(entry, words)}
              {entry.address !== "" && `, ${entry.address}`}
              {entry.times > 1 && `, ${say.trail.times(entry.times)}`}
            </p>
          </li>
        ))}
      </ol>
      <div class="shown-buttons">
        {next.value !== null && (
          <button type="button" class="button" onClick={() => run(() => load(next.value))}>
            {say.trail.more}
          </button>
        )}
        <a class="button" href={TRAIL_EXPORT} download="">
          {say.trail.download}
        </a>
      </div>
    </>
  );
}
