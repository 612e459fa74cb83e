import { cleanup, fireEvent, render, screen, waitFor } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, beforeEach, describe, expect, test } from "vitest";
import type { ProtocolFrame } from "@/api/wire";
import { ConsolePanel } from "@/technician/console/panel";
import { grown, KEPT, lineOf, matches, WORTH_SEEING } from "@/technician/console/tail";
import { FakeRest } from "./rest";

const frame = (changes: Partial<ProtocolFrame> = {}): ProtocolFrame => ({
  number: 1,
  at: "2026-03-01T18:04:05.120Z",
  direction: "to_board",
  kind: "Segment",
  words: "16 segments to rho1=12",
  size_bytes: 40,
  error: false,
  ...changes,
});

describe("the filter", () => {
  const all = { ...WORTH_SEEING, kind: "all" };

  test("leaves the routine out at first, but not when it tells of an error", () => {
    expect(matches(frame({ kind: "Heartbeat" }), WORTH_SEEING)).toBe(false);
    expect(matches(frame({ kind: "Telemetry", error: true }), WORTH_SEEING)).toBe(true);
    expect(matches(frame(), WORTH_SEEING)).toBe(true);
    expect(matches(frame({ kind: "Heartbeat" }), all)).toBe(true);
  });

  test("takes direction, kind, errors and words together", () => {
    expect(matches(frame(), { ...all, direction: "from_board" })).toBe(false);
    expect(matches(frame(), { ...all, kind: "Stop" })).toBe(false);
    expect(matches(frame(), { ...all, errorsOnly: true })).toBe(false);
    expect(matches(frame(), { ...all, search: " RHO1=12 " })).toBe(true);
    expect(matches(frame(), { ...all, search: "rho9" })).toBe(false);
  });
});

test("memory is bounded and the newest stay", () => {
  const many = Array.from({ length: KEPT + 50 }, (_, number) => frame({ number }));
  const kept = grown(grown([], many), [frame({ number: 99999 })]);
  expect(kept.length).toBe(KEPT);
  expect(kept.at(-1)?.number).toBe(99999);
  expect(grown(kept, [])).toBe(kept);
});

test("a line of the file says everything", () => {
  expect(lineOf(frame())).toBe("2026-03-01T18:04:05.120Z -> Segment 40 B 16 segments to rho1=12");
});

describe("the panel", () => {
  let rest: FakeRest;
  const answer = (frames: ProtocolFrame[], more: object = {}): [number, unknown] => [
    200,
    { frames, newest: 2, lost: 0, available: true, ...more },
  ];

  beforeEach(() => {
    rest = new FakeRest()
      .answer("GET /robot/frames?after=0", answer([frame(), frame({ number: 2, kind: "Stop", words: "token=7" })]))
      .answer("GET /robot/frames?after=2", answer([]));
    render(h(ConsolePanel, null));
  });
  afterEach(cleanup);

  const open = (): void => {
    const details = document.querySelector("details")!;
    details.open = true;
    fireEvent(details, new Event("toggle"));
  };

  test("asks for nothing before it is opened, then shows and searches", async () => {
    expect(rest.requests).toEqual([]);
    open();
    await screen.findByText("token=7");
    fireEvent.input(screen.getByLabelText("Search"), { target: { value: "token" } });
    await waitFor(() => expect(document.querySelectorAll("ol li").length).toBe(1));
    expect(document.body.textContent).toContain("1 of 2 frames");
  });

  test("keeps nothing while it is paused", async () => {
    open();
    await screen.findByText("token=7");
    fireEvent.click(screen.getByRole("button", { name: "Pause" }));
    rest.answer("GET /robot/frames?after=2", answer([frame({ number: 3, words: "late" })], { newest: 3 }));
    rest.answer("GET /robot/frames?after=3", answer([], { newest: 3 }));
    await waitFor(() => expect(rest.requests.at(-1)?.what).toBe("GET /robot/frames?after=3"));
    expect(document.body.textContent).not.toContain("late");
  });

  test("says when the driver cannot tell", async () => {
    rest.answer("GET /robot/frames?after=0", answer([], { available: false, newest: 0 }));
    open();
    await screen.findByText(/cannot tell what goes over/);
  });
});
