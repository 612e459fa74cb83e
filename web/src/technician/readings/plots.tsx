import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type uPlot from "uplot";
import { language } from "@/language/language";
import { store } from "@/live/page";
import { say } from "../words";
import { empty, record, SPAN_S } from "./history";
import type { Columns } from "./history";

type Curve = Exclude<keyof Columns, "t_s">;

interface PlotKind {
  readonly title: "joints" | "errors" | "force";
  readonly curves: readonly (readonly [Curve, string])[];
  /** The axis shows at least this much, so that noise does not fill it. */
  readonly span: number;
}

const PLOTS: readonly PlotKind[] = [
  { title: "joints", curves: [["rho1", "ρ1"], ["rho2", "ρ2"], ["rho3", "ρ3"]], span: 10 },
  { title: "errors", curves: [["error1", "ρ1"], ["error2", "ρ2"], ["error3", "ρ3"]], span: 0.2 },
  { title: "force", curves: [["force", "F"]], span: 10 },
];

const HEIGHT_PX = 150;

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
      end = draw(Plot, place.current, columns.current, still);
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

/** Draws all plots into an element and keeps them going; returns how to end it. */
function draw(
  Plot: typeof uPlot,
  place: HTMLElement,
  columns: Columns,
  still: { readonly value: boolean },
): () => void {
  const plots = PLOTS.map((kind) => new Plot(optionsOf(kind, place), dataOf(columns, kind), place));
  let asked = 0;
  const show = (): void => {
    asked = 0;
    plots.forEach((plot, number) => plot.setData(dataOf(columns, PLOTS[number]!)));
  };
  const forget = store.live.subscribe((live) => {
    if (live === null || !record(columns, live.robot) || still.value) return;
    if (asked === 0) asked = requestAnimationFrame(show);
  });
  const resized = new ResizeObserver(() => {
    for (const plot of plots) plot.setSize({ width: place.clientWidth, height: HEIGHT_PX });
  });
  resized.observe(place);
  return () => {
    forget();
    resized.disconnect();
    cancelAnimationFrame(asked);
    for (const plot of plots) plot.destroy();
  };
}

/** Times as seconds before the newest, so that the axis never moves. */
function dataOf(columns: Columns, kind: PlotKind): uPlot.AlignedData {
  const now_s = columns.t_s.at(-1) ?? 0;
  return [columns.t_s.map((t_s) => t_s - now_s), ...kind.curves.map(([curve]) => columns[curve])];
}

function optionsOf({ title, curves, span }: PlotKind, place: HTMLElement): uPlot.Options {
  const colour = (name: string): string => getComputedStyle(place).getPropertyValue(name).trim();
  const colours = [colour("--busy"), colour("--good"), colour("--ask")];
  const axis = { stroke: colour("--soft"), grid: { stroke: colour("--line"), width: 1 }, ticks: { show: false } };
  return {
    title: say.plots[title],
    width: place.clientWidth,
    height: HEIGHT_PX,
    cursor: { drag: { x: false, y: false } },
    legend: { show: curves.length > 1, live: false },
    scales: { x: { time: false, range: [-SPAN_S, 0] }, y: { range: atLeast(span) } },
    axes: [
      { ...axis, size: 24, values: (_plot, marks) => marks.map((mark) => (mark === 0 ? "0 s" : String(mark))) },
      { ...axis, size: 48 },
    ],
    series: [
      {},
      ...curves.map(([, label], number) => ({ label, stroke: colours[number]!, width: 1.5, points: { show: false } })),
    ],
  };
}

/** A range around the data that is never narrower than a span. */
function atLeast(span: number): (plot: uPlot, low: number | null, high: number | null) => [number, number] {
  return (_plot, low, high) => {
    if (low === null || high === null) return [-span / 2, span / 2];
    const middle = (low + high) / 2;
    const half = Math.max(span, (high - low) * 1.1) / 2;
    return [middle - half, middle + half];
  };
}
