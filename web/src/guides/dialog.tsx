import type { FunctionComponent } from "preact";
import { may } from "@/access/session";
import { Modal } from "@/parts/modal";
import { guideOpen } from "@/parts/guide";
import { carryOut, pending, press } from "@/robot/actions";
import { canAct, description } from "@/robot/view";
import { words } from "@/words";
import { Drawing } from "./drawings";
import { guideOf } from "./guides";
import "./guides.css";
import { ready, say } from "./words";

/** The dialog, as soon as it has words. */
export async function loadGuide(): Promise<FunctionComponent> {
  await ready;
  return Guide;
}

/** What to do about the state that is shown, step by step, and the button that goes on. */
function Guide() {
  const { headline, help } = description.value;
  if (help === null) return null;
  return (
    <Modal
      title={headline}
      onClose={() => {
        guideOpen.value = false;
      }}
    >
      <ol class="guide" data-about={help}>
        {guideOf(help).map((step) => (
          <li key={step}>
            <Drawing step={step} />
            <p>{say.steps[step]}</p>
          </li>
        ))}
      </ol>
      <GoOn />
    </Modal>
  );
}

function GoOn() {
  const { action, others, help } = description.value;
  // Whoever has followed these steps has answered what the question would ask.
  const asksAll = help !== null && guideOf(help).includes("clear");
  const disabled = pending.value || !canAct.value;
  const close = (): void => {
    guideOpen.value = false;
  };
  const shown = may("operate") ? [action, ...others].filter((each) => each !== null) : [];
  return (
    <>
      {shown.map(({ kind, label }, index) => (
        <button
          key={kind}
          type="button"
          class={index === 0 ? "button big primary" : "button big"}
          disabled={disabled}
          onClick={() => {
            close();
            if (asksAll) carryOut(kind);
            else press(kind);
          }}
        >
          {label}
        </button>
      ))}
      {action?.kind === "confirm_plug" && may("operate") && (
        <button
          type="button"
          class="button big"
          disabled={disabled}
          onClick={() => {
            close();
            press("unplug");
          }}
        >
          {words.action.plugIn}
        </button>
      )}
      {action === null && <p class="soft">{say.waits}</p>}
      <button type="button" class="button text" onClick={close}>
        {say.back}
      </button>
    </>
  );
}
