import { useComputed } from "@preact/signals";
import { formatDuration } from "@/format";
import { store } from "@/live/page";
import { isActive, phaseElapsedS, stepsOf } from "@/robot/job";
import type { Step } from "@/robot/job";
import { words } from "@/words";
import { TimeLeft } from "./time-left";

/** How long the running job still takes, and its steps. */
export function Progress() {
  const job = store.live.value?.job ?? null;
  if (!isActive(job)) return null;
  return (
    <section class="card" data-stale={store.stale.value}>
      <h2>{words.steps.title}</h2>
      <TimeLeft />
      <ol class="steps">
        {stepsOf(job).map((step) => (
          <StepRow key={step.phase} step={step} />
        ))}
      </ol>
    </section>
  );
}

function StepRow({ step }: { step: Step }) {
  const { phase, state } = step;
  return (
    <li class="step" data-state={state} aria-current={state === "now" ? "step" : undefined}>
      <span class="step-dot" aria-hidden="true" />
      <span class="step-name">
        {words.phases[phase].step}
        {state === "done" && <span class="unseen">, {words.steps.done}</span>}
      </span>
      {state === "now" && <Elapsed />}
    </li>
  );
}

function Elapsed() {
  const text = useComputed(() => {
    const live = store.live.value;
    return live === null ? "" : formatDuration(phaseElapsedS(live));
  });
  return <span class="step-time">{text}</span>;
}
