/** An entry of the trail in words: what was done, and by whom. */
import type { TrailWords } from "@/language/types";
import { told } from "@/language/problems";
import type { TrailEntry } from "./calls";
import { say } from "./words";

/** What was done, with the facts that a person wants to see. */
export function titleOf({ event, detail }: TrailEntry, words: TrailWords): string {
  const operation = typeof detail["operation"] === "string" ? detail["operation"] : "";
  const done = nameIn(words.operations, operation) ?? nameIn(words.events, event) ?? (operation || event);
  const status = typeof detail["status"] === "number" ? detail["status"] : 0;
  const title = event === "refused" || status >= FAILED ? words.refused(done) : done;
  const facts = factsOf(detail);
  return facts.length === 0 ? title : `${title} (${facts.join(", ")})`;
}

/** By whom; a kind without a name where there is none. */
export function callerOf({ actor }: TrailEntry, words: TrailWords): string {
  if (actor === AT_THE_MACHINE) return words.callers.machine;
  const [kind = "", ...rest] = actor.split(": ");
  const name = rest.join(": ");
  if (name === "") return nameIn(words.callers, kind) ?? actor;
  return kind === "key" ? words.program(name) : name;
}

/** Whoever has the machine's own terminal (server/access/pairing.py). */
const AT_THE_MACHINE = "the machine itself";
const FAILED = 400;

function factsOf(detail: TrailEntry["detail"]): string[] {
  const facts = ["name", "role", "device", "code"].map((fact) => {
    const value = detail[fact];
    if (typeof value !== "string") return null;
    if (fact === "role") return nameIn(say.roles, value)?.name ?? value;
    if (fact === "code") return titleOfProblem(value);
    return value;
  });
  return facts.filter((fact) => fact !== null);
}

/** In English, where the server has the words, the code says it. */
function titleOfProblem(code: string): string {
  return told({ code, title: code.replaceAll("_", " "), detail: "", remedy: "" }).title;
}

/** From a list of words; undefined for what is not in it, as from a newer server. */
function nameIn<Word>(words: Readonly<Record<string, Word>>, key: string): Word | undefined {
  return Object.hasOwn(words, key) ? words[key] : undefined;
}
