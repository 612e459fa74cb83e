import { cleanup, fireEvent, render, screen, waitFor } from "@testing-library/preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { h } from "preact";
import { App } from "@/app";
import { channel } from "@/live/page";
import { hearStopKeys } from "@/parts/stop-key";
import { stopping } from "@/robot/actions";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { job, live, robot, snapshot } from "./states";

const MOVING = live({ robot: robot({ mode: "moving" }), job: job({ phase: "aligning" }) });

beforeEach(() => {
  vi.stubGlobal("WebSocket", FakeSocket);
  new FakeRest().answer("POST /robot/stop", [202, {}]);
  channel.start();
  render(h(App, null));
});

afterEach(async () => {
  await waitFor(() => expect(stopping.value).toBe(false));
  channel.close();
  cleanup();
});

const stops = (): number =>
  FakeSocket.newest.sent.filter(({ type }) => type === "stop").length;

/** A document in a frame, as far as keys go. */
function frame(): { readonly inside: EventTarget; readonly element: HTMLIFrameElement } {
  const inside = new EventTarget();
  return { inside, element: { contentWindow: inside } as unknown as HTMLIFrameElement };
}

function keyIn(target: EventTarget, key: string): KeyboardEvent {
  const event = new KeyboardEvent("keydown", { key, cancelable: true, bubbles: true });
  target.dispatchEvent(event);
  return event;
}

describe("the space bar", () => {
  test("stops what moves, and only that", async () => {
    FakeSocket.newest.says(snapshot(live()));
    await screen.findByRole("button", { name: "Charge" });
    keyIn(document.body, " ");
    expect(stops()).toBe(0);
    FakeSocket.newest.says(snapshot(MOVING));
    await screen.findByRole("button", { name: "Stop" });
    keyIn(document.body, " ");
    expect(stops()).toBe(1);
  });

  test("belongs to a control that has the focus", async () => {
    FakeSocket.newest.says(snapshot(MOVING));
    fireEvent.keyDown(await screen.findByRole("button", { name: "Cancel" }), { key: " " });
    expect(stops()).toBe(0);
  });

  test("stops from inside a frame, which then does not use it", async () => {
    FakeSocket.newest.says(snapshot(MOVING));
    await screen.findByRole("button", { name: "Stop" });
    const { inside, element } = frame();
    hearStopKeys(element);
    expect(keyIn(inside, " ").defaultPrevented).toBe(true);
    expect(stops()).toBe(1);
  });

  test("stays the frame's while nothing moves, as do all other keys", async () => {
    FakeSocket.newest.says(snapshot(live()));
    await screen.findByRole("button", { name: "Charge" });
    const { inside, element } = frame();
    hearStopKeys(element);
    expect(keyIn(inside, " ").defaultPrevented).toBe(false);
    expect(keyIn(inside, "a").defaultPrevented).toBe(false);
    expect(stops()).toBe(0);
  });
});
