import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { hearStopKeys } from "@/parts/stop-key";
import { sightIn } from "./sight";
import type { Sight } from "./sight";
import { say } from "./words";

/** The 3D picture, which tells where somebody clicks in it. */
export function TwinFrame({ onPick }: { onPick: (sight: Sight) => void }) {
  const frame = useRef<HTMLIFrameElement>(null);
  const behind = useSignal(false);
  useEffect(() => {
    const listen = (event: MessageEvent<unknown>): void => {
      if (event.origin !== location.origin) return;
      if (event.source !== frame.current?.contentWindow) return;
      const sight = sightIn(event.data);
      if (sight !== null) onPick(sight);
      else if (isAlive(event.data)) behind.value = event.data.twin === "stale";
    };
    addEventListener("message", listen);
    return () => removeEventListener("message", listen);
  }, [onPick]);
  return (
    <div class="view" data-open="true">
      <p class="view-note">{say.loading}</p>
      <iframe
        ref={frame}
        src="/twin/?pick"
        title={say.frame}
        data-behind={behind.value}
        onLoad={(event) => hearStopKeys(event.currentTarget)}
      />
      {behind.value && (
        <p class="view-warning" role="status">
          {say.behind}
        </p>
      )}
    </div>
  );
}

function isAlive(data: unknown): data is { twin: string } {
  return typeof data === "object" && data !== null && "twin" in data;
}
