/** Watching a recorded job again in the 3D view. */
import { signal } from "@preact/signals";
import { preparePlayback, Refusal } from "@/api/client";
import type { Trouble } from "@/api/client";
import type { Job, JobPhase, Playback } from "@/api/wire";
import { words } from "@/words";

/** The job that is on the screen. */
export const replayed = signal<Job | null>(null);
/** Null while it is being made ready. */
export const playback = signal<Playback | null>(null);
export const replayTrouble = signal<Trouble | null>(null);

export async function watchAgain(job: Job): Promise<void> {
  replayed.value = job;
  playback.value = replayTrouble.value = null;
  try {
    const ready = await preparePlayback(job.id);
    // Somebody may have opened another one, or closed this one, meanwhile.
    if (replayed.value === job) playback.value = ready;
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    if (replayed.value === job) replayTrouble.value = error.trouble;
  }
}

export function closeReplay(): void {
  replayed.value = playback.value = replayTrouble.value = null;
}

/** Where the 3D view finds the playback of a job. */
export function playbackAddress(job: Job): string {
  const file = `/api/v1/jobs/${encodeURIComponent(job.id)}/playback.viser`;
  return `/twin/?playbackPath=${encodeURIComponent(file)}`;
}

export interface Chapter {
  readonly at_s: number;
  readonly text: string;
  readonly alarm: boolean;
}

/** Too short to be seen: the next one begins at once. */
const SHORTEST_S = 0.3;

/** The parts of a playback that a reader may jump to. */
export function chaptersOf({ duration_s, marks }: Playback): readonly Chapter[] {
  const phases = marks.filter((mark) => mark.kind === "phase");
  const long = phases.filter((mark, index) => {
    const end_s = phases[index + 1]?.at_s ?? duration_s;
    return end_s - mark.at_s >= SHORTEST_S;
  });
  const alarms = marks.filter((mark) => mark.kind === "divergence");
  return [...long, ...alarms]
    .sort((a, b) => a.at_s - b.at_s)
    .map(({ at_s, kind, text }) => ({
      at_s,
      text: kind === "phase" ? (words.phases[text as JobPhase]?.step ?? text) : text,
      alarm: kind === "divergence",
    }));
}

/** The chapter that is playing at a time; -1 before the first. */
export function chapterAt(chapters: readonly Chapter[], time_s: number): number {
  return chapters.findLastIndex((chapter) => !chapter.alarm && chapter.at_s <= time_s + 0.05);
}
