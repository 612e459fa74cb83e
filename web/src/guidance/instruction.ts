/** What the driver is told, in the reader's language. */
import type { Guidance, GuidanceReason, GuidanceStep } from "@/api/wire";
import { formatNumber } from "@/format";
import { say } from "./words";

type Direction = GuidanceStep["direction"];

/** Headline, detail and remedy; {distance}, {skew} and {limit} stand for what was measured. */
type Sentence = readonly [headline: string, detail?: string, remedy?: string];

/** How a language says it all. */
export interface Sentences {
  readonly reasons: Readonly<Record<GuidanceReason, Sentence>>;
  /** The first thing to do, as a headline. */
  readonly first: Readonly<Record<Direction, string>>;
  /** What else is to be done; nobody can drive up or down. */
  readonly further: Readonly<Partial<Record<Direction, string>>>;
  readonly and: string;
  /** Before what else is to be done: {steps}. */
  readonly also: string;
  readonly better: string;
}

export interface Instruction {
  readonly headline: string;
  readonly detail: string;
  readonly remedy: string;
}

/** The server's own words, or the same in another language. */
export function instructionOf(guidance: Guidance): Instruction {
  const { sentences } = say;
  return sentences === null ? guidance : translated(guidance, sentences);
}

function translated(guidance: Guidance, sentences: Sentences): Instruction {
  const { reason, steps, state } = guidance;
  const [first, ...others] = steps;
  const [headline, detail = "", remedy = ""] = sentences.reasons[reason];
  const facts = {
    distance: first === undefined ? "" : formatDistance(first.shown_cm),
    skew: formatNumber(Math.abs(guidance.car?.skew_deg ?? 0), 0),
    limit: formatLimit(guidance.max_skew_deg),
  };
  if (state === "thin") {
    const better = clauses(steps, sentences);
    const hint = better === "" ? "" : fill(sentences.better, { steps: better });
    return { headline: fill(headline, facts), detail: joined(fill(detail, facts), hint), remedy };
  }
  if (state !== "move" || first === undefined || isUpright(first)) {
    return { headline: fill(headline, facts), detail: fill(detail, facts), remedy };
  }
  const more = clauses(others, sentences);
  const also = more === "" ? "" : fill(sentences.also, { steps: more });
  const aside = steps.some(({ direction }) => direction === "left" || direction === "right");
  return {
    headline: fill(sentences.first[first.direction], facts),
    // "Straight on" is wrong as soon as there is anything else to do.
    detail: joined(reason === "rolls" && also !== "" ? "" : fill(detail, facts), also),
    remedy: aside ? remedy : "",
  };
}

function clauses(steps: readonly GuidanceStep[], { further, and }: Sentences): string {
  return steps
    .map(({ direction, shown_cm }) => {
      const clause = further[direction];
      return clause === undefined ? "" : fill(clause, { distance: formatDistance(shown_cm) });
    })
    .filter((clause) => clause !== "")
    .join(and);
}

/** Up and down cannot be driven. */
function isUpright({ direction }: GuidanceStep): boolean {
  return direction === "up" || direction === "down";
}

/** A distance as people say it: "8 cm", "1.2 m". */
export function formatDistance(cm: number): string {
  const { value, unit } = distanceParts(cm);
  return `${value} ${unit}`;
}

/** Degrees as they were set: "3", "2.5". */
export function formatLimit(degrees: number): string {
  return formatNumber(degrees, Number.isInteger(degrees) ? 0 : 1);
}

/** The number and the unit apart, for large print. */
export function distanceParts(cm: number): { readonly value: string; readonly unit: string } {
  if (cm < 100) return { value: formatNumber(cm, 0), unit: "cm" };
  return { value: formatNumber(cm / 100, 1), unit: "m" };
}

const joined = (...parts: readonly string[]): string => parts.filter((part) => part !== "").join(" ");

function fill(text: string, facts: Readonly<Record<string, string>>): string {
  return text.replace(/\{(\w+)\}/g, (whole, name: string) => facts[name] ?? whole);
}
