import { describe as suite, expect, test } from "vitest";
import type { Job, Live } from "@/api/wire";
import { describe } from "@/robot/describe";
import type { Description } from "@/robot/describe";
import { MODES, PHASES, PLUGS, STATES, TYPES, at, job, live, robot, station } from "./states";

/** Every combination that the wire models allow: 10 modes, 4 plug states, 271 jobs. */
function* everyState(): Generator<Live> {
  const jobs: (Job | null)[] = [null];
  for (const type of TYPES)
    for (const state of STATES)
      for (const phase of PHASES)
        for (const cancel_requested of [false, true])
          jobs.push(job({ type, state, phase, cancel_requested }));
  for (const mode of MODES)
    for (const plug of PLUGS)
      for (const each of jobs) yield live({ robot: robot({ mode, plug }), job: each });
}

const active = (state: Live): boolean =>
  state.job !== null && ["queued", "running"].includes(state.job.state);
const latched = (state: Live): boolean =>
  ["stopped", "emergency_stop", "fault"].includes(state.robot.mode);

/** Checks a rule for every state; a failure names the state. */
function always(rule: (state: Live, said: Description) => boolean): void {
  let checked = 0;
  for (const state of everyState()) {
    const said = describe(state);
    const { mode, plug } = state.robot;
    if (!rule(state, said)) expect.fail(JSON.stringify({ mode, plug, job: state.job, said }));
    checked += 1;
  }
  expect(checked).toBe(10 * 4 * (1 + 3 * 5 * 9 * 2));
}

suite("in every state", () => {
  test("there is a headline and a detail", () => {
    always((_, { headline, detail }) => headline.length > 3 && detail.length > 10);
  });

  test("a charge is offered only with the plug safely out and nothing going on", () => {
    always(
      (state, { action }) =>
        action?.kind !== "charge" ||
        (["parked", "free"].includes(state.robot.plug) &&
          ["ready", "off", "not_homed"].includes(state.robot.mode) &&
          !active(state)),
    );
  });

  test("unplugging is offered only with the plug in the car and nothing going on", () => {
    always(
      (state, { action }) =>
        action?.kind !== "unplug" || (state.robot.plug === "inserted" && !active(state)),
    );
  });

  test("a latched state offers its release and nothing else", () => {
    always((state, { action }) => latched(state) === (action?.kind === "reset"));
  });

  test("an unknown plug at rest asks a person", () => {
    always(
      (state, { action }) =>
        (action?.kind === "confirm_plug") ===
        (state.robot.plug === "unknown" &&
          !active(state) &&
          !latched(state) &&
          !["offline", "stopping"].includes(state.robot.mode)),
    );
  });

  test("stop is there whenever something moves", () => {
    always(
      (state, { stoppable }) =>
        stoppable || !["homing", "moving", "stopping"].includes(state.robot.mode),
    );
  });

  test("stop is there while a job is about to move", () => {
    always((state, { stoppable }) => {
      const still = ["plugged", "charging"].includes(state.job?.phase ?? "");
      const able = ["off", "not_homed", "ready"].includes(state.robot.mode);
      return stoppable || !active(state) || still || !able;
    });
  });

  test("finish is offered only while charging, cancel only before the way back", () => {
    always((state, { action }) => {
      const running = active(state) && !state.job!.cancel_requested;
      if (action?.kind === "finish") return running && state.job!.phase === "charging";
      if (action?.kind !== "cancel") return true;
      const returning = ["releasing", "withdrawing", "parking"].includes(state.job!.phase);
      return running && (!returning || state.job!.state === "queued");
    });
  });

  test("the picture never shows a lightning bolt unless the car charges", () => {
    always((state, { scene }) => scene.mark !== "bolt" || state.job?.phase === "charging");
  });

  test("a person never reads the machine's words", () => {
    always((_, { headline, detail }) => !/_|undefined|null|NaN/.test(headline + detail));
  });
});

suite("the sentence", () => {
  const said = (changes: Partial<Live>): Description => describe(live(changes));

  test("at rest invites to charge", () => {
    expect(said({})).toMatchObject({
      headline: "Ready to charge",
      tone: "calm",
      stoppable: false,
      action: { kind: "charge", label: "Charge" },
      scene: { arm: "parked", mark: "none" },
    });
  });

  test.each([
    ["locating", "Finding the socket", "busy", "cancel"],
    ["inserting", "Plugging in", "busy", "cancel"],
    ["charging", "Your car is charging", "good", "finish"],
    ["withdrawing", "Unplugging", "busy", undefined],
  ] as const)("follows the phase %s", (phase, headline, tone, kind) => {
    const found = said({ robot: robot({ mode: "moving" }), job: job({ phase }) });
    expect(found).toMatchObject({ headline, tone });
    expect(found.action?.kind).toBe(kind);
  });

  test("says that a job finds the position first", () => {
    const found = said({ robot: robot({ mode: "homing" }), job: job({ phase: "preflight" }) });
    expect(found).toMatchObject({ headline: "Finding its position", action: { kind: "cancel" } });
  });

  test("waiting for the current can be broken off, by cancelling: there is nothing to finish", () => {
    expect(said({ job: job({ phase: "plugged" }) }).action).toEqual({
      kind: "cancel",
      label: "Stop and unplug",
    });
  });

  test("tells why a job failed and what to do, until that is put away", () => {
    const error = {
      type: "urn:plugpilot:problem:label_not_found",
      title: "Label not found",
      status: 409,
      code: "label_not_found",
      detail: "No label in sight.",
      remedy: "Clean the label.",
      context: {},
    };
    const state = live({ job: job({ state: "failed", error }) });
    expect(describe(state)).toMatchObject({
      headline: "The car could not be charged",
      detail: "No label in sight.",
      remedy: "Clean the label.",
      tone: "problem",
      action: { kind: "charge", label: "Try again" },
    });
    expect(describe(state, "another job").tone).toBe("problem");
    expect(describe(state, "job-1").headline).toBe("Ready to charge");
  });

  test("says so when the plug is still in the car after a failure", () => {
    const found = said({ robot: robot({ plug: "inserted" }), job: job({ state: "failed" }) });
    expect(found.detail).toMatch(/^The plug is still in the car\./);
    expect(found.action?.kind).toBe("unplug");
  });

  test("of a fault is the robot's own", () => {
    const fault = { code: "stall", title: "Blocked", detail: "It hit something.", remedy: "Look." };
    expect(said({ robot: robot({ mode: "fault", fault }) })).toMatchObject({
      headline: "Blocked",
      detail: "It hit something.",
      remedy: "Look.",
    });
  });

  test("of a missing link is the robot's own as soon as it knows why", () => {
    const fault = { code: "x", title: "No board", detail: "No such port.", remedy: "Plug it in." };
    expect(said({ robot: robot({ mode: "offline", fault }) })).toMatchObject({
      headline: "No board",
      detail: "No such port.",
      remedy: "Plug it in.",
      action: null,
    });
    expect(said({ robot: robot({ mode: "offline" }) })).toMatchObject({
      headline: "The robot is not answering",
      remedy: "",
    });
  });

  test("of an emergency stop tells how to end it, whoever pressed it", () => {
    const fault = { code: "emergency_stop", title: "Stop", detail: "Open.", remedy: "Turn it." };
    const mode = "emergency_stop";
    expect(said({ robot: robot({ mode, fault }) }).remedy).toBe("Turn it.");
    expect(said({ robot: robot({ mode }) }).remedy).toContain("release the stop");
  });

  test("names who moves the robot by hand", () => {
    const control = { kind: "jog" as const, name: "Anna", since: at(0) };
    expect(said({ robot: robot({ mode: "moving", control }) }).detail).toContain("Anna");
  });

  test("praises a finished charge for half an hour, then invites again", () => {
    const done = job({ state: "succeeded", phase: "parking", result: { energy_wh: 21_480 } });
    const after = (seconds: number): Description =>
      said({ robot: robot({ updated_at: at(seconds) }), job: done });
    expect(after(60).headline).toBe("Charging is done");
    expect(after(60).detail).toContain("21.5\u00a0kWh");
    expect(after(1801).headline).toBe("Ready to charge");
  });

  test("tells that a plugged-in car charges by the station's power", () => {
    const plugged = robot({ plug: "inserted" });
    expect(said({ robot: plugged }).headline).toBe("The car is plugged in");
    expect(said({ robot: plugged, station: station({ power_w: 7400 }) })).toMatchObject({
      headline: "Your car is charging",
      scene: { mark: "bolt" },
    });
  });

  test("of a cancelled job follows it home", () => {
    const of = (phase: Job["phase"]): string =>
      said({ job: job({ phase, cancel_requested: true }) }).headline;
    expect(of("aligning")).toBe("Cancelling");
    expect(of("charging")).toBe("Ending the charge");
    expect(of("parking")).toBe("Going back to its place");
  });
});

suite("a job that waits", () => {
  const kinds = ({ action, others }: Description): string[] =>
    [action, ...others].flatMap((each) => (each === null ? [] : [each.kind]));

  test("can be paused while the plug is not on its way out", () => {
    for (const phase of PHASES) {
      const said = describe(live({ job: job({ phase }) }));
      const pausable = ["locating", "aligning", "inserting", "plugged", "charging"].includes(phase);
      expect([phase, kinds(said).includes("pause")]).toEqual([phase, pausable]);
    }
  });

  test("is called paused, goes on or is given up, and nothing moves", () => {
    const said = describe(live({ job: job({ phase: "aligning", paused: true }) }));
    expect(said.headline).toBe("Paused");
    expect(kinds(said)).toEqual(["resume", "cancel"]);
    expect(said.stoppable).toBe(false);
  });

  test("for a person says why, and offers what the robot allows", () => {
    const needs = { code: "x", sentence: "Look whether something is in the socket." };
    const asks = (choices: ("resume" | "cancel")[]): Description =>
      describe(live({ job: job({ needs_person: { ...needs, choices } }) }));
    expect(asks(["resume", "cancel"]).detail).toBe(needs.sentence);
    expect(kinds(asks(["resume", "cancel"]))).toEqual(["resume", "cancel"]);
    expect(kinds(asks(["cancel"]))).toEqual(["cancel"]);
  });

  test("for its time says when, by the robot's clock", () => {
    const queued = { state: "queued", phase: "preflight", not_before: at(3600) } as const;
    const said = describe(live({ job: job(queued) }));
    expect(said.headline).toBe("The charge is planned");
    expect(kinds(said)).toEqual(["cancel"]);
    expect(said.action).toBeNull(); // a quiet button: nothing is going on
    expect(said.others).toEqual([{ kind: "cancel", label: "Cancel the plan" }]);
    const due = describe(live({ robot: robot({ updated_at: at(3601) }), job: job(queued) }));
    expect(due.headline).toBe("Getting ready");
  });

  test("for its time can be stopped only when that is near", () => {
    const queued = { state: "queued", phase: "preflight", not_before: at(3600) } as const;
    const stoppable = (seconds: number): boolean =>
      describe(live({ robot: robot({ updated_at: at(seconds) }), job: job(queued) })).stoppable;
    expect([0, 3500, 3541, 3601].map(stoppable)).toEqual([false, false, true, true]);
    const moving = robot({ mode: "moving" });
    expect(describe(live({ robot: moving, job: job(queued) })).stoppable).toBe(true);
  });
});
