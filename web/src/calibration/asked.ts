/** What a routine asks in English, in the reader's language. */
import { localised } from "./localised";
import type { Question } from "./types";
import { say } from "./words";

/** Questions by their code, each with a place for every number in its text. */
const QUESTIONS = {
  camera_enough: /^End when /,
  belts_marked: /^Mark /,
  belts_left: /^How far /,
  belts_right: /^How far /,
  force_clear: /within ([\d.]+) mm/,
  force_spring: /spring of ([\d.]+) N\/mm/,
} as const;

export type Questions = Readonly<Record<keyof typeof QUESTIONS, (...numbers: string[]) => string>>;

/** A question in the reader's language; one that is not known stays as the server said it. */
export function questionOf({ code, text }: Question): string {
  const words = say.questions;
  if (words === null || !isKnown(code)) return text;
  const found = QUESTIONS[code].exec(text);
  return found === null ? text : words[code](...found.slice(1).map(localised));
}

const isKnown = (code: string): code is keyof Questions => Object.hasOwn(QUESTIONS, code);
