/** How long a routine still takes, by the pace that this page has seen. */
import { useRef } from "preact/hooks";
import { store } from "@/live/page";
import { ROUTINES } from "./routines";
import type { Routine } from "./types";

/** So many places must have been seen before their pace says more than the usual one. */
const ENOUGH = 2;

interface Seen {
  readonly done: number;
  readonly at_ms: number;
}

/** Seconds for what is left, from the first and the newest of the places that were seen. */
export function secondsLeft(left: number, first: Seen, last: Seen, usual_s: number): number {
  const looks = last.done - first.done;
  return left * (looks < ENOUGH ? usual_s : (last.at_ms - first.at_ms) / 1000 / looks);
}

/** Estimated time left [s]; a simulator that runs faster is faster here too. */
export function useTimeLeft({ kind, done, total, state }: Routine): number {
  const first = useRef<Seen | null>(null);
  const last = useRef<Seen | null>(null);
  const now = { done, at_ms: performance.now() };
  // A pause is no pace: the count begins anew when the routine goes on.
  if (state !== "running" || first.current === null || done < first.current.done) first.current = now;
  if (last.current?.done !== done || state !== "running") last.current = now;
  const usual_s = ROUTINES[kind].lookTakes_s / (store.live.value?.service.speed ?? 1);
  return secondsLeft((total || ROUTINES[kind].looks) - done, first.current, last.current, usual_s);
}
