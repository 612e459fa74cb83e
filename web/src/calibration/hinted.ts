/** What wears or has moved, as the server says it, in the reader's language. */
import { localised } from "./localised";
import type { Hint, RoutineKind } from "./types";
import { say } from "./words";

/** Hints by their code, each with a place for everything in its text that varies. */
const HINTS = {
  belts_drifted: /up to ([\d.]+) mm; ([\d.]+) mm were proven\. The (left|right) belt goes ([+-][\d.]+) %/,
  looks_misfit: /^In (\d+) jobs/,
  plug_heavy: /depth of (\d+) mm the last (\d+) insertions took (-?\d+) N; (-?\d+) to (-?\d+) N/,
  plug_light: /depth of (\d+) mm the last (\d+) insertions took (-?\d+) N; (-?\d+) to (-?\d+) N/,
  slide_heavy: /takes (-?[\d.]+) N; (-?[\d.]+) N were usual/,
  socket_off: /in ([+-][\d.]+) mm to the right and ([+-][\d.]+) mm up .* label of (.+) has come loose/,
} as const;

type Code = keyof typeof HINTS;

export type Hints = Readonly<Record<Code, readonly [title: string, text: (...found: string[]) => string]>>;

/** The routine that mends it. */
const MENDED_BY: Partial<Record<Code, RoutineKind>> = {
  belts_drifted: "robot",
  looks_misfit: "robot",
  slide_heavy: "force",
  socket_off: "socket",
};

interface Hinted {
  readonly title: string;
  readonly text: string;
  readonly mendedBy: RoutineKind | null;
}

/** A hint in the reader's language; one that is not known stays as the server said it. */
export function hintOf({ code, title, text }: Hint): Hinted {
  if (!isKnown(code)) return { title, text, mendedBy: null };
  const mendedBy = MENDED_BY[code] ?? null;
  const words = say.hints?.[code];
  const found = HINTS[code].exec(text);
  if (words === undefined || found === null) return { title, text, mendedBy };
  return { title: words[0], text: words[1](...found.slice(1).map(localised)), mendedBy };
}

const isKnown = (code: string): code is Code => Object.hasOwn(HINTS, code);
