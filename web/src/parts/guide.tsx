import { signal } from "@preact/signals";
import type { FunctionComponent } from "preact";
import { useEffect } from "preact/hooks";
import { Refusal } from "@/api/client";
import { late } from "@/api/late";
import { trouble } from "@/robot/actions";
import { description } from "@/robot/view";
import { words } from "@/words";

/** Whether the steps are on the screen. */
export const guideOpen = signal(false);

const Loaded = signal<FunctionComponent | null>(null);

/** Loads the steps when they are first asked for: the home page stays small. */
async function openGuide(): Promise<void> {
  try {
    Loaded.value ??= await late(import("@/guides/dialog").then(({ loadGuide }) => loadGuide()));
    guideOpen.value = true;
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    trouble.value = error.trouble;
  }
}

/** Offers the steps in every state that asks a person to do something. */
export function GuideButton() {
  if (description.value.help === null) return null;
  return (
    <button type="button" class="button guide-button" onClick={() => void openGuide()}>
      <svg viewBox="0 0 24 24" aria-hidden="true">
        <path d="M4 6h1v4M4 10h2M4 15h2l-2 4h2M10 7h10M10 12h10M10 17h10" />
      </svg>
      {words.action.guide}
    </button>
  );
}

/** The steps. They go as soon as nobody is asked any more. */
export function GuideDialog() {
  const Guide = Loaded.value;
  const asked = description.value.help !== null;
  useEffect(() => {
    if (!asked) guideOpen.value = false;
  }, [asked]);
  return guideOpen.value && Guide !== null && asked ? <Guide /> : null;
}
