import { cleanup, fireEvent, render, screen, waitFor } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import openapi from "../../web/openapi.json";
import { session } from "@/access/session";
import type { MoveTarget, Robot } from "@/api/wire";
import { channel } from "@/live/page";
import { TargetPanel } from "@/technician/target/panel";
import { placeAt, sightIn } from "@/technician/target/sight";
import { arrived, choosing, grip, target, trouble } from "@/technician/target/target";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { live, robot, snapshot } from "./states";

const TARGET = openapi.paths["/api/v1/robot/target"].post.responses["200"].content["application/json"]
  .example as unknown as MoveTarget;
const STANDING = {
  joints: { rho1_mm: 412.5, rho2_mm: 688.25, rho3_mm: 50 },
  tip: TARGET.way[0]!,
};

let rest: FakeRest;

beforeEach(() => {
  vi.stubGlobal("WebSocket", FakeSocket);
  FakeSocket.made.length = 0;
  rest = new FakeRest().answer("POST /robot/target", [200, TARGET]);
  target.value = null;
  trouble.value = null;
  arrived.value = false;
  session.value = null;
  channel.start();
  render(h(TargetPanel, null));
  const details = document.querySelector("details")!;
  details.open = true;
  fireEvent(details, new Event("toggle"));
});

afterEach(async () => {
  grip.release();
  cleanup();
  await waitFor(() => expect(choosing.value).toBe(false));
  channel.close();
});

const show = (changes: Partial<Robot> = {}): void =>
  FakeSocket.newest.says(snapshot(live({ robot: robot({ commanded: STANDING, ...changes }) })));
const sent = (): object[] =>
  FakeSocket.newest.sent.map(({ id: _id, ...message }) => message as object);

async function chosen(): Promise<HTMLButtonElement> {
  show();
  const [x, y] = [await screen.findByLabelText("x, mm"), screen.getByLabelText("y, mm")];
  fireEvent.input(x, { target: { value: "700" } });
  fireEvent.input(y, { target: { value: "360" } });
  await waitFor(() => expect(button("Show the way").disabled).toBe(false));
  fireEvent.click(button("Show the way"));
  return (await screen.findByRole("button", { name: "Hold to move there" })) as HTMLButtonElement;
}

const button = (name: string): HTMLButtonElement => screen.getByRole("button", { name });
const press = (on: HTMLElement): void => {
  fireEvent(on, Object.assign(new Event("pointerdown", { bubbles: true }), { isPrimary: true, button: 0 }));
};

describe("a place", () => {
  test("is shown with its way and forces, and nothing moves", async () => {
    await chosen();
    await screen.findByText("87.6 mm");
    await screen.findByText("61 of 150 N");
    expect(rest.requests.at(-1)?.body).toEqual({ x_mm: 700, y_mm: 360, speed_mm_s: 5 });
    expect(sent()).toEqual([]);
  });

  test("is gone to only while the button is held", async () => {
    const hold = await chosen();
    press(hold);
    expect(sent()).toEqual([{ type: "move_to", target_id: TARGET.id }]);
    fireEvent(window, new Event("pointerup"));
    expect(sent().at(-1)).toEqual({ type: "jog_end" });
  });

  test("is reached: the hand has nothing more to do", async () => {
    press(await chosen());
    show({ commanded: { joints: TARGET.joints, tip: TARGET.tip } });
    await screen.findByText("The plug is there.");
    expect(grip.held.value).toBeNull();
  });

  test("is planned anew from where the robot was let go", async () => {
    await chosen();
    const asked = rest.requests.filter(({ what }) => what === "POST /robot/target").length;
    show({ commanded: { joints: { rho1_mm: 430, rho2_mm: 660, rho3_mm: 50 }, tip: TARGET.way[1]! } });
    await waitFor(() =>
      expect(rest.requests.filter(({ what }) => what === "POST /robot/target").length).toBe(asked + 1),
    );
  });

  test("that is refused says why", async () => {
    rest.answer("POST /robot/target", [
      409,
      { code: "out_of_reach", title: "Out of reach", detail: "12 mm too far.", remedy: "Choose a nearer place." },
    ]);
    show();
    fireEvent.input(await screen.findByLabelText("x, mm"), { target: { value: "9000" } });
    fireEvent.input(screen.getByLabelText("y, mm"), { target: { value: "1" } });
    await waitFor(() => expect(button("Show the way").disabled).toBe(false));
    fireEvent.click(button("Show the way"));
    await waitFor(() => expect(document.body.textContent).toContain("12 mm too far."));
  });

  test("that is no number is not asked for", async () => {
    show();
    await waitFor(() => expect(button("Show the way").disabled).toBe(false));
    fireEvent.click(button("Show the way"));
    await screen.findByText("Both places must be numbers.");
    expect(rest.commands).toEqual([]);
  });
});

describe("a click", () => {
  test("is a place in the plane of the plug's tip", () => {
    const sight = sightIn({ twin: "picked", origin_mm: [600, 900, 1142], direction: [0, -0.6, -0.8] });
    expect(placeAt(sight!, 142)).toEqual({ x_mm: 600, y_mm: 150 });
  });

  test.each([
    [{ origin_mm: [0, 0, 100], direction: [0, 0, 1] }, 50],
    [{ origin_mm: [0, 0, 100], direction: [1, 0, 0.01] }, 200],
  ] as const)("behind or beside is none", (sight, z_mm) => {
    expect(placeAt(sight, z_mm)).toBeNull();
  });

  test.each([null, "picked", { twin: "live" }, { twin: "picked", origin_mm: [1, 2], direction: [0, 0, 1] }])(
    "is not every message: %j",
    (message) => {
      expect(sightIn(message)).toBeNull();
    },
  );
});
