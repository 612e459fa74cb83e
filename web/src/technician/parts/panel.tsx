import { useSignal } from "@preact/signals";
import type { ComponentType } from "preact";

interface PanelProps {
  readonly title: string;
  /** What is in it, in a few words. */
  readonly hint: string;
  /** Made when the panel is opened, gone when it is closed. */
  readonly body: ComponentType;
}

/** A card that does nothing, and loads nothing, before it is opened. */
export function Panel({ title, hint, body: Body }: PanelProps) {
  const open = useSignal(false);
  return (
    <details
      class="card panel"
      onToggle={(event) => {
        open.value = event.currentTarget.open;
      }}
    >
      <summary>
        <h2>{title}</h2>
        <span class="panel-hint">{hint}</span>
      </summary>
      {open.value && (
        <div class="panel-body">
          <Body />
        </div>
      )}
    </details>
  );
}
