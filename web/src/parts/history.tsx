import { useComputed, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Trouble } from "@/api/client";
import type { Job } from "@/api/wire";
import { formatDate, formatSize } from "@/format";
import { history, historyTrouble, loadHistory, outcomeOf } from "@/jobs/history";
import { watchAgain } from "@/jobs/replay";
import { told } from "@/language/problems";
import { store } from "@/live/page";
import { words } from "@/words";

/** The jobs of the past, closed until asked for. */
export function History() {
  const open = useSignal(false);
  return (
    <details
      class="card history"
      onToggle={(event) => {
        open.value = event.currentTarget.open;
      }}
    >
      <summary>
        <h2>{words.history.title}</h2>
      </summary>
      {open.value && <Jobs />}
    </details>
  );
}

function Jobs() {
  // A job that ends, and a recording that is complete, belong on the list.
  const newest = useComputed(() => {
    const job = store.live.value?.job;
    return `${job?.id ?? ""} ${job?.state ?? ""} ${String(job?.recording?.size_bytes)}`;
  }).value;
  useEffect(() => {
    void loadHistory();
  }, [newest]);
  if (historyTrouble.value !== null) return <p class="soft">{whyNot(historyTrouble.value)}</p>;
  if (history.value === null) return <p class="soft">{words.views.loading}</p>;
  if (history.value.length === 0) return <p class="soft">{words.history.none}</p>;
  return (
    <ol class="past">
      {history.value.map((job) => (
        <Row key={job.id} job={job} />
      ))}
    </ol>
  );
}

/** What happened, or where that is known in English only, what it is called. */
function whyNot(trouble: Trouble): string {
  const { title, detail } = told(trouble);
  return detail === "" ? `${title}.` : detail;
}

function Row({ job }: { job: Job }) {
  const say = words.history;
  const { recording } = job;
  const date = formatDate(job.created_at);
  return (
    <li data-state={job.state}>
      <div>
        <p class="past-outcome">{outcomeOf(job)}</p>
        <p class="soft">
          <time dateTime={job.created_at}>{date}</time>
        </p>
      </div>
      {recording == null ? (
        <p class="soft past-none">{say.notRecorded}</p>
      ) : (
        <div class="past-buttons">
          <button type="button" class="button" onClick={() => void watchAgain(job)}>
            {say.watch}
            <span class="unseen">, {date}</span>
          </button>
          <a
            class="button"
            href={`/api/v1/jobs/${encodeURIComponent(job.id)}/recording`}
            download=""
          >
            {say.download} <span class="soft">{formatSize(recording.size_bytes)}</span>
            <span class="unseen">, {date}</span>
          </a>
        </div>
      )}
    </li>
  );
}
