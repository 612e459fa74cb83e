/** The jobs of the past, read when somebody wants to see them. */
import { signal } from "@preact/signals";
import { listJobs, Refusal } from "@/api/client";
import type { Trouble } from "@/api/client";
import type { Job } from "@/api/wire";
import { formatEnergy, formatMoney } from "@/format";
import { told } from "@/language/problems";
import { words } from "@/words";
import { isActive } from "@/robot/job";

/** Newest first; null until they were read. */
export const history = signal<readonly Job[] | null>(null);
export const historyTrouble = signal<Trouble | null>(null);

export async function loadHistory(): Promise<void> {
  try {
    const { items } = await listJobs();
    history.value = items.filter((job) => !isActive(job));
    historyTrouble.value = null;
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    historyTrouble.value = error.trouble;
  }
}

/** What a job has cost so far; null where nobody has set a tariff. */
export function costOf({ result: { cost, currency } }: Job): string | null {
  return cost == null || currency == null ? null : formatMoney(cost, currency);
}

/** What became of a job, in a few words. */
export function outcomeOf(job: Job): string {
  const say = words.history;
  if (job.state === "cancelled") return say.cancelled;
  if (job.state === "failed") return job.error === null ? say.failed : told(job.error).title;
  if (job.type === "charge" && job.result.energy_wh != null) {
    const energy = formatEnergy(job.result.energy_wh);
    const cost = costOf(job);
    return cost === null ? say.charged(energy) : say.chargedFor(energy, cost);
  }
  return say.done[job.type];
}
