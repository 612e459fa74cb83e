import { useComputed } from "@preact/signals";
import type { ReadonlySignal } from "@preact/signals";
import { useRef } from "preact/hooks";
import type uPlot from "uplot";
import type { CameraInspection } from "@/api/wire";
import { formatNumber } from "@/format";
import { Figures } from "../parts/figures";
import { Verdict } from "../parts/verdict";
import type { Chart } from "../readings/chart";
import { Curves } from "../readings/curves";
import { append, noPast, secondsAgo } from "../readings/past";
import type { Past } from "../readings/past";
import type { Shown } from "./follow";
import { say } from "./words";

const SPAN_S = 300;

export type CameraVerdict = "asking" | "slow" | "late" | "good";

const TONES = { asking: "calm", slow: "ask", late: "ask", good: "good" } as const satisfies Record<CameraVerdict, string>;

/** The label is looked for five times a second: a slower camera is what everything waits for. */
export const LEAST_HZ = 5;

/**
 * Half of it passes in finding the label, on a small computer. A car that creeps in at 0.2 m/s is
 * 6 cm further after that time, as far as a driver may be told too late.
 */
export const LATE_MS = 300;

export function cameraVerdict(inspection: CameraInspection | null): CameraVerdict {
  if (inspection === null) return "asking";
  if (inspection.frames_per_s !== null && inspection.frames_per_s < LEAST_HZ) return "slow";
  return 1000 * inspection.age_s > LATE_MS ? "late" : "good";
}

/** The figures of the camera itself. */
export function HealthFigures({ inspection }: { inspection: CameraInspection | null }) {
  const show = (value: number | null | undefined, digits: number, unit: string): string =>
    value == null ? say.unknown : `${formatNumber(value, digits)}${unit}`;
  return (
    <Figures
      title={say.health.title}
      lines={[
        [say.health.rate, show(inspection?.frames_per_s, 1, " Hz")],
        [say.health.age, show(inspection && inspection.age_s * 1000, 0, " ms")],
        [say.health.exposure, show(inspection?.exposure_ms, 1, " ms")],
        [say.health.brightness, show(inspection?.brightness, 0, "")],
        [say.health.dark, inspection === null ? say.unknown : share(inspection.dark_share)],
        [say.health.bright, inspection === null ? say.unknown : share(inspection.bright_share)],
      ]}
    />
  );
}

interface HealthProps {
  readonly shown: ReadonlySignal<Shown | null>;
  /** What was shown last is not true any more. */
  readonly old: boolean;
}

/** Whether pictures come often and soon enough, in words and as curves. */
export function HealthOverTime({ shown, old }: HealthProps) {
  const past = useRef<CameraPast>(noPast(NAMES));
  const data = useComputed(() => {
    const inspection = shown.value?.inspection;
    if (inspection !== undefined) recordCamera(past.current, inspection);
    return dataOf(past.current);
  });
  const verdict = cameraVerdict(shown.value?.inspection ?? null);
  return (
    <>
      {!old && <Verdict tone={TONES[verdict]} words={say.health.verdicts[verdict]} />}
      <Curves charts={chartsNow} data={data} />
    </>
  );
}

const NAMES = ["rate_hz", "age_ms"] as const;
type CameraPast = Past<(typeof NAMES)[number]>;

function recordCamera(past: CameraPast, { taken_at, frames_per_s, age_s }: CameraInspection): void {
  append(past, Date.parse(taken_at) / 1000, { rate_hz: frames_per_s, age_ms: 1000 * age_s }, SPAN_S);
}

function chartsNow(): readonly Chart[] {
  const x = { unit: "s", range: [-SPAN_S, 0] } as const;
  return [
    { title: say.health.rateOverTime, curves: [say.health.rate], x, span: 20, fromZero: true },
    { title: say.health.ageOverTime, curves: [say.health.age], x, span: 100, fromZero: true },
  ];
}

function dataOf(past: CameraPast): readonly uPlot.AlignedData[] {
  const ago_s = secondsAgo(past);
  return [
    [ago_s, past.rate_hz],
    [ago_s, past.age_ms],
  ];
}

export const share = (part: number): string => `${formatNumber(100 * part, 1)} %`;
