import { cleanup, fireEvent, render, screen, waitFor } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import openapi from "../../web/openapi.json";
import type { CameraInspection, LinkReport } from "@/api/wire";
import { cameraVerdict, LATE_MS } from "@/technician/camera/health";
import { noLinkPast, recordLink, SPAN_S } from "@/technician/link/history";
import { LinkPanel } from "@/technician/link/panel";
import { linkVerdict } from "@/technician/link/verdict";
import type { LinkVerdict } from "@/technician/link/verdict";
import { Charts } from "@/technician/readings/chart";
import { append, growth, noPast, secondsAgo } from "@/technician/readings/past";
import { FakeRest } from "./rest";

const paths = openapi.paths;
const REPORT = paths["/api/v1/robot/link"].get.responses["200"].content["application/json"].example as unknown as LinkReport;
const LOOK = paths["/api/v1/camera/inspection"].get.responses["200"].content["application/json"]
  .example as unknown as CameraInspection;
const TRIP = REPORT.round_trip!;
const BEGAN_MS = Date.parse(REPORT.at);

/** Reports a second apart. */
const reports = (...changes: Partial<LinkReport>[]): LinkReport[] =>
  changes.map((change, second) => ({ ...REPORT, at: new Date(BEGAN_MS + 1000 * second).toISOString(), ...change }));

/** What is said after the last of some reports. */
function after(...changes: Partial<LinkReport>[]): LinkVerdict {
  const past = noLinkPast();
  const all = reports(...changes);
  for (const report of all) recordLink(past, report);
  return linkVerdict(all.at(-1) ?? null, past);
}

describe("the verdict", () => {
  test("of a healthy link is good, also where only the delay is modelled", () => {
    expect(after({}, {})).toBe("good");
    const nothing = { received: null, damaged: null, damaged_at_board: null, sent_again: null, supply_v: null, temperature_degc: null };
    expect(after({ ...nothing, reconnections: null, round_trip: null }, nothing)).toBe("good");
    expect(after()).toBe("asking");
  });

  test.each([
    ["a board that answers late", { round_trip: { ...TRIP, median_s: 0.031 } }, "slow"],
    ["one hiccup", { round_trip: { ...TRIP, worst_s: 0.1 } }, "good"],
    ["a hiccup as long as the way that is in the board", { round_trip: { ...TRIP, worst_s: 0.16 } }, "slow"],
    ["late samples", { sample_delay_s: 0.05 }, "slow"],
    ["missing samples", { telemetry_hz: 6 }, "slow"],
    ["samples while it moves", { telemetry_hz: 100 }, "good"],
    ["no telemetry", { online: false, telemetry_hz: null }, "offline"],
    ["damage long ago", { received: 100_000, damaged: 5 }, "good"],
    ["much damage", { received: 1000, damaged_at_board: 5 }, "damaged"],
  ] as const)("of %s is told", (_what, change, expected) => {
    expect(after({ ...change }, { ...change })).toBe(expected);
  });

  test("tells of what happened while the curves show it, the worst first", () => {
    expect(after({ sent_again: 3 }, { sent_again: 4 })).toBe("slow");
    expect(after({ damaged: 1 }, { damaged: 2, sent_again: 4 })).toBe("damaged");
    expect(after({ damaged: 1 }, { damaged: 0, reconnections: 1 }, { reconnections: 1 })).toBe("interrupted");
    expect(after({ reconnections: 1 }, { reconnections: 2 }, { online: false })).toBe("offline");
    const past = noLinkPast();
    const long: Partial<LinkReport>[] = Array.from({ length: SPAN_S + 3 }, (_, second) => ({ damaged: second === 0 ? 0 : 1 }));
    const all = reports(...long);
    for (const report of all.slice(0, 2)) recordLink(past, report);
    expect(linkVerdict(all[1]!, past)).toBe("damaged");
    for (const report of all.slice(2)) recordLink(past, report);
    expect(linkVerdict(all.at(-1)!, past)).toBe("good");
  });

  test("of the camera tells too few pictures and late ones", () => {
    expect(cameraVerdict(null)).toBe("asking");
    expect(cameraVerdict(LOOK)).toBe("good");
    expect(cameraVerdict({ ...LOOK, frames_per_s: null })).toBe("good");
    expect(cameraVerdict({ ...LOOK, frames_per_s: 4.2 })).toBe("slow");
    expect(cameraVerdict({ ...LOOK, age_s: LATE_MS / 1000 + 0.01 })).toBe("late");
  });
});

describe("what is kept", () => {
  test("is a span of time, each moment once; a clock that went back begins anew", () => {
    const past = noPast(["a"]);
    for (const t_s of [100, 101, 101, 111]) append(past, t_s, { a: t_s }, 10);
    expect(past).toEqual({ t_s: [101, 111], a: [101, 111] });
    expect(secondsAgo(past)).toEqual([-10, 0]);
    append(past, 50, { a: null }, 10);
    expect(past).toEqual({ t_s: [50], a: [null] });
    for (let number = 0; number < 5000; number++) append(past, 51 + number / 1000, { a: 1 }, 10);
    expect(past.a.length).toBe(1500);
  });

  test("of a counter grows, also over a new beginning and a gap", () => {
    expect(growth([])).toBe(0);
    expect(growth([7, null, 7, 9])).toBe(2);
    expect(growth([7, 0, 3])).toBe(3);
  });
});

describe("the panel", () => {
  let rest: FakeRest;

  beforeEach(() => {
    vi.stubGlobal("ResizeObserver", class { observe(): void {} disconnect(): void {} });
    rest = new FakeRest();
  });
  afterEach(cleanup);

  const open = (): void => {
    const details = document.querySelector("details")!;
    details.open = true;
    fireEvent(details, new Event("toggle"));
  };

  test("asks for nothing before it is opened, then shows figures with units, curves and a word", async () => {
    const drawn = vi.spyOn(Charts.prototype, "show");
    rest.answer("GET /robot/link", [200, { ...REPORT, damaged: 7, received: 1000, supply_v: null }]);
    render(h(LinkPanel, null));
    expect(rest.requests).toEqual([]);
    open();
    await screen.findByText("Damaged frames.");
    const figure = (name: string): string => screen.getByText(name, { selector: "dt" }).nextElementSibling!.textContent;
    expect(figure("Telemetry rate")).toBe("10.0 Hz");
    expect(figure("Round trip, slowest")).toBe("4.1 ms");
    expect(figure("Frames damaged here")).toBe("7");
    expect(figure("Temperature of the board")).toBe("31.4 °C");
    expect(figure("Supply of the board")).toBe("–");
    await waitFor(() => expect(drawn.mock.lastCall?.[0]).toEqual([[[0], [1.2], [2.1]], [[0], [10.01]]]));
    expect(screen.getByRole("status").dataset["tone"]).toBe("ask");
  });

  test("says that nobody answers instead of an old verdict", async () => {
    rest.answer("GET /robot/link", new TypeError("offline"));
    render(h(LinkPanel, null));
    open();
    await waitFor(() => expect(screen.getByRole("alert").textContent).not.toBe(""));
    expect(screen.queryByRole("status")).toBeNull();
  });
});
