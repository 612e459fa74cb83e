import { cleanup, fireEvent, render, screen, waitFor, within } from "@testing-library/preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { h } from "preact";
import { App } from "@/app";
import type { Job } from "@/api/wire";
import { formatSize } from "@/format";
import { history, outcomeOf } from "@/jobs/history";
import { chapterAt, chaptersOf, closeReplay, playbackAddress } from "@/jobs/replay";
import { speak } from "@/language/catalogue";
import { channel } from "@/live/page";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { job, live, snapshot } from "./states";

const PLAYBACK = {
  duration_s: 18.7,
  marks: [
    { at_s: 0, kind: "phase", text: "preflight" },
    { at_s: 0, kind: "phase", text: "aligning" },
    { at_s: 3.3, kind: "phase", text: "inserting" },
    { at_s: 5.1, kind: "divergence", text: "The slide does not follow" },
    { at_s: 7.9, kind: "phase", text: "charging" },
  ],
} as const;

const DONE = job({ id: "a", state: "succeeded", result: { energy_wh: 21_480 } });
const RECORDED: Job = { ...DONE, recording: { size_bytes: 1_518_950 } };

let rest: FakeRest;

beforeEach(() => {
  vi.stubGlobal("WebSocket", FakeSocket);
  rest = new FakeRest();
  history.value = null;
  channel.start();
  render(h(App, null));
});

afterEach(() => {
  channel.close();
  closeReplay();
  cleanup();
});

async function openHistory(...jobs: Job[]): Promise<void> {
  rest.answer("GET /jobs?limit=12", [200, { items: jobs, next_cursor: null }]);
  FakeSocket.newest.says(snapshot(live()));
  const title = await screen.findByText("Earlier jobs");
  const details = title.closest("details")!;
  details.open = true;
  fireEvent(details, new Event("toggle"));
}

describe("earlier jobs", () => {
  test("are read only when somebody wants to see them", async () => {
    FakeSocket.newest.says(snapshot(live()));
    await screen.findByText("Earlier jobs");
    expect(rest.requests).toEqual([]);
    await openHistory(RECORDED);
    expect(await screen.findByText("21.5 kWh charged")).toBeTruthy();
  });

  test("offer what was recorded, and say where nothing was", async () => {
    await openHistory(RECORDED, { ...DONE, id: "b" });
    const link = await screen.findByRole("link", { name: /Download/ });
    expect(link.getAttribute("href")).toBe("/api/v1/jobs/a/recording");
    expect(link.textContent).toContain("1.5\u00a0MB");
    expect(screen.getAllByRole("button", { name: /Watch again/ })).toHaveLength(1);
    expect(screen.getByText("not recorded")).toBeTruthy();
  });

  test("leave the running one out", async () => {
    await openHistory(job({ state: "running" }));
    expect(await screen.findByText("Nothing yet.")).toBeTruthy();
  });

  test("say what went wrong when they cannot be read", async () => {
    await openHistory();
    rest.answer("GET /jobs?limit=12", new Error("no network"));
    FakeSocket.newest.says(snapshot(live({ job: DONE })));
    expect(await screen.findByText("The robot did not answer.")).toBeTruthy();
  });

  test.each([
    [job({ state: "cancelled" }), "Cancelled"],
    [job({ state: "succeeded", type: "plug_in" }), "Plugged in"],
    [job({ state: "succeeded", type: "unplug" }), "Unplugged"],
    [job({ state: "failed" }), "Did not work"],
  ])("have an outcome in words", (ended, words) => {
    expect(outcomeOf(ended)).toBe(words);
  });
});

describe("watching again", () => {
  test("gets the playback ready, then shows it with its chapters", async () => {
    rest.answer("GET /jobs/a/playback", [200, PLAYBACK]);
    await openHistory(RECORDED);
    fireEvent.click(await screen.findByRole("button", { name: /Watch again/ }));
    const dialog = await screen.findByRole("dialog");
    const frame = await within(dialog).findByTitle("Recorded job in 3D");
    expect(frame.getAttribute("src")).toBe(
      "/twin/?playbackPath=%2Fapi%2Fv1%2Fjobs%2Fa%2Fplayback.viser",
    );
    const list = within(dialog).getByRole("list", { name: "Jump to" });
    const names = within(list).getAllByRole("button").map((each) => each.textContent);
    expect(names).toEqual(["Lining up", "Plugging in", "The slide does not follow", "Charging"]);
  });

  test("tells the 3D view what the player's buttons mean", async () => {
    rest.answer("GET /jobs/a/playback", [200, PLAYBACK]);
    await openHistory(RECORDED);
    fireEvent.click(await screen.findByRole("button", { name: /Watch again/ }));
    const frame = await screen.findByTitle<HTMLIFrameElement>("Recorded job in 3D");
    const view = frame.contentWindow!;
    const told = vi.spyOn(view, "postMessage").mockReturnValue(undefined);
    fireEvent.click(screen.getByRole("button", { name: "Plugging in" }));
    const slider = screen.getByRole<HTMLInputElement>("slider", { name: "Time in the recording" });
    fireEvent.input(slider, { target: { value: "12.5" } });
    fireEvent.click(screen.getByRole("button", { name: "Play" }));
    expect(told.mock.calls.map(([message]) => message as unknown)).toEqual([
      { player: { at: 3.3, playing: true } },
      { player: { at: 12.5 } },
      { player: { playing: true } },
    ]);

    const { origin } = location;
    const says = (source: MessageEventSource, data: unknown): void => {
      dispatchEvent(new MessageEvent("message", { data, origin, source }));
    };
    await waitFor(() => {
      says(view, { playback: { at: 8, playing: true } });
      expect(screen.getByRole("button", { name: "Pause" })).toBeTruthy();
    });
    says(window, { playback: { at: 1, playing: false } });
    expect(screen.getByText("8 s / 18 s")).toBeTruthy();
    expect(screen.getByRole("button", { current: "step" }).textContent).toBe("Charging");
  });

  test("says why a recording cannot be shown", async () => {
    const problem = { code: "playback_failed", title: "No", detail: "d", remedy: "Download it." };
    rest.answer("GET /jobs/a/playback", [500, problem]);
    await openHistory(RECORDED);
    fireEvent.click(await screen.findByRole("button", { name: /Watch again/ }));
    expect((await screen.findByText("Download it.", { exact: false })).textContent).toContain("No.");
    fireEvent.click(screen.getByRole("button", { name: "Close" }));
    await waitFor(() => expect(screen.queryByRole("dialog")).toBeNull());
  });

  test("finds the chapter of a time", () => {
    const chapters = chaptersOf(PLAYBACK);
    expect(chapterAt(chapters, 0)).toBe(0);
    expect(chapterAt(chapters, 6)).toBe(1);
    expect(chapterAt(chapters, 18)).toBe(3);
  });

  test("asks for the file under the job's own name", () => {
    expect(playbackAddress(job({ id: "a b" }))).toContain("a%2520b");
  });
});

describe("the cost", () => {
  const result = { energy_wh: 21_480, cost: 6.444, currency: "EUR" };

  test("stands beside the energy, as the reader's country writes money", async () => {
    const priced = job({ state: "succeeded", result });
    expect(outcomeOf(priced)).toBe("21.5\u00a0kWh for €6.44");
    await speak("de");
    expect(outcomeOf(priced)).toBe("21,5\u00a0kWh für 6,44\u00a0€");
    await speak("en");
  });

  test("is left out where nobody has set a tariff", () => {
    expect(outcomeOf(job({ state: "succeeded", result: { energy_wh: 21_480 } }))).toBe(
      "21.5\u00a0kWh charged",
    );
  });
});

describe("robot and model", () => {
  const FOUND = {
    quantity: "rho3",
    title: "The slide does not follow",
    message: "The slide is at 80.00 mm instead of 81.00 mm.",
    unit: "mm",
    expected: 81,
    measured: 80,
    sigma: 0.1,
    sigmas: 10,
    at: DONE.created_at,
    phase: "inserting",
    joints: { rho1_mm: 1, rho2_mm: 2, rho3_mm: 80 },
    depth_mm: null,
    tip_off_mm: 1,
  } as const;

  test("are spoken of only when they have parted", async () => {
    FakeSocket.newest.says(snapshot(live({ twin: { divergences: [FOUND] } })));
    expect(await screen.findByText("Not as expected")).toBeTruthy();
    expect(screen.getByText("80.00 mm instead of 81.00 mm.", { exact: false })).toBeTruthy();
    FakeSocket.newest.says({
      type: "delta",
      sequence: 2,
      changes: { twin: { divergences: [] } },
    });
    await waitFor(() => expect(screen.queryByText("Not as expected")).toBeNull());
  });
});

test("sizes are short", () => {
  expect([340_100, 1_518_950].map(formatSize)).toEqual(["341\u00a0kB", "1.5\u00a0MB"]);
});
