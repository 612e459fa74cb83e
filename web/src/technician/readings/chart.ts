/** What all plots of the page have in common. */
import type uPlot from "uplot";

export interface Chart {
  readonly title: string;
  readonly curves: readonly string[];
  readonly x: {
    readonly unit: string;
    /** What the axis shows always; left out where it follows what was measured. */
    readonly range?: readonly [number, number];
  };
  /** The upright axis shows at least this much, so that noise does not fill it. */
  readonly span: number;
  /** What is never below zero: the upright axis begins there. */
  readonly fromZero?: boolean;
}

const HEIGHT_PX = 150;
const TITLE_PX = 20;
const LEGEND_PX = 30;

/** What a chart takes, so that its place can be kept before it is drawn. */
export const heightOf = ({ curves }: Chart): number => HEIGHT_PX + TITLE_PX + (curves.length > 1 ? LEGEND_PX : 0);

/** Charts in an element, one below the other, as wide as it is. */
export class Charts {
  readonly #place: HTMLElement;
  readonly #plots: readonly uPlot[];
  readonly #resized: ResizeObserver;

  constructor(Plot: typeof uPlot, place: HTMLElement, charts: readonly Chart[]) {
    this.#place = place;
    this.#plots = charts.map((chart) => {
      const nothing = [[], ...chart.curves.map(() => [])] as unknown as uPlot.AlignedData;
      return new Plot(optionsOf(chart, place), nothing, place);
    });
    this.#resized = new ResizeObserver(() => {
      for (const plot of this.#plots) plot.setSize({ width: place.clientWidth, height: HEIGHT_PX });
    });
    this.#resized.observe(this.#place);
  }

  /** Draws what was measured, the data of each chart in their order. */
  show(data: readonly uPlot.AlignedData[]): void {
    this.#plots.forEach((plot, number) => plot.setData(data[number]!));
  }

  end(): void {
    this.#resized.disconnect();
    for (const plot of this.#plots) plot.destroy();
  }
}

function optionsOf({ title, curves, x, span, fromZero }: Chart, place: HTMLElement): uPlot.Options {
  const colour = (name: string): string => getComputedStyle(place).getPropertyValue(name).trim();
  const colours = [colour("--busy"), colour("--good"), colour("--ask")];
  const axis = { stroke: colour("--soft"), grid: { stroke: colour("--line"), width: 1 }, ticks: { show: false } };
  const always = x.range === undefined ? null : ([...x.range] as [number, number]);
  return {
    title,
    width: place.clientWidth,
    height: HEIGHT_PX,
    cursor: { drag: { x: false, y: false } },
    legend: { show: curves.length > 1, live: false },
    scales: { x: { time: false, range: always ?? asMeasured }, y: { range: fromZero === true ? upToAtLeast(span) : atLeast(span) } },
    axes: [{ ...axis, size: 24, values: withUnit(x.unit) }, { ...axis, size: 48 }],
    series: [
      {},
      ...curves.map((label, number) => ({
        label,
        stroke: colours[number]!,
        width: 1.5,
        spanGaps: x.range === undefined,
        points: { show: false },
      })),
    ],
  };
}

/** The last mark says what all of them are measured in. */
function withUnit(unit: string): (plot: uPlot, marks: number[]) => string[] {
  return (_plot, marks) =>
    marks.map((mark, number) => (number === marks.length - 1 ? `${String(mark)} ${unit}` : String(mark)));
}

/** The whole way that was measured; something to look at before there is any. */
function asMeasured(_plot: uPlot, low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [0, 100];
  return low === high ? [low - 1, high + 1] : [low, high];
}

/** A range from zero that reaches a span at least. */
function upToAtLeast(span: number): (plot: uPlot, low: number | null, high: number | null) => [number, number] {
  return (_plot, _low, high) => [0, Math.max(span, (high ?? 0) * 1.1)];
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
