import { useSignal, useSignalEffect } from "@preact/signals";
import type { ReadonlySignal } from "@preact/signals";
import type { ComponentType } from "preact";

interface PanelProps {
  readonly title: string;
  /** What is in it, in a few words. */
  readonly hint: string;
  /** Made when the panel is opened, gone when it is closed. */
  readonly body: ComponentType;
  /** Opens by itself whenever this comes true. */
  readonly wanted?: ReadonlySignal<boolean>;
  /** Hears when it is opened or closed. */
  readonly onToggled?: (open: boolean) => void;
}

/** A card that does nothing, and loads nothing, before it is opened. */
export function Panel({ title, hint, body: Body, wanted, onToggled }: PanelProps) {
  const open = useSignal(false);
  useSignalEffect(() => {
    if (wanted?.value === true) open.value = true;
  });
  return (
    <details
      class="card panel"
      open={open.value}
      onToggle={(event) => {
        open.value = event.currentTarget.open;
        onToggled?.(open.value);
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
