import { may } from "@/access/session";
import { say } from "@/access/words";
import { otherHolder } from "@/control/state";
import { told } from "@/language/problems";
import { store } from "@/live/page";
import { pending, press, trouble } from "@/robot/actions";
import type { Action, ActionKind } from "@/robot/describe";
import { canAct, description, dismissedJobId } from "@/robot/view";
import { words } from "@/words";
import { GuideButton } from "./guide";
import { Picture } from "./picture";

/** The state of the robot in a picture and a sentence, and the one thing to do about it. */
export function Hero({ without }: { without?: ActionKind }) {
  const { headline, detail, remedy, tone, scene, action, others } = description.value;
  return (
    <section class="hero" data-tone={tone} aria-busy={pending.value}>
      <Picture arm={scene.arm} mark={scene.mark} tone={tone} />
      <div class="hero-text" aria-live="polite" aria-atomic="true">
        <h1>{headline}</h1>
        <p>{detail}</p>
        {remedy !== "" && (
          <p class="remedy">
            <strong>{words.trouble.remedy}</strong> {remedy}
          </p>
        )}
      </div>
      <div class="hero-action">
        <GuideButton />
        {action !== null && may("operate") && <ActionButtons action={action} />}
        {may("operate") && (
          <OtherButtons others={others.filter(({ kind }) => kind !== without)} />
        )}
        {!may("operate") && <p class="soft">{say.watching}</p>}
      </div>
      <TroubleNote />
    </section>
  );
}

/** A stop can be released by everybody; all else is for whoever is in control. */
const isOpen = (kind: ActionKind): boolean =>
  !pending.value && canAct.value && (kind === "reset" || otherHolder.value === null);

function ActionButtons({ action }: { action: Action }) {
  const disabled = !isOpen(action.kind);
  const quiet = description.value.tone === "busy";
  const job = store.live.value?.job;
  const failed = job?.state === "failed" && job.id !== dismissedJobId.value ? job : null;
  return (
    <>
      <button
        type="button"
        class={quiet ? "button big" : "button big primary"}
        disabled={disabled}
        onClick={() => press(action.kind)}
      >
        {pending.value ? words.action.busy : action.label}
      </button>
      {action.kind === "confirm_plug" && (
        <button type="button" class="button big" disabled={disabled} onClick={() => press("unplug")}>
          {words.action.plugIn}
        </button>
      )}
      {failed !== null && (action.kind === "charge" || action.kind === "unplug") && (
        <button
          type="button"
          class="button text"
          onClick={() => {
            dismissedJobId.value = failed.id;
          }}
        >
          {words.action.dismiss}
        </button>
      )}
    </>
  );
}

function OtherButtons({ others }: { others: readonly Action[] }) {
  return (
    <>
      {others.map(({ kind, label }) => (
        <button
          key={kind}
          type="button"
          class="button text"
          disabled={!isOpen(kind)}
          onClick={() => press(kind)}
        >
          {label}
        </button>
      ))}
    </>
  );
}

/** Why the last press did not work, in words, until it is put away or the next press. */
function TroubleNote() {
  const found = trouble.value === null ? null : told(trouble.value);
  return (
    <div role="alert">
      {found !== null && (
        <div class="note">
          <p>
            <strong>{found.title}.</strong> {found.detail}
          </p>
          {found.remedy !== "" && (
            <p>
              <strong>{words.trouble.remedy}</strong> {found.remedy}
            </p>
          )}
          <button
            type="button"
            class="button text"
            onClick={() => {
              trouble.value = null;
            }}
          >
            {words.action.dismiss}
          </button>
        </div>
      )}
    </div>
  );
}
