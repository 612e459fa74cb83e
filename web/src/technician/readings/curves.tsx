import { effect, useSignal } from "@preact/signals";
import type { ReadonlySignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type uPlot from "uplot";
import { isUnloadable } from "@/api/late";
import { language } from "@/language/language";
import { say } from "../words";
import { Charts, heightOf } from "./chart";
import type { Chart } from "./chart";

interface CurvesProps {
  /** What is drawn, in the words of the language now. */
  readonly charts: () => readonly Chart[];
  /** The data of each chart, in their order. */
  readonly data: ReadonlySignal<readonly uPlot.AlignedData[]>;
}

/** Charts that follow what is measured; the library for them comes only when they are shown. */
export function Curves({ charts, data }: CurvesProps) {
  const place = useRef<HTMLDivElement>(null);
  const state = useSignal<"loading" | "drawn" | "away">("loading");
  useEffect(() => {
    let end: (() => void) | null = null;
    let gone = false;
    import("uplot").then(
      ({ default: Plot }) => {
        if (gone || place.current === null) return;
        state.value = "drawn";
        const drawn = new Charts(Plot, place.current, charts());
        const forget = effect(() => drawn.show(data.value));
        end = () => {
          forget();
          drawn.end();
        };
      },
      (error: unknown) => {
        if (!isUnloadable(error)) throw error;
        state.value = "away";
      },
    );
    return () => {
      gone = true;
      end?.();
    };
  }, [language.value]);
  const height_px = charts().reduce((sum, chart) => sum + heightOf(chart), 0);
  return (
    <div class="curves" style={{ minHeight: `${String(height_px)}px` }}>
      {state.value === "loading" && <p class="soft">{say.plots.loading}</p>}
      {state.value === "away" && <p class="panel-note">{say.panel.away}</p>}
      <div ref={place} />
    </div>
  );
}
