import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { may } from "@/access/session";
import { Refusal } from "@/api/client";
import type { Trouble } from "@/api/client";
import { told } from "@/language/problems";
import { store } from "@/live/page";
import { words } from "@/words";
import { answerRequest, askForControl, giveControlBack, withdrawRequest } from "./calls";
import { answer, asked, asking, awaited, inControl, named, otherHolder, rival, secondsLeft } from "./state";
import "./control.css";

/** Somebody asks for control: above everything, and in sight wherever the page stands. */
export function ControlQuestion() {
  const request = asked.value;
  const { busy, found, run } = usePress();
  const reply = (give: boolean) => () => {
    if (request !== null) run(() => answerRequest(request.id, give));
  };
  return (
    <div class="control-question" role="alert" data-on={request !== null}>
      {request !== null && (
        <section class="card">
          <h2>{words.control.asks(named(request.person))}</h2>
          <p>{words.control.asksDetail}</p>
          <Left say={words.control.keptIn} />
          <TroubleLine found={found} />
          <div class="control-buttons">
            <button type="button" class="button" disabled={busy} onClick={reply(false)}>
              {words.control.keep}
            </button>
            <button type="button" class="button primary" disabled={busy} onClick={reply(true)}>
              {words.control.give}
            </button>
          </div>
        </section>
      )}
    </div>
  );
}

/** Somebody else is in control, this person asks for it, or has had an answer. */
export function ControlNotice() {
  const { busy, found, run } = usePress();
  const holder = otherHolder.value;
  const request = asking.value;
  const had = answer.value;
  const shown = request !== null || had !== null || holder !== null;
  return (
    <div class="control-notice" role="status" data-on={shown}>
      {request !== null && holder !== null && (
        <Notice title={words.control.waiting(named(holder.person))} found={found}>
          <Left say={words.control.refusedIn} />
          <button type="button" class="button" disabled={busy} onClick={() => run(withdrawRequest)}>
            {words.control.withdraw}
          </button>
        </Notice>
      )}
      {request === null && had !== null && (
        <Notice title={words.control.answers[had.answer](named(had.by))} found={found}>
          <button
            type="button"
            class="button"
            onClick={() => {
              awaited.value = null;
            }}
          >
            {words.action.dismiss}
          </button>
        </Notice>
      )}
      {request === null && had === null && holder !== null && (
        <Notice title={words.control.held(named(holder.person))} found={found}>
          <p>{rival.value === null ? words.control.heldDetail : words.control.rival(named(rival.value))}</p>
          {may("operate") && (
            <button
              type="button"
              class="button"
              disabled={busy || rival.value !== null || store.stale.value}
              onClick={() => run(askForControl)}
            >
              {words.control.ask}
            </button>
          )}
        </Notice>
      )}
    </div>
  );
}

/** Gives control back before its time is over; nothing while this person is not in control. */
export function GiveBack() {
  const { busy, found, run } = usePress();
  if (!inControl.value) return null;
  return (
    <>
      <button type="button" class="button" disabled={busy} onClick={() => run(giveControlBack)}>
        {words.control.back}
      </button>
      <TroubleLine found={found} />
    </>
  );
}

interface NoticeProps {
  readonly title: string;
  readonly found: Trouble | null;
  readonly children: ComponentChildren;
}

function Notice({ title, found, children }: NoticeProps) {
  return (
    <section class="card">
      <h2>{title}</h2>
      <div class="control-line">{children}</div>
      <TroubleLine found={found} />
    </section>
  );
}

/** Counts down in silence: a screen reader would speak of nothing else. */
function Left({ say }: { say: (seconds: number) => string }) {
  return (
    <p class="soft control-left" aria-hidden="true">
      {say(secondsLeft.value)}
    </p>
  );
}

function TroubleLine({ found }: { found: Trouble | null }) {
  if (found === null) return null;
  const { title, remedy } = told(found);
  return <p class="control-trouble">{`${title}. ${remedy}`}</p>;
}

interface Press {
  readonly busy: boolean;
  readonly found: Trouble | null;
  readonly run: (work: () => Promise<unknown>) => void;
}

/** One press at a time, and why the last one did not work. */
function usePress(): Press {
  const busy = useSignal(false);
  const found = useSignal<Trouble | null>(null);
  const press = async (work: () => Promise<unknown>): Promise<void> => {
    if (busy.value) return;
    busy.value = true;
    found.value = null;
    try {
      await work();
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      found.value = error.trouble;
    } finally {
      busy.value = false;
    }
  };
  return { busy: busy.value, found: found.value, run: (work) => void press(work) };
}
