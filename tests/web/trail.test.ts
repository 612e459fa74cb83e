import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import openapi from "../../web/openapi.json";
import type { TrailEntry } from "@/access/calls";
import { callerOf, titleOf } from "@/access/trail-entry";
import { trail as de } from "@/language/de/trail";
import { trail as en } from "@/language/en/trail";
import { trail as fr } from "@/language/fr/trail";
import { trail as it } from "@/language/it/trail";

const TRAILS = { en, de, fr, it };
/** Whoever tries these is not known yet; the trail names what came of it instead. */
const OF_STRANGERS = ["pairDevice", "beginLogin", "logIn", "showOwnerInvitation"];
const CHANGES = Object.values(openapi.paths as Record<string, Record<string, { operationId: string }>>)
  .flatMap((methods) => Object.entries(methods))
  .filter(([method]) => method !== "get")
  .map(([, { operationId }]) => operationId)
  .filter((name) => !OF_STRANGERS.includes(name));

function entry(changes: Partial<TrailEntry>): TrailEntry {
  const made = { sequence: 1, at: "2026-03-01T18:04:05Z", event: "operation", actor: "person: Anna" };
  return { ...made, address: "", detail: {}, times: 1, chain: "", ...changes };
}

describe("the trail", () => {
  test.each(Object.entries(TRAILS))("has words for every change in %s", (_, words) => {
    const missing = CHANGES.filter((name) => !Object.hasOwn(words.operations, name));
    expect(missing).toEqual([]);
  });

  test("has words for what the server calls the end of a question about control", () => {
    const seat = readFileSync("../server/control/seat.py", "utf-8");
    const answers = /^Answer = Literal\[(.*)\]$/m.exec(seat)?.[1]?.match(/\w+/g) ?? [];
    expect(answers.length).toBeGreaterThan(3);
    for (const answer of answers) expect(en.operations).toHaveProperty([`control ${answer}`]);
  });

  test("says what was done, and what was not", () => {
    const detail = { operation: "createJob", path: "/api/v1/jobs", status: 201 };
    expect(titleOf(entry({ detail }), en)).toBe("Begin a charge or another job");
    const refused = entry({ detail: { ...detail, status: 409 } });
    expect(titleOf(refused, de)).toBe("Abgelehnt: Ladung oder anderen Auftrag beginnen");
    const forbidden = { operation: "message jog", code: "forbidden" };
    expect(titleOf(entry({ event: "refused", detail: forbidden }), en)).toContain("Move by hand");
  });

  test("keeps the name of what a newer server calls otherwise", () => {
    expect(titleOf(entry({ detail: { operation: "polishCar" } }), en)).toBe("polishCar");
    expect(titleOf(entry({ event: "car.polished" }), en)).toBe("car.polished");
    expect(titleOf(entry({ detail: { operation: "toString" } }), en)).toBe("toString");
  });

  test("names people, and says of others what they are", () => {
    expect(callerOf(entry({}), en)).toBe("Anna");
    expect(callerOf(entry({ actor: "key: Home: Assistant" }), fr)).toBe("Home: Assistant (programme)");
    expect(callerOf(entry({ actor: "machine" }), it)).toBe("il robot stesso");
    expect(callerOf(entry({ actor: "martian" }), en)).toBe("martian");
    const pairing = readFileSync("../server/access/pairing.py", "utf-8");
    const terminal = /^MACHINE = "(.*)"$/m.exec(pairing)?.[1] ?? "";
    expect(callerOf(entry({ actor: terminal }), de)).toBe("der Roboter selbst");
  });
});
