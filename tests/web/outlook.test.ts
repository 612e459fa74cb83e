import { cleanup, render, waitFor } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { App } from "@/app";
import { formatTimeLeft } from "@/format";
import { Kiosk } from "@/kiosk/app";
import { speak } from "@/language/catalogue";
import { LANGUAGES } from "@/language/language";
import { channel, store } from "@/live/page";
import { merge } from "@/live/store";
import { outlookInWords, timeLeft } from "@/robot/outlook";
import type { Job, Live, Milestone, Outlook } from "@/api/wire";
import openapi from "../../web/openapi.json";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { at, job, live, robot, snapshot, station } from "./states";

const MILESTONES = openapi.components.schemas.Milestone.enum as Milestone[];

function due(left_s: number, outlook: Partial<Outlook> = {}, changes: Partial<Job> = {}): Live {
  return live({
    robot: robot({ updated_at: at(100) }),
    job: job({ phase: "aligning", ...changes }),
    outlook: { milestone: "plugged", at: at(100 + left_s), latest: false, ...outlook },
  });
}

/** Without the spaces at which no line may break. */
const plain = (text: string): string => text.replaceAll("\u00a0", " ");
const said = (state: Live): string => plain(outlookInWords(state));

describe("the time left in words", () => {
  test("counts by the server's clock, whatever the reader's shows", () => {
    vi.useFakeTimers({ now: Date.parse(at(9_999_999)) });
    expect(said(due(6))).toBe("Plugged in in about 6 s");
    vi.useRealTimers();
    const later = due(6);
    expect(said({ ...later, robot: robot({ updated_at: at(103) }) })).toBe("Plugged in in about 3 s");
    const robotSilent = { ...later, station: station({ updated_at: at(104) }) };
    expect(said(robotSilent)).toBe("Plugged in in about 2 s");
  });

  test("names what is waited for", () => {
    expect(said(due(7800, { milestone: "charged" }))).toBe("Done in about 2 h 10");
    expect(said(due(5, { milestone: "unplugged" }))).toBe("Free to drive in about 5 s");
    expect(said(due(46_800, { milestone: "charged", latest: true }))).toMatch(
      /^Done by \d\d:\d\d.* at the latest$/,
    );
    expect(said(due(90_000, { milestone: "charged", latest: true }))).toMatch(/Mar/);
  });

  test.each([1.4, 0, -600])("does not count the last moment or what is overdue: %s s", (left_s) => {
    expect(said(due(left_s))).toBe("Any moment now");
    expect(said(due(left_s, { milestone: "charged", latest: true }))).toBe("Any moment now");
  });

  test("says of a charge without an end that the car decides", () => {
    const charging = { phase: "charging" } as const;
    expect(said({ ...due(6, {}, charging), outlook: null })).toBe("Until the car is full");
    for (const open of [{ paused: true }, { target_energy_wh: 5000 }, { phase: "aligning" }] as const) {
      expect(said({ ...due(6, {}, { ...charging, ...open }), outlook: null })).toBe("");
    }
  });

  test("says nothing of a job that has ended, and of a server that foretells nothing", () => {
    expect(said(due(6, {}, { state: "succeeded" }))).toBe("");
    const { outlook: _, ...old } = due(6);
    expect(said(old)).toBe("");
  });

  test.each(LANGUAGES)("is there in %s, with every milestone different", async (language) => {
    await speak(language);
    const all = MILESTONES.map((milestone) => said(due(28, { milestone })));
    expect(new Set(all).size).toBe(MILESTONES.length);
    for (const sentence of all) expect(sentence).toContain("28 s");
    await speak("en");
  });
});

test("a figure says whether it is certain", () => {
  expect(plain(timeLeft(due(5)))).toBe("5 s");
  expect(plain(timeLeft(due(46_740, { milestone: "charged", latest: true })))).toBe("≤ 12 h 59");
  expect(timeLeft({ ...due(5), outlook: null })).toBe("");
});

test("a time that is still to come is rounded, never cut off", () => {
  expect([-3, 0.4, 59.4, 59.6, 95, 3569, 3571, 7800].map((left) => plain(formatTimeLeft(left)))).toEqual([
    "0 s", "0 s", "59 s", "1 min", "2 min", "59 min", "1 h 00", "2 h 10",
  ]);
});

test("null puts an outlook away, and silence keeps it", () => {
  expect(merge(due(6), {}).outlook).toEqual(due(6).outlook);
  expect(merge(due(6), { outlook: null }).outlook).toBeNull();
});

describe("on the page", () => {
  beforeEach(() => {
    vi.stubGlobal("WebSocket", FakeSocket);
    new FakeRest().answer("GET /vehicles", [200, { items: [] }]);
    channel.start();
  });

  afterEach(() => {
    channel.close();
    cleanup();
    store.live.value = null;
  });

  const line = (): HTMLElement | null => document.querySelector(".time-left");
  const figures = (): string[] =>
    [...document.querySelectorAll(".figure")].map((each) => plain(each.textContent));

  test.each([["home", App], ["kiosk", Kiosk]] as const)(
    "of the %s the line is there without an outlook too, and nobody is told each second",
    async (_, Root) => {
      render(h(Root, null));
      FakeSocket.newest.says(snapshot(due(28)));
      await waitFor(() => expect(plain(line()?.textContent ?? "")).toBe("Plugged in in about 28 s"));
      expect(line()?.closest("[aria-live], [role=status], [role=alert]")).toBeNull();
      FakeSocket.newest.says(snapshot({ ...due(28), outlook: null }));
      await waitFor(() => expect(line()?.textContent).toBe(""));
    },
  );

  test("the figure of the time passed gives way to the time left", async () => {
    render(h(App, null));
    const inserting = due(4, {}, { phase: "inserting", phase_started_at: at(93) });
    FakeSocket.newest.says(snapshot(inserting));
    await waitFor(() => expect(figures()).toEqual(["Force0 N", "Time left4 s"]));
    FakeSocket.newest.says(snapshot({ ...inserting, outlook: null }));
    await waitFor(() => expect(figures()).toEqual(["Force0 N", "Time7 s"]));
  });
});
