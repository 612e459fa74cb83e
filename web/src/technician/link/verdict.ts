/** What the figures of the link mean. */
import type { LinkReport } from "@/api/wire";
import { growth } from "../readings/past";
import { allDamaged, milliseconds } from "./history";
import type { LinkPast } from "./history";

export type LinkVerdict = "asking" | "offline" | "interrupted" | "damaged" | "slow" | "good";

export const LINK_TONES = {
  asking: "calm",
  offline: "problem",
  interrupted: "problem",
  damaged: "ask",
  slow: "ask",
  good: "good",
} as const satisfies Record<LinkVerdict, string>;

/**
 * A healthy link answers within 1 to 4 ms. From 30 ms on the protocol takes a message for lost and
 * says it again, although it was only late.
 */
export const SLOW_MS = 30;

/**
 * The slowest of the last half minute may be one hiccup of the computer. But a motion whose target
 * may change has 160 ms of its way in the board: little more, and it runs out of way.
 */
export const SLOWEST_MS = 120;

/** The board sends 10 samples a second at rest, more while it moves; a fifth is missing. */
export const LEAST_HZ = 8;

/**
 * A cable in order damages nothing; an arc at a switch may now and then. One in a thousand, over
 * all the time, is the cable.
 */
export const DAMAGED_SHARE = 0.001;

/** The worst that is true; of what happened in the past only what the curves show. */
export function linkVerdict(report: LinkReport | null, past: LinkPast): LinkVerdict {
  if (report === null) return "asking";
  if (!report.online) return "offline";
  if (growth(past.reconnections) > 0) return "interrupted";
  const damaged = allDamaged(report) ?? 0;
  if (growth(past.damaged) > 0 || damaged > DAMAGED_SHARE * (report.received ?? Infinity)) return "damaged";
  return isSlow(report) || growth(past.again) > 0 ? "slow" : "good";
}

function isSlow({ round_trip, sample_delay_s, telemetry_hz }: LinkReport): boolean {
  const above = (seconds: number | null | undefined, limit_ms: number): boolean =>
    (milliseconds(seconds) ?? 0) > limit_ms;
  return (
    above(round_trip?.median_s, SLOW_MS) ||
    above(round_trip?.worst_s, SLOWEST_MS) ||
    above(sample_delay_s, SLOW_MS) ||
    (telemetry_hz ?? Infinity) < LEAST_HZ
  );
}
