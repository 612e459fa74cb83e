/** From what was typed to the request that begins a routine. */
import { formatNumber } from "@/format";
import type { Description, Field } from "./routines";
import type { RoutineKind } from "./types";

/** What was typed, by the name of the field. */
export type Typed = Readonly<Partial<Record<Field["name"], string>>>;
export type Wrong = Partial<Record<Field["name"], "noNumber" | "between">>;
type Body = Record<string, unknown>;

export interface Reading {
  readonly body: Body;
  readonly wrong: Wrong;
}

/** What somebody typed, with the decimal comma of their country or a point; null: no number. */
export function numberIn(text: string): number | null {
  const value = Number(text.trim().replace(",", "."));
  return text.trim() === "" || !Number.isFinite(value) ? null : value;
}

/** What was typed, or what stands there first. */
export function textIn({ name, initial }: Field, typed: Typed): string {
  return typed[name] ?? (initial === null ? "" : formatShort(initial));
}

/** A number with no more digits than it has, two at most. */
export const formatShort = (value: number): string => formatNumber(value, Number.isInteger(value) ? 0 : 2);

/** Reads every field of a routine. */
export function requestOf(kind: RoutineKind, { fields, needsLabel }: Description, typed: Typed, vehicleId: string | null): Reading {
  const body: Body = vehicleId === null || !needsLabel ? { kind } : { kind, vehicle_id: vehicleId };
  const wrong: Wrong = {};
  const incomplete = new Set<string>();
  for (const field of fields) {
    const [part, inner] = field.path;
    const text = textIn(field, typed);
    const value = numberIn(text);
    if (text.trim() === "") incomplete.add(part);
    else if (value === null || (field.whole === true && !Number.isInteger(value))) wrong[field.name] = "noNumber";
    else if (value < field.least || value > field.most) wrong[field.name] = "between";
    else if (inner === undefined) body[part] = field.percent === true ? value / 100 : value;
    else body[part] = { ...(body[part] as Body | undefined), [inner]: value };
  }
  for (const part of incomplete) delete body[part];
  return { body, wrong };
}
