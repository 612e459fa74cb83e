import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { notify, notifying, stopNotifying } from "@/installed/push";
import type { Notifying } from "@/installed/push";
import type { Run } from "./menu";
import { say } from "./words";

/** Whether this device is told what happens while nobody looks at the page. */
export function Notifications({ run }: { run: Run }) {
  const state = useSignal<Notifying | null>(null);
  const become = (work: () => Promise<Notifying>): void =>
    run(async () => {
      state.value = await work();
    });
  useEffect(() => become(notifying), []);
  const now = state.value;
  return (
    <section class="notify" aria-busy={now === null}>
      <p class="soft" role="status">
        {say.push[now ?? "off"]}
      </p>
      {(now === "on" || now === "off") && (
        <button
          type="button"
          class="button big"
          onClick={() => become(now === "on" ? stopNotifying : notify)}
        >
          {now === "on" ? say.push.stop : say.push.begin}
        </button>
      )}
    </section>
  );
}
