import { describe, expect, test } from "vitest";
import { Lateness } from "@/live/lateness";
import { LiveStore } from "@/live/store";
import { delta, live, robot, snapshot, at } from "./states";

describe("lateness", () => {
  test("is what the way takes longer than the quickest one", () => {
    const found = new Lateness();
    expect(found.lateMs(1000, 50_020)).toBe(0);
    expect(found.lateMs(1100, 50_100)).toBe(0); // quicker still
    expect(found.lateMs(1200, 53_200)).toBeCloseTo(3000, -1);
    expect(found.lateMs(4200, 53_210)).toBeCloseTo(10, -1);
  });

  test("forgives clocks that drift apart, and sees a delay all the same", () => {
    const found = new Lateness();
    const drift = 1.0001; // 100 ppm: worse than any quartz
    let worst = 0;
    for (let s = 0; s < 24 * 3600; s += 1) {
      worst = Math.max(worst, found.lateMs(s * 1000, s * 1000 * drift));
    }
    expect(worst).toBeLessThan(1);
    expect(found.lateMs(24 * 3600_000, 24 * 3600_000 * drift + 1500)).toBeGreaterThan(1400);
  });
});

describe("the store", () => {
  const stamped = (sequence: number, sent_s: number): ReturnType<typeof delta> => ({
    ...delta({ robot: robot({ updated_at: at(sequence) }) }, sequence),
    sent_s,
  });

  test("calls what comes too late stale, although messages come", () => {
    const store = new LiveStore();
    store.snapshot({ ...snapshot(live()), sent_s: 100 }, 5000);
    store.delta(stamped(2, 100.05), 5050);
    expect(store.stale.value).toBe(false);
    for (let beat = 0; beat < 20; beat += 1) {
      store.delta(stamped(3 + beat, 100.1 + beat / 20), 7100 + beat * 50);
      expect(store.stale.value).toBe(true);
    }
    store.delta(stamped(40, 103), 8010);
    expect(store.stale.value).toBe(false);
  });

  test("begins anew with a server that was started anew", () => {
    const store = new LiveStore();
    store.snapshot({ ...snapshot(live()), sent_s: 1000 }, 5000);
    const service = { ...live().service, started_at: at(60) };
    store.snapshot({ ...snapshot(live({ service })), sent_s: 1 }, 9000);
    expect(store.stale.value).toBe(false);
  });

  test("takes a server that says nothing of it", () => {
    const store = new LiveStore();
    store.snapshot(snapshot(live()), 5000);
    store.delta(delta({ robot: robot({ updated_at: at(1) }) }, 2), 5050);
    expect(store.stale.value).toBe(false);
  });
});
