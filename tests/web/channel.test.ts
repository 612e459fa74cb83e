import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { LiveChannel } from "@/live/channel";
import { LiveStore } from "@/live/store";
import { FakeSocket } from "./socket";
import { delta, live, robot, snapshot } from "./states";

let store: LiveStore;
let channel: LiveChannel;

beforeEach(() => {
  vi.useFakeTimers();
  FakeSocket.made.length = 0;
  store = new LiveStore();
  channel = new LiveChannel(store, {
    open: () => new FakeSocket() as unknown as WebSocket,
    nowMs: () => Date.now(),
    random: () => 0.5, // delays without spread
  });
  channel.start();
});

afterEach(() => {
  channel.close();
  vi.useRealTimers();
});

/** A healthy server for so many milliseconds: a robot that reports ten times a second. */
function report(milliseconds: number): void {
  for (let passed = 0; passed < milliseconds; passed += 100) {
    vi.advanceTimersByTime(100);
    FakeSocket.newest.says(
      delta({ robot: robot({ updated_at: new Date().toISOString() }) }, sequence++),
    );
  }
}

let sequence = 2;

describe("the channel after a sleep", () => {
  test("is live again within two seconds when the connection died meanwhile", () => {
    FakeSocket.newest.says(snapshot(live()));
    vi.advanceTimersByTime(900); // the server is silent, as after a sleep, but nobody knows
    channel.wake();
    const slept = FakeSocket.newest;
    expect(slept.sent.at(-1)).toMatchObject({ type: "resync" });
    vi.advanceTimersByTime(1500);
    expect(FakeSocket.newest).not.toBe(slept);
    FakeSocket.newest.says(snapshot(live({ robot: robot({ mode: "off" }) })));
    expect(store.link.value).toBe("live");
  });

  test("keeps a connection that lives", () => {
    FakeSocket.newest.says(snapshot(live()));
    const socket = FakeSocket.newest;
    channel.wake();
    vi.advanceTimersByTime(300);
    FakeSocket.newest.says(snapshot(live(), 2));
    report(2000);
    expect(FakeSocket.newest).toBe(socket);
    expect(store.link.value).toBe("live");
  });

  test("does not wait for its turn when the connection was lost", () => {
    FakeSocket.newest.breaks();
    const count = FakeSocket.made.length;
    channel.wake();
    expect(FakeSocket.made.length).toBe(count + 1);
  });

  test("says nothing while a connection is being opened", () => {
    channel.wake();
    expect(FakeSocket.newest.sent).toEqual([]);
    expect(FakeSocket.made.length).toBe(1);
  });
});

describe("the channel", () => {
  test("feeds the store", () => {
    FakeSocket.newest.says(snapshot(live()));
    expect(store.link.value).toBe("live");
    FakeSocket.newest.says(delta({ robot: robot({ mode: "moving" }) }, 2));
    expect(store.live.value?.robot.mode).toBe("moving");
  });

  test("reconnects for ever, ever more slowly, up to a limit", () => {
    const gaps: number[] = [];
    for (let attempt = 0; attempt < 12; attempt += 1) {
      FakeSocket.newest.breaks();
      const count = FakeSocket.made.length;
      const broken = Date.now();
      while (FakeSocket.made.length === count) vi.advanceTimersByTime(50);
      gaps.push(Date.now() - broken);
    }
    expect(gaps.slice(0, 3)).toEqual([250, 500, 1000]);
    expect(new Set(gaps.slice(2))).toEqual(new Set([1000]));
    expect(store.link.value).toBe("lost");
  });

  test("reconnects quickly again after a good connection", () => {
    for (let attempt = 0; attempt < 5; attempt += 1) {
      FakeSocket.newest.breaks();
      vi.advanceTimersByTime(8000);
    }
    FakeSocket.newest.says(snapshot(live()));
    expect(store.link.value).toBe("live");
    FakeSocket.newest.breaks();
    const count = FakeSocket.made.length;
    vi.advanceTimersByTime(250);
    expect(FakeSocket.made.length).toBe(count + 1);
  });

  test("does not wait when the network comes back", () => {
    for (let attempt = 0; attempt < 5; attempt += 1) {
      FakeSocket.newest.breaks();
      vi.advanceTimersByTime(8000);
    }
    FakeSocket.newest.breaks();
    const count = FakeSocket.made.length;
    channel.hurry();
    expect(FakeSocket.made.length).toBe(count + 1);
    channel.hurry();
    vi.advanceTimersByTime(100);
    expect(FakeSocket.made.length).toBe(count + 1);
  });

  test("gives up a connection that never speaks", () => {
    vi.advanceTimersByTime(6600);
    expect(FakeSocket.made.length).toBe(2);
  });

  test("asks a silent server once for a sign of life before anything is called stale", () => {
    FakeSocket.newest.says(snapshot(live()));
    vi.advanceTimersByTime(900);
    expect(FakeSocket.newest.sent).toEqual([{ type: "resync" }]);
    expect(store.stale.value).toBe(false);
    FakeSocket.newest.says(snapshot(live(), 2));
    vi.advanceTimersByTime(900);
    expect(FakeSocket.newest.sent).toHaveLength(2);
    expect(store.stale.value).toBe(false);
  });

  test("says stale, then gives up, when the server stays silent", () => {
    FakeSocket.newest.says(snapshot(live()));
    vi.advanceTimersByTime(1300);
    expect([store.stale.value, store.link.value]).toEqual([true, "live"]);
    vi.advanceTimersByTime(4000);
    expect(store.link.value).toBe("lost");
    vi.advanceTimersByTime(500);
    expect(FakeSocket.made.length).toBe(2);
  });

  test("leaves a talking server in peace", () => {
    FakeSocket.newest.says(snapshot(live()));
    report(20_000);
    expect(FakeSocket.newest.sent).toEqual([]);
    expect(FakeSocket.made.length).toBe(1);
    expect([store.stale.value, store.robotStale.value]).toEqual([false, false]);
  });

  test("hears nothing more of a connection it gave up", () => {
    FakeSocket.newest.says(snapshot(live()));
    const old = FakeSocket.newest;
    vi.advanceTimersByTime(6000);
    FakeSocket.newest.says(snapshot(live({ robot: robot({ mode: "off" }) })));
    old.says(snapshot(live({ robot: robot({ mode: "moving" }) })));
    old.breaks();
    expect(store.live.value?.robot.mode).toBe("off");
    expect(store.link.value).toBe("live");
  });
});

describe("a stop over the channel", () => {
  test("is confirmed by the reply to it, not by another", async () => {
    FakeSocket.newest.says(snapshot(live()));
    const first = channel.stop("stop");
    const second = channel.stop("emergency_stop");
    expect(FakeSocket.newest.sent).toEqual([
      { type: "stop", id: 1 },
      { type: "emergency_stop", id: 2 },
    ]);
    FakeSocket.newest.says({ type: "reply", id: 2, ok: true, problem: null });
    vi.advanceTimersByTime(400);
    expect(await first).toBe(false);
    expect(await second).toBe(true);
  });

  test("is not confirmed when refused", async () => {
    FakeSocket.newest.says(snapshot(live()));
    const stopped = channel.stop("stop");
    FakeSocket.newest.says({ type: "reply", id: 1, ok: false, problem: null });
    expect(await stopped).toBe(false);
  });

  test("is given up at once without a connection", async () => {
    expect(await channel.stop("stop")).toBe(false);
    expect(FakeSocket.newest.sent).toEqual([]);
  });
});
