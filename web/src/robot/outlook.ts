/** What somebody who looks at a running job waits for, and how long still. */
import type { Live } from "@/api/wire";
import { formatDate, formatTime, formatTimeLeft } from "@/format";
import { words } from "@/words";
import { isActive, serverNowMs } from "./job";

/** Less than this nobody counts. */
const ANY_MOMENT_S = 1.5;
/** A time of day that is nearer needs no date. */
const SAME_DAY_S = 18 * 3600;

/** Seconds until the next milestone, by the server's clock alone; null when nothing can be told. */
export function timeLeftS(live: Live): number | null {
  const { job, outlook } = live;
  if (outlook == null || !isActive(job)) return null;
  return (Date.parse(outlook.at) - serverNowMs(live)) / 1000;
}

/** The same in a few characters, for a figure; "" when nothing can be told. */
export function timeLeft(live: Live): string {
  const left_s = timeLeftS(live);
  if (left_s === null) return "";
  return `${live.outlook?.latest === true ? "≤\u00a0" : ""}${formatTimeLeft(left_s)}`;
}

/** The same in words; "" when there is nothing to say. */
export function outlookInWords(live: Live): string {
  const { outlook } = live;
  const left_s = timeLeftS(live);
  if (outlook == null || left_s === null) return isChargingUntilFull(live) ? words.outlook.full : "";
  if (left_s < ANY_MOMENT_S) return words.outlook.soon;
  if (!outlook.latest) return words.outlook.about[outlook.milestone](formatTimeLeft(left_s));
  const date = outlook.at;
  return words.outlook.by(left_s < SAME_DAY_S ? formatTime(Date.parse(date)) : formatDate(date));
}

/** Only the car knows when that is. */
function isChargingUntilFull({ job }: Live): boolean {
  if (!isActive(job) || job.paused === true || job.needs_person != null) return false;
  return job.phase === "charging" && job.target_energy_wh === null && job.unplug_by == null;
}
