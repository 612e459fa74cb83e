import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type uPlot from "uplot";
import { language } from "@/language/language";
import { store } from "@/live/page";
import { say } from "../words";
import { Charts } from "./chart";
import type { Chart } from "./chart";
import { forceOverWay } from "./force-way";
import { empty, record, SPAN_S } from "./history";
import type { Columns } from "./history";

type Curve = Exclude<keyof Columns, "t_s">;

/** Curves of the last minute, and what each is called in every language. */
const OVER_TIME: readonly (Readonly<{ title: "joints" | "errors" | "force"; span: number }> & {
  readonly curves: readonly (readonly [Curve, string])[];
})[] = [
  { title: "joints", span: 10, curves: [["rho1", "ρ1"], ["rho2", "ρ2"], ["rho3", "ρ3"]] },
  { title: "errors", span: 0.2, curves: [["error1", "ρ1"], ["error2", "ρ2"], ["error3", "ρ3"]] },
  { title: "force", span: 10, curves: [["force", "F"]] },
];

/** The last minute as curves; the library for them comes only when this is shown. */
export function Plots() {
  const still = useSignal(false);
  const place = useRef<HTMLDivElement>(null);
  const loaded = useSignal(false);
  const columns = useRef(empty());
  useEffect(() => {
    let end: (() => void) | null = null;
    let gone = false;
    void import("uplot").then(({ default: Plot }) => {
      if (gone || place.current === null) return;
      loaded.value = true;
      end = follow(new Charts(Plot, place.current, chartsNow()), columns.current, still);
    });
    return () => {
      gone = true;
      end?.();
    };
  }, [language.value]);
  return (
    <section class="card plots">
      <div class="card-head">
        <h2>{say.plots.title}</h2>
        <button
          type="button"
          class="button"
          aria-pressed={still.value}
          onClick={() => {
            still.value = !still.value;
          }}
        >
          {still.value ? say.plots.go : say.plots.hold}
        </button>
      </div>
      {!loaded.value && <p class="soft">{say.plots.loading}</p>}
      <div ref={place} class="plots-place" />
    </section>
  );
}

/** Keeps the charts going; returns how to end it. */
function follow(charts: Charts, columns: Columns, still: { readonly value: boolean }): () => void {
  let asked = 0;
  const show = (): void => {
    asked = 0;
    charts.show(dataOf(columns));
  };
  const forget = store.live.subscribe((live) => {
    if (live === null || !record(columns, live.robot) || still.value) return;
    if (asked === 0) asked = requestAnimationFrame(show);
  });
  return () => {
    forget();
    cancelAnimationFrame(asked);
    charts.end();
  };
}

function chartsNow(): readonly Chart[] {
  const past = { unit: "s", range: [-SPAN_S, 0] } as const;
  return [
    ...OVER_TIME.map(({ title, span, curves }) => ({
      title: say.plots[title],
      curves: curves.map(([, name]) => name),
      x: past,
      span,
    })),
    { title: say.plots.forceWay, curves: [say.plots.out, say.plots.back], x: { unit: "mm" }, span: 10 },
  ];
}

/** In the order of the charts; times as seconds before the newest, so that the axis stands. */
function dataOf(columns: Columns): readonly uPlot.AlignedData[] {
  const now_s = columns.t_s.at(-1) ?? 0;
  const before_s = columns.t_s.map((t_s) => t_s - now_s);
  const { way_mm, out_n, back_n } = forceOverWay(columns);
  return [
    ...OVER_TIME.map(({ curves }): uPlot.AlignedData => [before_s, ...curves.map(([curve]) => columns[curve])]),
    [[...way_mm], [...out_n], [...back_n]],
  ];
}
