import { useComputed } from "@preact/signals";
import type { ComponentChildren } from "preact";
import type { Job, Live } from "@/api/wire";
import { formatDate } from "@/format";
import { told } from "@/language/problems";
import { store } from "@/live/page";
import { cancelWaiting, pending, resumeWaiting } from "@/robot/actions";
import { isActive } from "@/robot/job";
import { canAct } from "@/robot/view";
import { words } from "@/words";

/** What else a person should know: nothing can be saved, or another job waits. */
export function Notices() {
  const storage = useComputed(() => store.live.value?.service.storage ?? null).value;
  const trouble = storage === null ? null : told(storage);
  const waiting = useComputed(() => waitingJob(store.live.value)).value;
  return (
    <>
      <Notice tone="problem" title={words.storage.title} shown={storage !== null}>
        <p>{words.storage.detail}</p>
        <p>
          <strong>{trouble?.title}.</strong> {trouble?.remedy}
        </p>
      </Notice>
      <Notice tone="calm" title={words.waiting.title} shown={waiting !== null}>
        {waiting !== null && <Waiting job={waiting} />}
      </Notice>
    </>
  );
}

interface NoticeProps {
  readonly tone: "problem" | "calm";
  readonly title: string;
  readonly shown: boolean;
  readonly children: ComponentChildren;
}

/** There also while there is nothing to say, so that a screen reader tells what comes. */
function Notice({ tone, title, shown, children }: NoticeProps) {
  return (
    <div role="status" class="notice" data-on={shown} data-tone={tone}>
      {shown && (
        <section class="card">
          <h2>{title}</h2>
          {children}
        </section>
      )}
    </div>
  );
}

function Waiting({ job }: { job: Job }) {
  const say = words.waiting;
  const disabled = pending.value || !canAct.value;
  return (
    <>
      <p>
        {job.paused === true ? say.paused(say.what[job.type]) : say.begins(say.what[job.type], begin(job))}
        {job.unplug_by != null && ` ${say.by(formatDate(job.unplug_by))}`}
      </p>
      <div class="notice-buttons">
        {job.paused === true && (
          <button type="button" class="button" disabled={disabled} onClick={resumeWaiting}>
            {words.action.goOn}
          </button>
        )}
        <button type="button" class="button" disabled={disabled} onClick={cancelWaiting}>
          {say.cancel}
        </button>
      </div>
    </>
  );
}

/** The job that waits behind another one; one that waits alone is the headline already. */
function waitingJob(live: Live | null): Job | null {
  const waiting = live?.queue?.waiting ?? null;
  return waiting?.id === live?.job?.id ? null : waiting;
}

/** When it begins, by the robot's clock. */
function begin(job: Job): string {
  const live = store.live.value;
  const start = job.not_before ?? null;
  if (start !== null && live !== null && Date.parse(start) > Date.parse(live.robot.updated_at)) {
    return words.waiting.at(formatDate(start));
  }
  return isActive(live?.job ?? null) ? words.waiting.after : words.waiting.soon;
}
