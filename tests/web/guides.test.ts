import { cleanup, fireEvent, render, screen, waitFor, within } from "@testing-library/preact";
import { afterEach, beforeAll, beforeEach, describe as suite, expect, test, vi } from "vitest";
import { h } from "preact";
import { App } from "@/app";
import { loadGuide } from "@/guides/dialog";
import { GUIDED, guideOf } from "@/guides/guides";
import { guides as de } from "@/language/de/guides";
import { guides as en } from "@/language/en/guides";
import { guides as fr } from "@/language/fr/guides";
import { guides as it } from "@/language/it/guides";
import { speak } from "@/language/catalogue";
import { PROBLEM_CODES } from "@/language/problems";
import { channel } from "@/live/page";
import { guideOpen } from "@/parts/guide";
import { pending, question } from "@/robot/actions";
import { describe } from "@/robot/describe";
import type { Live } from "@/api/wire";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { job, live, robot, snapshot } from "./states";

/** Refusals of a press: they are shown beside the button, and nobody is asked to go and look. */
const REFUSALS = new Set<string>([
  "error", "invalid_request", "not_simulated", "control", "control_busy", "control_lost",
  "control_held", "not_in_control", "nobody_asks", "control_request_pending", "job",
  "job_queue_full", "job_needs_person", "job_not_found", "job_ended", "cannot_pause", "not_paused",
  "schedule", "schedule_missed", "not_charging", "unknown_vehicle", "vehicle_required",
  "vehicle_in_use", "target_gone", "calibration_held", "charge_point", "charge_point_resting",
  "charge_point_unplugging", "storage", "disk_full", "disk_read_only", "disk_error",
  "database_busy", "database_broken", "database_unreachable", "recording", "no_recording",
  "recording_running", "playback_failed", "access", "not_paired", "forbidden", "wrong_origin",
  "unknown_host", "invitation", "too_many_attempts", "last_owner", "no_such_entry", "passkey",
  "push", "push_refused",
]);

const UNKNOWN = guideOf("of a newer server");
const asking = (code: string): Live =>
  live({
    robot: robot({ plug: "free" }),
    job: job({ needs_person: { code, sentence: "Look.", choices: ["resume", "cancel"] } }),
  });
const inMode = (mode: "stopped" | "emergency_stop" | "fault"): Live =>
  live({ robot: robot({ mode }) });

suite("the steps", () => {
  test("are there for every problem about which a person is asked", () => {
    const asked = PROBLEM_CODES.filter((code) => !REFUSALS.has(code));
    expect(asked.filter((code) => !GUIDED.includes(code))).toEqual([]);
    expect(GUIDED.filter((code) => REFUSALS.has(code))).toEqual([]);
  });

  test("are two to four, each once, and each is used somewhere", () => {
    const all = [...GUIDED.map(guideOf), UNKNOWN];
    for (const steps of all) {
      expect(steps.length).toBeGreaterThanOrEqual(2);
      expect(steps.length).toBeLessThanOrEqual(4);
      expect(new Set(steps).size).toBe(steps.length);
    }
    expect(new Set(all.flat())).toEqual(new Set(Object.keys(en.steps)));
  });

  test("of whatever latches ask for room before anything is released", () => {
    const faults = ["emergency_stop", "limit_switch", "stall", "queue_underrun", "heartbeat_lost"];
    faults.push("segment_mismatch", "homing_failed", "watchdog", "following_error", "stopped");
    for (const code of [...faults, "plug_unknown", "of a newer server"]) {
      expect([code, guideOf(code).includes("clear")]).toEqual([code, true]);
    }
  });

  test("are said in four languages, in whole sentences", () => {
    for (const each of [en, de, fr, it]) {
      for (const sentence of Object.values(each.steps)) expect(sentence).toMatch(/[.?]$/);
    }
    expect(Object.values(fr.steps).filter((text) => / [?!:;»]|« /.test(text))).toEqual([]);
  });
});

suite("a state", () => {
  test.each([
    ["at rest", live(), null],
    ["on its way", live({ robot: robot({ mode: "moving" }), job: job() }), null],
    ["paused by somebody", live({ job: job({ paused: true }) }), null],
    ["of an unknown plug", live({ robot: robot({ plug: "unknown" }) }), "plug_unknown"],
    ["without its board", live({ robot: robot({ mode: "offline" }) }), "robot_offline"],
    ["stopped", inMode("stopped"), "stopped"],
    ["of an emergency stop", inMode("emergency_stop"), "emergency_stop"],
    ["of a fault without a name", inMode("fault"), "robot_fault"],
    ["that asks", asking("insertion_jammed"), "insertion_jammed"],
  ] as const)("%s has steps when it asks a person", (_, state, help) => {
    expect(describe(state).help).toBe(help);
  });
});

suite("the dialog", () => {
  let rest: FakeRest;

  // The first time takes a while on a busy machine.
  beforeAll(async () => {
    await loadGuide();
  });

  beforeEach(() => {
    vi.stubGlobal("WebSocket", FakeSocket);
    rest = new FakeRest();
    rest.answer("POST /robot/reset", [202, {}]).answer("POST /jobs/job-1/resume", [202, job()]);
    rest.answer("POST /robot/plug-confirmation", [202, {}]);
    guideOpen.value = false;
    question.value = null;
    channel.start();
    render(h(App, null));
  });

  afterEach(async () => {
    await waitFor(() => expect(pending.value).toBe(false));
    channel.close();
    cleanup();
    await speak("en");
  });

  async function opened(state: Live): Promise<ReturnType<typeof within>> {
    FakeSocket.newest.says(snapshot(state));
    fireEvent.click(await screen.findByRole("button", { name: "Show me how" }));
    return within(await screen.findByRole("dialog"));
  }

  test("ends in the button that goes on", async () => {
    const dialog = await opened(asking("connector_locked"));
    const items: HTMLElement[] = dialog.getAllByRole("listitem");
    expect(items.map((item) => item.textContent)).toEqual([
      en.steps.unlockCar,
      en.steps.clear,
    ]);
    fireEvent.click(dialog.getByRole("button", { name: "Go on" }));
    await waitFor(() => expect(rest.commands).toEqual(["POST /jobs/job-1/resume"]));
    expect(screen.queryByRole("dialog")).toBeNull();
  });

  test("asks nothing twice: its steps are the question", async () => {
    const dialog = await opened(inMode("emergency_stop"));
    fireEvent.click(dialog.getByRole("button", { name: "Release the stop" }));
    await waitFor(() => expect(rest.commands).toEqual(["POST /robot/reset"]));
    expect(question.value).toBeNull();
  });

  test("confirms that the plug is out", async () => {
    const dialog = await opened(live({ robot: robot({ plug: "unknown" }) }));
    fireEvent.click(dialog.getByRole("button", { name: "Yes, it is out" }));
    await waitFor(() => expect(rest.commands).toEqual(["POST /robot/plug-confirmation"]));
  });

  test("goes when nobody is asked any more, and does not come back by itself", async () => {
    await opened(live({ robot: robot({ mode: "offline" }) }));
    FakeSocket.newest.says(snapshot(live()));
    await waitFor(() => expect(screen.queryByRole("dialog")).toBeNull());
    FakeSocket.newest.says(snapshot(live({ robot: robot({ mode: "offline" }) })));
    await screen.findByRole("button", { name: "Show me how" });
    expect(screen.queryByRole("dialog")).toBeNull();
  });

  test("speaks another language as soon as it is chosen", async () => {
    const dialog = await opened(inMode("stopped"));
    await speak("it");
    await waitFor(() => expect(dialog.getAllByRole("listitem")[1]?.textContent).toBe(it.steps.clear));
  });
});
