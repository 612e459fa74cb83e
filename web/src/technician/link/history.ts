/** The last minutes of the link to the motion board. */
import type { LinkReport } from "@/api/wire";
import { append, noPast } from "../readings/past";
import type { Past } from "../readings/past";

export const SPAN_S = 300;

const NAMES = ["roundTrip_ms", "delay_ms", "rate_hz", "damaged", "again", "reconnections"] as const;
export type LinkPast = Past<(typeof NAMES)[number]>;

export const noLinkPast = (): LinkPast => noPast(NAMES);

export function recordLink(past: LinkPast, report: LinkReport): boolean {
  return append(
    past,
    Date.parse(report.at) / 1000,
    {
      roundTrip_ms: milliseconds(report.round_trip?.newest_s),
      delay_ms: milliseconds(report.sample_delay_s),
      rate_hz: report.telemetry_hz,
      damaged: allDamaged(report),
      again: report.sent_again,
      reconnections: report.reconnections,
    },
    SPAN_S,
  );
}

/** Damaged frames of both ways; null where nobody counts. */
export function allDamaged({ damaged, damaged_at_board }: LinkReport): number | null {
  return damaged === null && damaged_at_board === null ? null : (damaged ?? 0) + (damaged_at_board ?? 0);
}

export const milliseconds = (seconds: number | null | undefined): number | null =>
  seconds == null ? null : 1000 * seconds;
