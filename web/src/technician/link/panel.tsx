import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type uPlot from "uplot";
import { call } from "@/api/client";
import type { Trouble } from "@/api/client";
import type { LinkReport } from "@/api/wire";
import { formatNumber } from "@/format";
import { Figures } from "../parts/figures";
import { Panel } from "../parts/panel";
import { poll } from "../parts/poll";
import { TroubleNote } from "../parts/trouble";
import { Verdict } from "../parts/verdict";
import type { Chart } from "../readings/chart";
import { Curves } from "../readings/curves";
import { secondsAgo } from "../readings/past";
import { milliseconds, noLinkPast, recordLink, SPAN_S } from "./history";
import type { LinkPast } from "./history";
import { LINK_TONES, linkVerdict } from "./verdict";
import { say } from "./words";

/** The board answers a question for its time once a second: more often nothing is new. */
const PAUSE_MS = 1000;

type Lines = readonly (readonly [name: string, value: string])[];

/** How well the link to the motion board does; nothing is asked before it is opened. */
export function LinkPanel() {
  return <Panel title={say.title} hint={say.hint} body={Link} />;
}

function Link() {
  const past = useRef(noLinkPast());
  const report = useSignal<LinkReport | null>(null);
  const trouble = useSignal<Trouble | null>(null);
  const data = useSignal(dataOf(past.current));
  useEffect(
    () =>
      poll(
        async () => {
          const found = await call<LinkReport>("/robot/link");
          if (recordLink(past.current, found)) data.value = dataOf(past.current);
          report.value = found;
          trouble.value = null;
        },
        (why) => {
          trouble.value = why;
        },
        PAUSE_MS,
      ),
    [],
  );
  const verdict = linkVerdict(report.value, past.current);
  const now = figuresNow(report.value);
  const counted = figuresSinceOpened(report.value);
  return (
    <>
      {trouble.value === null && <Verdict tone={LINK_TONES[verdict]} words={say.verdicts[verdict]} />}
      <TroubleNote trouble={trouble.value} />
      <div class="panel-figures" data-old={trouble.value !== null}>
        <Figures title={say.now} lines={now} />
        <Figures title={say.sinceOpened} lines={counted} />
      </div>
      <Curves charts={chartsNow} data={data} />
      {[...now, ...counted].some(([, value]) => value === say.unknown) && <p class="soft panel-foot">{say.unmeasured}</p>}
    </>
  );
}

function figuresNow(report: LinkReport | null): Lines {
  const trip = report?.round_trip;
  return [
    [say.rate, shown(report?.telemetry_hz, 1, "Hz")],
    [say.age, shown(milliseconds(report?.sample_age_s), 0, "ms")],
    [say.delay, shown(milliseconds(report?.sample_delay_s), 1, "ms")],
    [say.roundTrip, shown(milliseconds(trip?.newest_s), 1, "ms")],
    [say.median, shown(milliseconds(trip?.median_s), 1, "ms")],
    [say.worst, shown(milliseconds(trip?.worst_s), 1, "ms")],
    [say.supply, shown(report?.supply_v, 1, "V")],
    [say.temperature, shown(report?.temperature_degc, 1, "°C")],
  ];
}

function figuresSinceOpened(report: LinkReport | null): Lines {
  return [
    [say.received, shown(report?.received, 0)],
    [say.damaged, shown(report?.damaged, 0)],
    [say.damagedAtBoard, shown(report?.damaged_at_board, 0)],
    [say.again, shown(report?.sent_again, 0)],
    [say.reconnections, shown(report?.reconnections, 0)],
  ];
}

const shown = (value: number | null | undefined, digits: number, unit = ""): string =>
  value == null ? say.unknown : `${formatNumber(value, digits)} ${unit}`.trimEnd();

function chartsNow(): readonly Chart[] {
  const x = { unit: "s", range: [-SPAN_S, 0] } as const;
  return [
    { title: say.times, curves: [say.roundTrip, say.late], x, span: 10, fromZero: true },
    { title: say.rateOverTime, curves: [say.rate], x, span: 12, fromZero: true },
  ];
}

function dataOf(past: LinkPast): readonly uPlot.AlignedData[] {
  const ago_s = secondsAgo(past);
  return [
    [ago_s, past.roundTrip_ms, past.delay_ms],
    [ago_s, past.rate_hz],
  ];
}
