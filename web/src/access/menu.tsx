import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Signal } from "@preact/signals";
import { Refusal } from "@/api/client";
import { told } from "@/language/problems";
import { Modal } from "@/parts/modal";
import { Keys } from "./keys";
import { Own } from "./own";
import { People } from "./people";
import { may } from "./session";
import { Trail } from "./trail";
import { say } from "./words";

type Tab = keyof typeof say.tabs;

const ALL: readonly Tab[] = ["people", "keys", "trail", "own"];

/** People, keys and the trail for the owner; one's own device for everybody. */
export function Menu({ onClose }: { onClose: () => void }) {
  const tabs = may("admin") ? ALL : (["own"] as const);
  const tab = useSignal<Tab>(tabs[0]!);
  const trouble = useSignal<string | null>(null);
  const run: Run = (work) => {
    trouble.value = null;
    void work().catch((error: unknown) => {
      if (!(error instanceof Refusal)) throw error;
      const { title, remedy } = told(error.trouble);
      trouble.value = `${title}. ${remedy}`;
    });
  };
  return (
    <Modal title={say.menu} wide onClose={onClose}>
      {tabs.length > 1 && (
        <div class="switch tabs" role="group" aria-label={say.menu}>
          {tabs.map((each) => (
            <button
              key={each}
              type="button"
              class="button"
              aria-pressed={tab.value === each}
              onClick={() => {
                tab.value = each;
              }}
            >
              {say.tabs[each]}
            </button>
          ))}
        </div>
      )}
      {trouble.value !== null && (
        <p class="door-trouble" role="alert">
          {trouble.value}
        </p>
      )}
      <div class="menu-page">
        {tab.value === "people" && <People run={run} />}
        {tab.value === "keys" && <Keys run={run} />}
        {tab.value === "trail" && <Trail run={run} />}
        {tab.value === "own" && <Own run={run} onGone={onClose} />}
      </div>
      <button type="button" class="button text" onClick={onClose}>
        {say.people.done}
      </button>
    </Modal>
  );
}

/** Does something; what goes wrong is shown in the dialog. */
export type Run = (work: () => Promise<void>) => void;

/** A list from the server: loaded at once, and again after every change. */
export function useList<Item>(
  run: Run,
  load: () => Promise<readonly Item[]>,
): [Signal<readonly Item[] | null>, () => Promise<void>] {
  const items = useSignal<readonly Item[] | null>(null);
  const reload = async (): Promise<void> => {
    items.value = await load();
  };
  useEffect(() => run(reload), []);
  return [items, reload];
}

/** A press that cannot be undone takes two. */
export function SureButton({ label, onSure }: { label: string; onSure: () => void }) {
  const asked = useSignal(false);
  return (
    <button
      type="button"
      class={asked.value ? "button danger" : "button"}
      onBlur={() => {
        asked.value = false;
      }}
      onClick={() => {
        if (asked.value) onSure();
        asked.value = !asked.value;
      }}
    >
      {asked.value ? say.people.sure : label}
    </button>
  );
}
