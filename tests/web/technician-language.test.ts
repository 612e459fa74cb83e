import { cleanup, fireEvent, render, screen } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, describe, expect, test, vi } from "vitest";
import { questionOf } from "@/calibration/asked";
import { hintOf } from "@/calibration/hinted";
import { DOINGS, doingOf, remarkOf, unseenOf } from "@/calibration/translated";
import { speak } from "@/language/catalogue";
import { channel } from "@/live/page";
import { Technician } from "@/technician/app";
import * as de from "@/technician/language/de";
import * as en from "@/technician/language/en";
import * as fr from "@/technician/language/fr";
import * as it from "@/technician/language/it";
import { BENCH_PROBLEM_CODES, toldOnBench } from "@/technician/language/told";
import type { Spoken } from "@/technician/language/types";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { live, robot, snapshot } from "./states";

vi.mock("uplot", () => ({
  default: class {
    setData(): void {}
    setSize(): void {}
    destroy(): void {}
  },
}));

const WORDS: Record<"fr" | "de" | "it", Spoken> = { fr, de, it };
const TRANSLATED = ["fr", "de", "it"] as const;

/** Every sentence with the way to it; those that take values are given some. */
function sentences(words: unknown, path = ""): [string, string][] {
  if (typeof words === "string") return [[path, words]];
  if (typeof words === "function") {
    return sentences((words as (...values: unknown[]) => unknown)(3, 4, 5, 6), path);
  }
  if (typeof words !== "object" || words === null) return [];
  return Object.entries(words).flatMap(([key, value]) => sentences(value, `${path}.${key}`));
}

/** What English leaves to the server. */
const SERVERS = /^\.(bench\.problems|calibration\.(doing|remarks|questions|hints))\./;

afterEach(async () => {
  cleanup();
  channel.close();
  await speak("en");
});

describe("the words of the technician's page", () => {
  test.each(TRANSLATED)("of %s are all there and not left in English", (spoken) => {
    const english = new Map(sentences(en));
    const mine = sentences(WORDS[spoken]).filter(([path]) => !SERVERS.test(path));
    expect(mine.map(([path]) => path).sort()).toEqual([...english.keys()].sort());
    const same = mine.filter(([path, text]) => text === english.get(path) && /[a-z]{4}/.test(text));
    const international =
      /\.(file|code|software|firmware|python|system|robot|insertion|force|protective|title|versions|pause|numbered|direction)$/;
    expect(same.filter(([path]) => !international.test(path))).toEqual([]);
    expect(mine.filter(([path, text]) => text.trim() === "" && !path.endsWith("limits"))).toEqual([]);
  });

  test("of French keep their signs on the line of the word before", () => {
    expect(sentences(fr).filter(([, text]) => / [?!:;»]|« /.test(text))).toEqual([]);
  });

  test.each(TRANSLATED)("of %s name every problem with a remedy", (spoken) => {
    const { byCode } = WORDS[spoken].bench.problems!;
    expect(Object.keys(byCode).sort()).toEqual([...BENCH_PROBLEM_CODES].sort());
    for (const [title, remedy] of Object.values(byCode)) {
      expect(title).not.toMatch(/\.$/);
      expect(remedy).toMatch(/\.$/);
    }
  });
});

describe("what the server says of calibration", () => {
  const MISSED = "Places that were held back are missed by 0.12 mm; a good robot manages 0.06 mm. Tighten the belts and repeat.";
  const UNSEEN = "The length of the left leg and the travel of the right belt: the looks say little about that, and what was known before is kept.";

  test("stays as it is in English, and where it is not known", async () => {
    expect(remarkOf(MISSED)).toBe(MISSED);
    expect(unseenOf(UNSEEN)).toBe(UNSEEN);
    expect(doingOf(DOINGS.search)).toBe(DOINGS.search);
    await speak("de");
    expect(remarkOf("Something new.")).toBe("Something new.");
    expect(unseenOf("Something new: the looks say little about that.")).toMatch(/^Something new/);
    expect(doingOf("Something new.")).toBe("Something new.");
  });

  test("is said with its numbers in the reader's language", async () => {
    await speak("de");
    expect(doingOf(DOINGS.search)).toBe("Die Marke wird gesucht.");
    expect(remarkOf(MISSED)).toMatch(/um 0,12 mm verfehlt; ein guter Roboter schafft 0,06 mm/);
    expect(remarkOf("The camera's roll differs from the drawing by +4.25 degrees: measure it by hand before you trust this.")).toMatch(
      /Rollen der Kamera\): \+4,25 °/,
    );
    await speak("fr");
    expect(unseenOf(UNSEEN)).toMatch(/^Longueur de la jambe gauche et course de la courroie droite\u00a0: /);
  });

  test("of one carriage names it, and counts", async () => {
    const PLAY = "The left carriage has 0.32 mm of play: tighten its belt, and look at pulley and gear.";
    expect(doingOf("Homing, 2 of 5.")).toBe("Homing, 2 of 5.");
    await speak("de");
    expect(doingOf("Homing, 2 of 5.")).toBe("Die Position wird gesucht, 2 von 5.");
    expect(doingOf("Bringing the right carriage to the same place from below.")).toMatch(/rechte .* von unten/);
    expect(remarkOf(PLAY)).toMatch(/^Der linke Schlitten hat 0,32 mm Spiel/);
    await speak("fr");
    expect(remarkOf("The right switch closes within 0.12 mm only: fasten it, and look for play of its lever.")).toMatch(
      /^La fin de course droite ne se ferme qu’à 0,12 mm/,
    );
    await speak("it");
    expect(remarkOf("Without any force the motor current shows -2.4 N: something pulls at the slide, such as the cable.")).toMatch(
      /mostra -2,4 N/,
    );
  });

  test("in a question keeps its numbers, and an unknown one stays", async () => {
    const spring = {
      code: "force_spring",
      text: "Put the spring of 2.5 N/mm straight before the plug, against something firm, then confirm. The plug will push it together.",
      input: null,
    };
    expect(questionOf(spring)).toBe(spring.text);
    await speak("de");
    expect(questionOf(spring)).toMatch(/Feder mit 2,5 N\/mm/);
    expect(questionOf({ ...spring, text: "Something else." })).toBe("Something else.");
    expect(questionOf({ ...spring, code: "made_tomorrow" })).toBe(spring.text);
  });

  test("in a hint keeps its numbers and the name of the car", async () => {
    const off = {
      code: "socket_off",
      title: "The socket is not where its label says",
      text: "The last plugs went in +1.2 mm to the right and -0.4 mm up from there. Look whether the label of Renault Zoe has come loose, then teach the socket again.",
      vehicle_id: "zoe",
    };
    expect(hintOf(off)).toEqual({ title: off.title, text: off.text, mendedBy: "socket" });
    await speak("it");
    expect(hintOf(off).text).toMatch(/\+1,2 mm più a destra e -0,4 mm più in alto.*Renault Zoe/);
    expect(hintOf({ ...off, code: "made_tomorrow" })).toEqual({ title: off.title, text: off.text, mendedBy: null });
  });

  test("of a moved label tells by how much", async () => {
    await speak("it");
    const problem = { code: "calibration_label_moved", title: "x", detail: "y", remedy: "z", context: { moved_mm: 1.234 } };
    expect(toldOnBench(problem).detail).toBe("Si è spostata di 1,2 mm.");
    expect(toldOnBench({ ...problem, code: "made_tomorrow" }).detail).toBe("y");
  });
});

test.each([
  ["fr", "Déplacer à la main", "Étalonnage", "Vers le haut"],
  ["de", "Von Hand bewegen", "Kalibrierung", "Aufwärts"],
  ["it", "Muovere a mano", "Calibrazione", "Su"],
] as const)("the page is spoken in %s, and changes while it is open", async (spoken, jog, calibration, up) => {
  vi.stubGlobal("WebSocket", FakeSocket);
  vi.stubGlobal("ResizeObserver", class { observe(): void {} disconnect(): void {} });
  Object.assign(navigator, { getGamepads: () => [] });
  FakeSocket.made.length = 0;
  new FakeRest();
  channel.start();
  render(h(Technician, null));
  FakeSocket.newest.says(snapshot(live({ robot: robot() })));
  await screen.findByRole("region", { name: "Move by hand" });
  await speak(spoken);
  await screen.findByRole("region", { name: jog });
  await screen.findByText(calibration);
  fireEvent.focus(await screen.findByRole("button", { name: up }));
  expect(document.documentElement.lang).toBe(spoken);
});
