/** What was measured lately: one column of numbers for each curve, beside their times. */

/** Values at the times; null where nothing was measured. */
export type Past<Name extends string> = Readonly<Record<Name, (number | null)[]>> & { readonly t_s: number[] };

/** However often something is measured, memory is bounded. */
const MOST = 1500;

export function noPast<Name extends string>(names: readonly Name[]): Past<Name> {
  const columns = Object.fromEntries(names.map((name): [string, (number | null)[]] => [name, []]));
  return { ...columns, t_s: [] } as unknown as Past<Name>;
}

/**
 * Adds values by the time of their own measurement; those that are not newer change nothing, and
 * what is older than the span is forgotten. A clock that went back begins anew.
 */
export function append<Name extends string>(
  past: Past<Name>,
  t_s: number,
  values: Readonly<Record<Name, number | null>>,
  span_s: number,
): boolean {
  const all = Object.values(past) as unknown[][];
  const last_s = past.t_s.at(-1) ?? -Infinity;
  if (t_s === last_s) return false;
  if (t_s < last_s) for (const column of all) column.length = 0;
  past.t_s.push(t_s);
  for (const name of Object.keys(values) as Name[]) past[name].push(values[name]);
  const old = Math.max(past.t_s.findIndex((each) => each >= t_s - span_s), past.t_s.length - MOST);
  if (old > 0) for (const column of all) column.splice(0, old);
  return true;
}

/** Seconds before the newest, so that an axis of time stands. */
export function secondsAgo({ t_s }: { readonly t_s: readonly number[] }): number[] {
  const now_s = t_s.at(-1) ?? 0;
  return t_s.map((each) => each - now_s);
}

/** By how much a counter grew; one that began anew meanwhile counts from zero. */
export function growth(counter: readonly (number | null)[]): number {
  let before: number | null = null;
  let grown = 0;
  for (const count of counter) {
    if (count === null) continue;
    if (before !== null) grown += count < before ? count : count - before;
    before = count;
  }
  return grown;
}
