import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type uPlot from "uplot";
import { store } from "@/live/page";
import { say } from "../words";
import type { Chart } from "./chart";
import { Curves } from "./curves";
import { forceOverWay } from "./force-way";
import { empty, record, SPAN_S } from "./history";
import type { Columns, Curve } from "./history";
import { secondsAgo } from "./past";

/** Curves of the last minute, and what each is called in every language. */
const OVER_TIME: readonly (Readonly<{ title: "joints" | "errors" | "force"; span: number }> & {
  readonly curves: readonly (readonly [Curve, string])[];
})[] = [
  { title: "joints", span: 10, curves: [["rho1", "ρ1"], ["rho2", "ρ2"], ["rho3", "ρ3"]] },
  { title: "errors", span: 0.2, curves: [["error1", "ρ1"], ["error2", "ρ2"], ["error3", "ρ3"]] },
  { title: "force", span: 10, curves: [["force", "F"]] },
];

/** The last minute as curves. */
export function Plots() {
  const still = useSignal(false);
  const columns = useRef(empty());
  const data = useSignal(dataOf(columns.current));
  useEffect(() => {
    let asked = 0;
    const show = (): void => {
      asked = 0;
      data.value = dataOf(columns.current);
    };
    const forget = store.live.subscribe((live) => {
      if (live === null || !record(columns.current, live.robot) || still.peek()) return;
      if (asked === 0) asked = requestAnimationFrame(show);
    });
    return () => {
      forget();
      cancelAnimationFrame(asked);
    };
  }, []);
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
      <Curves charts={chartsNow} data={data} />
    </section>
  );
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

/** In the order of the charts. */
function dataOf(columns: Columns): readonly uPlot.AlignedData[] {
  const ago_s = secondsAgo(columns);
  const { way_mm, out_n, back_n } = forceOverWay(columns);
  return [
    ...OVER_TIME.map(({ curves }): uPlot.AlignedData => [ago_s, ...curves.map(([curve]) => columns[curve])]),
    [[...way_mm], [...out_n], [...back_n]],
  ];
}
