import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { formatDate } from "@/format";
import { listTrail, TRAIL_EXPORT } from "./calls";
import type { TrailEntry } from "./calls";
import type { Run } from "./menu";
import { say } from "./words";

/** Who did what, from where. */
export function Trail({ run }: { run: Run }) {
  const security = useSignal(true);
  const entries = useSignal<readonly TrailEntry[] | null>(null);
  const next = useSignal<string | null>(null);
  const load = async (cursor: string | null): Promise<void> => {
    const page = await listTrail(security.value, cursor);
    entries.value = [...(cursor === null ? [] : (entries.value ?? [])), ...page.items];
    next.value = page.next_cursor;
  };
  useEffect(() => run(() => load(null)), [security.value]);
  if (entries.value === null) return <p class="soft">{say.loading}</p>;
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
              {say.events[entry.event] ?? entry.event}
              {factsOf(entry)}
            </p>
            <p class="soft">
              {formatDate(entry.at)}, {entry.actor}
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

/** The facts of an entry that a person wants to see. */
function factsOf({ detail }: TrailEntry): string {
  const shown = ["operation", "name", "role", "device", "code"]
    .map((name) => detail[name])
    .filter((fact) => typeof fact === "string");
  return shown.length === 0 ? "" : `: ${shown.join(", ")}`;
}
