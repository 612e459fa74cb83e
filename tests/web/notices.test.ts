import { describe, expect, test } from "vitest";
import { noticeOf } from "../../web/src/worker/notices";

const message = (changes: object): string =>
  JSON.stringify({ kind: "charged", language: "en", detail: "", energy_wh: 21_480, ...changes });

describe("a notification", () => {
  test("says how much was charged, as the country writes it", () => {
    expect(noticeOf(message({}))).toEqual({
      title: "The car is charged: 21.5\u00a0kWh",
      body: "The plug is out of the car.",
      lang: "en",
      stays: false,
    });
    expect(noticeOf(message({ language: "de" })).title).toBe("Das Auto ist geladen: 21,5\u00a0kWh");
  });

  test.each(["en", "fr", "de", "it"])("in %s has words for everything", (language) => {
    for (const kind of ["charged", "ended", "failed", "needs_person"]) {
      const { title, body, lang } = noticeOf(message({ kind, language }));
      expect(title.length).toBeGreaterThan(5);
      expect(body).toMatch(/\.$/);
      expect(lang).toBe(language);
      expect(title + body).not.toMatch(/undefined|null|NaN| [?!:;]/);
    }
  });

  test("of a question stays until it was seen, and says what it is about", () => {
    const said = noticeOf(message({ kind: "needs_person", detail: "Label not found" }));
    expect(said.stays).toBe(true);
    expect(said.body).toBe("Label not found. Touch to see what to do.");
  });

  test.each(["", "nonsense", "null", '{"kind":"of a newer server"}', '{"language":"tlh"}'])(
    "is shown also for %j",
    (text) => {
      expect(noticeOf(text)).toMatchObject({ title: "PlugPilot", lang: "en" });
    },
  );
});
