/** From what was typed to a change of settings, and back. */
import type { Configuration, ConfigurationField } from "@/api/wire";
import { say } from "./words";

type Json = Configuration["settings"][string][string];
/** Sections with the settings that are to change; null gives one its first value back. */
export type Patch = Record<string, Record<string, Json>>;
/** What was typed, by the key of the field. */
export type Draft = Readonly<Record<string, string>>;

export interface Reading {
  readonly patch: Patch;
  /** Fields whose text cannot even be read, with the reason. */
  readonly unreadable: Readonly<Record<string, string>>;
}

/** The value of a dotted key; undefined if there is none. */
export function valueOf(settings: Configuration["settings"], key: string): unknown {
  return key.split(".").reduce<unknown>(
    (table, name) => (typeof table === "object" && table !== null ? (table as Record<string, unknown>)[name] : undefined),
    settings,
  );
}

/** A value as it is typed and read. */
export function textOf(value: unknown): string {
  if (value === null || value === undefined) return "";
  return typeof value === "string" ? value : JSON.stringify(value);
}

/** Reads every field that was touched. */
export function read(draft: Draft, fields: readonly ConfigurationField[]): Reading {
  const patch: Patch = {};
  const unreadable: Record<string, string> = {};
  for (const field of fields) {
    const text = draft[field.key];
    if (text === undefined) continue;
    const [section = "", ...rest] = field.key.split(".");
    const value = valueIn(text.trim(), field);
    if (value instanceof Unreadable) unreadable[field.key] = value.why;
    else (patch[section] ??= {})[rest.join(".")] = value as Json;
  }
  return { patch, unreadable };
}

class Unreadable {
  constructor(readonly why: string) {}
}

function valueIn(text: string, { kind }: ConfigurationField): unknown {
  if (text === "") return null;
  switch (kind) {
    case "number":
    case "integer": {
      const number = Number(text);
      return Number.isFinite(number) ? number : new Unreadable(say.noNumber);
    }
    case "boolean":
      return text === "true";
    case "other":
      try {
        return JSON.parse(text) as unknown;
      } catch {
        return new Unreadable(say.noJson);
      }
    default:
      return text;
  }
}
