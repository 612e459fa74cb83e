import { cleanup, fireEvent, render, screen, waitFor, within } from "@testing-library/preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { h } from "preact";
import openapi from "../../web/openapi.json";
import { App } from "@/app";
import { formatDate, formatEnergy, formatSize } from "@/format";
import { instructionOf } from "@/guidance/instruction";
import { speak } from "@/language/catalogue";
import { firstSpoken, language, LANGUAGES, preferred, regional } from "@/language/language";
import type { Language } from "@/language/language";
import { loadProblems, PROBLEM_CODES, told } from "@/language/problems";
import { choose } from "@/language/start";
import type { AccessWords, HomeWords } from "@/language/types";
import { channel } from "@/live/page";
import type { Guidance } from "@/api/wire";
import * as de from "@/language/de";
import * as en from "@/language/en";
import * as fr from "@/language/fr";
import * as it from "@/language/it";
import { problems as deProblems } from "@/language/de/problems";
import { problems as frProblems } from "@/language/fr/problems";
import { problems as itProblems } from "@/language/it/problems";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { job, live, snapshot, START } from "./states";

const WORDS = { en, fr, de, it };
const TRANSLATED = ["fr", "de", "it"] as const;
const PROBLEMS = { fr: frProblems, de: deProblems, it: itProblems };
const REASONS = openapi.components.schemas.Guidance.properties.reason.enum as Guidance["reason"][];

// The compiler holds every language to what English says.
// @ts-expect-error: sentences are missing
const incomplete: HomeWords = { chooseCar: { title: "Welches Auto?" } };
// @ts-expect-error: a role is missing
const withoutOwner: AccessWords["roles"] = { viewer: en.access.roles.viewer };
void [incomplete, withoutOwner];

/** Every sentence with the way to it; those that take values are given some. */
function sentences(words: unknown, path = ""): [string, string][] {
  if (typeof words === "string") return [[path, words]];
  if (typeof words === "function") {
    return sentences((words as (...values: unknown[]) => unknown)(3, "B", "C"), path);
  }
  if (typeof words !== "object" || words === null) return [];
  return Object.entries(words).flatMap(([key, value]) => sentences(value, `${path}.${key}`));
}

afterEach(async () => {
  localStorage.clear();
  await speak("en");
});

describe("the words", () => {
  test.each(TRANSLATED)("of %s are all there and not left in English", (spoken) => {
    const english = new Map(sentences(en));
    const mine = sentences(WORDS[spoken]).filter(([path]) => !path.includes(".sentences"));
    expect(mine.map(([path]) => path).sort()).toEqual([...english.keys()].sort());
    const same = mine.filter(([path, text]) => text === english.get(path) && /[a-z]{4}/.test(text));
    const international =
      /plan\.kilowattHours|code$|\.(robot|camera|force|Live|live|title|people\.role|version|plug|step|simulatedParts\.robot|stop|pause|passkeys|door\.stop|name|headline|simulator)$/;
    expect(same.filter(([path]) => !international.test(path))).toEqual([]);
    expect(mine.filter(([, text]) => text.trim() === "")).toEqual([]);
  });

  test("of French keep their signs on the line of the word before", () => {
    const all = [...sentences(fr), ...sentences(frProblems)];
    expect(all.filter(([, text]) => / [?!:;»]|« /.test(text))).toEqual([]);
  });

  test.each(TRANSLATED)("of %s name every problem with a remedy", (spoken) => {
    expect(Object.keys(PROBLEMS[spoken]).sort()).toEqual([...PROBLEM_CODES].sort());
    for (const [title, remedy] of Object.values(PROBLEMS[spoken])) {
      expect(title).not.toMatch(/\.$/);
      expect(remedy).toMatch(/\.$/);
    }
  });

  test.each(TRANSLATED)("of %s count rightly", (spoken) => {
    const { passkeys } = WORDS[spoken].access.people;
    expect(passkeys(12)).toContain("12");
    // Italian borrows the word from English, and borrowed words do not change.
    expect(passkeys(2).replace("2", "1") === passkeys(1)).toBe(spoken === "it");
    expect(WORDS[spoken].access.trail.times(1)).not.toContain("#");
  });
});

describe("the language", () => {
  test("is the first of the browser's that is spoken here", () => {
    expect(firstSpoken(["nl-NL", "de-CH", "fr"])).toBe("de");
    expect(firstSpoken(["IT-it"])).toBe("it");
    expect(firstSpoken(["nl", "pt-BR"])).toBe("en");
    expect(firstSpoken([])).toBe("en");
  });

  test("keeps the reader's region for numbers", () => {
    expect(regional("de", ["en-US", "de-CH"])).toBe("de-CH");
    expect(regional("de", ["en-US"])).toBe("de-DE");
  });

  test("that somebody chose is kept, and a nonsense in its place is not", async () => {
    expect(await choose("it")).toBe(true);
    expect(preferred()).toBe("it");
    expect(document.documentElement.lang).toBe("it");
    localStorage.setItem("plugpilot.language", "tlh");
    expect(preferred()).toBe(firstSpoken(navigator.languages));
  });

  test("writes numbers and dates its own way", async () => {
    expect(formatEnergy(15_340)).toBe("15.3\u00a0kWh");
    await speak("de");
    expect(formatEnergy(15_340)).toBe("15,3\u00a0kWh");
    expect(formatSize(1_500_000)).toBe("1,5\u00a0MB");
    expect(formatDate(START)).toMatch(/1\. März/);
    await speak("fr");
    expect(formatDate(START)).toMatch(/1 mars/);
  });
});

describe("problems", () => {
  const problem = {
    code: "insertion_jammed",
    title: "The plug did not go in",
    detail: "The plug met 78 N.",
    remedy: "Check the flap.",
  };

  test("are told by their code", async () => {
    expect(told(problem)).toMatchObject({ title: problem.title, detail: problem.detail });
    await choose("fr");
    await loadProblems();
    expect(told(problem)).toEqual({
      title: "Le connecteur n’est pas entré",
      detail: "",
      remedy: frProblems.insertion_jammed[1],
    });
  });

  test("that are not known keep the server's sentences", async () => {
    await choose("de");
    await loadProblems();
    for (const code of ["made_tomorrow", "toString", "constructor"]) {
      expect(told({ ...problem, code })).toEqual({
        title: problem.title,
        detail: problem.detail,
        remedy: problem.remedy,
      });
    }
  });
});

describe("guidance", () => {
  const guidance = (changes: Partial<Guidance>): Guidance => ({
    state: "move",
    since: START,
    arriving: true,
    reason: "rolls",
    headline: "1.2 m forward",
    detail: "Straight on.",
    remedy: "",
    steps: [{ direction: "forward", distance_mm: 1200, shown_cm: 120 }],
    car: null,
    zones: { good: [], reachable: [], stop_z_mm: 0 },
    driver_faces: "robot",
    max_skew_deg: 3,
    ...changes,
  });

  test("is the server's own in English", () => {
    expect(instructionOf(guidance({})).headline).toBe("1.2 m forward");
  });

  test.each(TRANSLATED)("has a sentence for every reason in %s, with all its values", async (spoken) => {
    await speak(spoken);
    const steps = [{ direction: "up" as const, distance_mm: 80, shown_cm: 8 }];
    for (const reason of REASONS) {
      for (const state of ["move", "thin", "skewed"] as const) {
        const { headline, detail, remedy } = instructionOf(guidance({ reason, state, steps }));
        expect(`${headline}${detail}${remedy}`).not.toMatch(/[{}]|undefined/);
        expect(`${headline}${detail}`).not.toBe("");
      }
    }
  });

  test("puts what else is to be done behind the first thing", async () => {
    await speak("de");
    const steps = [
      { direction: "forward" as const, distance_mm: 1200, shown_cm: 120 },
      { direction: "left" as const, distance_mm: 80, shown_cm: 8 },
    ];
    expect(instructionOf(guidance({ steps }))).toEqual({
      headline: "1,2 m vor",
      detail: "Und 8 cm weiter links.",
      remedy: "",
    });
    expect(instructionOf(guidance({ steps, reason: "stands" })).remedy).toContain("seitlich");
    expect(instructionOf(guidance({ state: "thin", reason: "thin", steps })).detail).toContain(
      "Besser: 1,2 m vor und 8 cm weiter links.",
    );
  });
});

describe("the open page", () => {
  beforeEach(() => {
    vi.stubGlobal("WebSocket", FakeSocket);
    new FakeRest().answer("GET /vehicles", [200, { items: [{ id: "zoe", name: "Renault Zoe" }] }]);
    channel.start();
    render(h(App, null));
    FakeSocket.newest.says(snapshot(live()));
  });

  afterEach(() => {
    channel.close();
    cleanup();
  });

  const pick = (spoken: Language): void => {
    const picker = screen.getByRole("combobox", { name: /Language|Sprache|Langue|Lingua/ });
    fireEvent.change(picker, { target: { value: spoken } });
  };

  test("changes its language everywhere at once, whatever is open and typed", async () => {
    fireEvent.click(await screen.findByRole("button", { name: "Plan a charge" }));
    const dialog = within(await screen.findByRole("dialog"));
    fireEvent.click(dialog.getByLabelText("Only"));
    fireEvent.input(await dialog.findByLabelText("Energy, kWh"), { target: { value: "17.5" } });
    pick("de");
    expect(await screen.findByRole("heading", { level: 1, name: "Bereit zum Laden" })).toBeTruthy();
    const typed = dialog.getByLabelText<HTMLInputElement>("Energie, kWh");
    expect(typed.value).toBe("17.5");
    expect(dialog.getByRole("button", { name: "So planen" })).toBeTruthy();
  });

  test("says a failed job in the language of the reader", async () => {
    const error = {
      type: "urn:x",
      title: "Label not found",
      status: 409,
      code: "label_not_found",
      detail: "The camera did not find the label of Renault Zoe within 20 s.",
      remedy: "Park the car.",
      context: {},
    };
    FakeSocket.newest.says(snapshot(live({ job: job({ state: "failed", error }) }), 2));
    pick("it");
    await waitFor(() => expect(language.value).toBe("it"));
    expect(await screen.findByText(/non è stata trovata/)).toBeTruthy();
    expect(screen.queryByText(/did not find/)).toBeNull();
  });

  test("is spoken in all languages there are", () => {
    const options = within(screen.getByRole("combobox", { name: "Language" }));
    expect(options.getAllByRole("option").map((each) => each.getAttribute("lang"))).toEqual([
      ...LANGUAGES,
    ]);
  });
});
