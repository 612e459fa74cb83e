import { signal } from "@preact/signals";
import type { FunctionComponent } from "preact";
import { useEffect } from "preact/hooks";
import { say } from "../words";

/** The body of a panel that is fetched when the panel is opened for the first time. */
export function later(load: () => Promise<FunctionComponent>): FunctionComponent {
  const loaded = signal<FunctionComponent | null>(null);
  const failed = signal(false);
  return function Later() {
    useEffect(() => {
      if (loaded.peek() !== null) return;
      failed.value = false;
      load().then(
        (body) => {
          loaded.value = body;
        },
        (error: unknown) => {
          if (!(error instanceof TypeError)) throw error; // how browsers say: could not be fetched
          failed.value = true;
        },
      );
    }, []);
    const Body = loaded.value;
    if (Body !== null) return <Body />;
    return <p class="panel-note">{failed.value ? say.panel.away : say.panel.loading}</p>;
  };
}
