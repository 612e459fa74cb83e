import { beforeEach, describe, expect, test } from "vitest";
import type { Guidance } from "@/api/wire";
import { LiveStore, merge } from "@/live/store";
import { at, delta, job, live, robot, snapshot, station } from "./states";

let store: LiveStore;

beforeEach(() => {
  store = new LiveStore();
});

describe("merging", () => {
  test("replaces what changed and keeps the rest", () => {
    const before = live({ job: job() });
    const after = merge(before, { robot: robot({ mode: "moving" }) });
    expect(after.robot.mode).toBe("moving");
    expect(after.job).toBe(before.job);
    expect(after.station).toBe(before.station);
  });

  test("takes a null section as gone where there may be none", () => {
    const guidance = {} as Guidance;
    const before = { ...live({ job: job() }), guidance };
    const after = merge(before, { robot: null, job: null, guidance: null });
    expect(after.job).toBeNull();
    expect(after.guidance).toBeNull();
    expect(after.robot).toBe(before.robot);
  });
});

describe("the store", () => {
  test("takes a delta only after a snapshot", () => {
    store.delta(delta({ robot: robot() }, 1), 0);
    expect(store.live.value).toBeNull();
  });

  test("drops a delta that is not newer", () => {
    store.snapshot(snapshot(live(), 5), 0);
    store.delta(delta({ robot: robot({ mode: "moving" }) }, 5), 10);
    expect(store.live.value?.robot.mode).toBe("ready");
    store.delta(delta({ robot: robot({ mode: "moving" }) }, 6), 20);
    expect(store.live.value?.robot.mode).toBe("moving");
  });

  test("starts counting again with a new snapshot", () => {
    store.snapshot(snapshot(live(), 900), 0);
    store.lost();
    store.snapshot(snapshot(live(), 1), 100);
    store.delta(delta({ station: station({ power_w: 7 }) }, 2), 110);
    expect(store.live.value?.station.power_w).toBe(7);
  });

  test("calls its values stale after the server's own limit, and fresh again with the next", () => {
    store.snapshot({ ...snapshot(live()), stale_after_s: 2 }, 0);
    store.tick(2000);
    expect(store.stale.value).toBe(false);
    store.tick(2001);
    expect(store.stale.value).toBe(true);
    store.delta(delta({ station: station() }, 2), 2100);
    expect(store.stale.value).toBe(false);
  });

  test("keeps the last values when the connection is lost, as stale", () => {
    store.snapshot(snapshot(live()), 0);
    store.lost();
    expect(store.stale.value).toBe(true);
    expect(store.live.value).not.toBeNull();
    expect(store.link.value).toBe("lost");
  });

  test("tells a silent robot from a silent server", () => {
    store.snapshot(snapshot(live({ robot: robot({ updated_at: at(0) }) })), 0);
    store.delta(delta({ station: station({ power_w: 1 }) }, 2), 1500);
    expect([store.stale.value, store.robotStale.value]).toEqual([false, true]);
    store.delta(delta({ robot: robot({ updated_at: at(1) }) }, 3), 1600);
    expect(store.robotStale.value).toBe(false);
  });

  test("does not call an absent robot's values stale: there are none", () => {
    store.snapshot(snapshot(live({ robot: robot({ mode: "offline", measured: null }) })), 0);
    store.tick(60_000);
    expect(store.robotStale.value).toBe(false);
  });

  test("calls the robot unreachable only after two seconds", () => {
    store.tick(0);
    store.tick(2000);
    expect(store.unreachable.value).toBe(false);
    store.tick(2001);
    expect(store.unreachable.value).toBe(true);
    store.snapshot(snapshot(live()), 2100);
    expect(store.unreachable.value).toBe(false);
  });

  test("refuses a protocol that it does not know", () => {
    store.snapshot({ ...snapshot(live()), version: 2 as 1 }, 0);
    expect(store.outdated.value).toBe(true);
    expect(store.live.value).toBeNull();
  });
});
