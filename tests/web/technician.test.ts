import { cleanup, fireEvent, render, screen, waitFor } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { session } from "@/access/session";
import type { Live } from "@/api/wire";
import { channel } from "@/live/page";
import { pending } from "@/robot/actions";
import { Technician } from "@/technician/app";
import { wayOfGamepad } from "@/technician/jog/gamepad";
import { deadMan, frame, speed_mm_s, step, trouble } from "@/technician/jog/jog";
import { empty, record } from "@/technician/readings/history";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { at, live, robot, snapshot } from "./states";

vi.mock("uplot", () => ({
  default: class {
    setData(): void {}
    setSize(): void {}
    destroy(): void {}
  },
}));

let rest: FakeRest;

beforeEach(() => {
  vi.stubGlobal("WebSocket", FakeSocket);
  vi.stubGlobal("ResizeObserver", class { observe(): void {} disconnect(): void {} });
  Object.assign(navigator, { getGamepads: () => [] });
  FakeSocket.made.length = 0;
  rest = new FakeRest();
  rest.answer("POST /robot/enable", [202, {}]);
  frame.value = "base";
  step.value = "hold";
  speed_mm_s.value = 5;
  trouble.value = null;
  session.value = null;
  channel.start();
  render(h(Technician, null));
});

afterEach(async () => {
  deadMan.release();
  await waitFor(() => expect(pending.value).toBe(false));
  channel.close();
  cleanup();
});

const show = (state: Live): void => FakeSocket.newest.says(snapshot(state));
/** A button, whatever its name says of the way left. */
const named = (name: string): { name: RegExp } => ({ name: new RegExp(`^${name}(,|$)`) });
const button = (name: string): HTMLButtonElement => screen.getByRole("button", named(name));
const find = (name: string): Promise<HTMLElement> => screen.findByRole("button", named(name));
/** Jog messages and stops, without the numbers that the channel gives them. */
const sent = (): object[] =>
  FakeSocket.newest.sent.map(({ id: _id, ...message }) => message as object);

/** A primary pointer goes down. */
function press(name: string, more: object = {}): void {
  const event = new Event("pointerdown", { bubbles: true });
  fireEvent(button(name), Object.assign(event, { isPrimary: true, button: 0, ...more }));
}

describe("jogging by holding", () => {
  test("begins with the finger and ends with it", async () => {
    show(live());
    await waitFor(() => expect(button("Up").disabled).toBe(false));
    press("Up");
    fireEvent(window, new Event("pointerup"));
    expect(sent()).toEqual([
      { type: "jog", axis: "y", direction: 1, speed_mm_s: 5 },
      { type: "jog_end" },
    ]);
  });

  test("ends when the finger slides off the button", async () => {
    show(live());
    await waitFor(() => expect(button("Up").disabled).toBe(false));
    press("Up");
    fireEvent.pointerLeave(button("Up"));
    expect(sent().at(-1)).toEqual({ type: "jog_end" });
  });

  test("does not begin with a second finger", async () => {
    show(live());
    await waitFor(() => expect(button("Up").disabled).toBe(false));
    press("Up", { isPrimary: false });
    expect(sent()).toEqual([]);
  });

  test("works with keys while the box has the focus", async () => {
    show(live());
    const box = await screen.findByRole("region", { name: "Move by hand" });
    await waitFor(() => expect(button("Up").disabled).toBe(false));
    fireEvent.keyDown(box, { key: "ArrowLeft" });
    fireEvent.keyDown(box, { key: "ArrowLeft", repeat: true });
    fireEvent.keyUp(box, { key: "ArrowLeft" });
    expect(sent()).toEqual([
      { type: "jog", axis: "x", direction: -1, speed_mm_s: 5 },
      { type: "jog_end" },
    ]);
  });

  test("ends when somebody chooses another speed meanwhile", async () => {
    show(live());
    await waitFor(() => expect(button("Up").disabled).toBe(false));
    press("Up");
    fireEvent.click(button("20"));
    expect(sent().at(-1)).toEqual({ type: "jog_end" });
  });
});

describe("somebody who may only look", () => {
  const looking = {
    paired: true,
    person: { id: "1", name: "Anna", role: "viewer", ends_at: null },
    device_id: "2",
    rights: ["anyone", "person", "read", "stop"],
    passkeys: false,
    screen: false,
  } as const;

  test("cannot jog, and reads why", async () => {
    session.value = looking;
    show(live());
    await screen.findByText(/Only a technician or an owner/);
    press("Up");
    expect(sent()).toEqual([]);
    expect(button("Find position").disabled).toBe(true);
  });

  test("can stop all the same", async () => {
    session.value = looking;
    show(live());
    fireEvent.click(await screen.findByRole("button", { name: "Stop" }));
    expect(sent().at(-1)).toEqual({ type: "stop" });
  });
});

describe("steps", () => {
  test("move one axis by the chosen distance", async () => {
    show(live());
    await waitFor(() => expect(button("Up").disabled).toBe(false));
    fireEvent.click(button("Joints"));
    fireEvent.click(button("0.1"));
    await find("Slide out");
    press("Slide out");
    expect(sent()).toEqual([
      { type: "jog_step", step: { axis: "rho3", distance_mm: 0.1, speed_mm_s: 5 } },
    ]);
    await waitFor(() => expect(button("Slide in").disabled).toBe(true));
    FakeSocket.newest.says({
      type: "reply",
      id: FakeSocket.newest.sent.at(-1)!.id!,
      ok: false,
      problem: {
        type: "x",
        title: "Out of reach",
        status: 409,
        code: "out_of_reach",
        detail: "rho3 is at the end of its travel.",
        remedy: "Move the other way.",
      },
    });
    await screen.findByText(/Out of reach. rho3 is at the end/);
  });
});

describe("what is not open", () => {
  test.each([
    ["off", "The drives are off: switch them on first."],
    ["not_homed", "The position is not known: find it first."],
    ["fault", "There is a fault: release it first."],
    ["stopped", "Somebody pressed Stop: release it first."],
  ] as const)("says why: %s", async (mode, words) => {
    show(live({ robot: robot({ mode }) }));
    await screen.findByText(words);
    expect(button("Up").disabled).toBe(true);
    press("Up");
    expect(sent()).toEqual([]);
  });

  test("names who has control", async () => {
    const control = { kind: "job", name: "Charging job", since: at(0) } as const;
    show(live({ robot: robot({ control }) }));
    await screen.findByText("The running job has control.");
  });

  test("leaves only the way out with the plug in a socket", async () => {
    show(live({ robot: robot({ plug: "inserted" }) }));
    await screen.findByText("The plug may be in a socket: only the way out is open.");
    expect(button("Up").disabled).toBe(true);
    expect(button("To the car").disabled).toBe(true);
    expect(button("Away from the car").disabled).toBe(false);
  });

  test("is everything while the values are old", async () => {
    show(live());
    await waitFor(() => expect(button("Up").disabled).toBe(false));
    FakeSocket.newest.breaks();
    await waitFor(() => expect(button("Up").disabled).toBe(true));
  });
});

describe("the way left", () => {
  test("is on every button before it is reached, and an end is closed", async () => {
    const open = { back_mm: 40, on_mm: 112.4 };
    const reach = { x: { back_mm: 0, on_mm: 200 }, y: open, insertion: open, rho1: open, rho2: open, rho3: open };
    rest.answer("GET /robot/reach", [200, reach]);
    const joints = { rho1_mm: 1, rho2_mm: 2, rho3_mm: 3 };
    show(live({ robot: robot({ commanded: { joints, tip: null } }) }));
    await waitFor(() => expect(button("Up").textContent).toBe("112 mm"));
    expect(button("Back along the rail").textContent).toBe("end");
    expect(button("Back along the rail").disabled).toBe(true);
    show(live({ robot: robot({ mode: "moving", commanded: { joints, tip: null } }) }));
    await waitFor(() => expect(button("Up").textContent).toBe(""));
  });
});

describe("stop", () => {
  test("is there in every state and needs one press", async () => {
    show(live({ robot: robot({ mode: "off" }) }));
    fireEvent.pointerDown(await find("Stop"));
    fireEvent.pointerDown(button("Emergency stop"));
    await waitFor(() =>
      expect(sent()).toEqual([{ type: "stop" }, { type: "emergency_stop" }]),
    );
  });

  test("is the space bar while something moves, and only then", async () => {
    show(live());
    await waitFor(() => expect(button("Up").disabled).toBe(false));
    fireEvent.keyDown(window, { key: " " });
    expect(sent()).toEqual([]);
    press("Up");
    fireEvent.keyDown(window, { key: " " });
    expect(sent().slice(-2)).toEqual([{ type: "jog_end" }, { type: "stop" }]);
  });
});

describe("values", () => {
  test("show the following error", async () => {
    const joints = { rho1_mm: 100, rho2_mm: 200, rho3_mm: 80 };
    show(
      live({
        robot: robot({
          measured: { joints: { ...joints, rho3_mm: 79.87 }, tip: null, force_n: -3.24 },
          commanded: { joints, tip: null },
        }),
      }),
    );
    await screen.findByText("-0.13");
    await screen.findByText("-3.2 N");
  });

  test("of the last minute are kept, and a clock that went back begins anew", () => {
    const columns = empty();
    for (let t = 0; t <= 90; t += 1) record(columns, robot({ updated_at: at(t) }));
    expect(columns.t_s.length).toBe(61);
    expect(record(columns, robot({ updated_at: at(90) }))).toBe(false);
    expect(record(columns, robot({ updated_at: at(3) }))).toBe(true);
    expect(columns.t_s.length).toBe(1);
    expect(columns.error1).toEqual([null]);
  });
});

describe("a gamepad", () => {
  const pad = (axes: number[], shoulder: boolean): Pick<Gamepad, "axes" | "buttons"> => ({
    axes,
    buttons: [0, 1, 2, 3, 4].map((n) => ({ pressed: n === 4 && shoulder, touched: false, value: 0 })),
  });

  test("moves only with its shoulder button held", () => {
    expect(wayOfGamepad(pad([0, -1, 0, 0], true))).toEqual({ axis: "y", direction: 1 });
    expect(wayOfGamepad(pad([0, -1, 0, 0], false))).toBeNull();
  });

  test("does nothing for a stick that rests or two that are pushed", () => {
    expect(wayOfGamepad(pad([0.2, 0.1, 0, -0.3], true))).toBeNull();
    expect(wayOfGamepad(pad([1, -1, 0, 0], true))).toBeNull();
    expect(wayOfGamepad(pad([0, 0, 0, 0.9], true))).toEqual({ axis: "insertion", direction: -1 });
  });
});
