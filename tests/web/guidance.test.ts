import { cleanup, fireEvent, render, screen, waitFor, within } from "@testing-library/preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { h } from "preact";
import openapi from "../../web/openapi.json";
import { App } from "@/app";
import { Announcer } from "@/guidance/announcer";
import { bigStep, frameFor, iconOf, placed, toneOf, uncertainty, wayOf } from "@/guidance/view";
import type { Icon } from "@/guidance/view";
import { channel } from "@/live/page";
import { trouble } from "@/robot/actions";
import type { Guidance, GuidanceStep, GuidedCar } from "@/api/wire";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { START, delta, live, snapshot } from "./states";

const STATES = openapi.components.schemas.Guidance.properties.state.enum as Guidance["state"][];

const step = (
  direction: GuidanceStep["direction"],
  shown_cm: number,
  distance_mm = shown_cm * 10,
): GuidanceStep => ({ direction, shown_cm, distance_mm });

function car(changes: Partial<GuidedCar> = {}): GuidedCar {
  return {
    vehicle_id: "zoe",
    x_mm: 650,
    y_mm: 310,
    z_mm: 540,
    sigma_x_mm: 1,
    sigma_z_mm: 2,
    correlation_xz: 0,
    velocity_x_mm_s: 0,
    velocity_z_mm_s: -140,
    still: false,
    skew_deg: 1.2,
    skew_sigma_deg: 0.4,
    turned_deg: 1,
    distance_mm: 590,
    margin_mm: -280,
    seen_at: START,
    ...changes,
  };
}

function guidance(changes: Partial<Guidance> = {}): Guidance {
  return {
    state: "move",
    since: START,
    arriving: true,
    reason: "rolls",
    headline: "30 cm forward",
    detail: "Straight on.",
    remedy: "",
    steps: [step("forward", 30)],
    car: car(),
    zones: {
      good: [
        [560, 224],
        [560, 253],
        [740, 253],
        [740, 224],
      ],
      reachable: [
        [480, 219],
        [470, 258],
        [830, 258],
        [820, 219],
      ],
      stop_z_mm: 239,
    },
    driver_faces: "robot",
    max_skew_deg: 3,
    ...changes,
  };
}

const waiting = guidance({
  state: "searching",
  arriving: false,
  headline: "Waiting for a car",
  detail: "The label is not in view.",
  steps: [],
  car: null,
});

describe("every state", () => {
  test("has a tone and a sign of its own where people must act differently", () => {
    const signs = new Map<Icon, Guidance["state"][]>();
    for (const state of STATES) {
      const shown = guidance({ state, steps: state === "move" ? [step("left", 5)] : [] });
      expect(toneOf(shown)).toMatch(/calm|busy|good|ask|problem/);
      signs.set(iconOf(shown), [...(signs.get(iconOf(shown)) ?? []), state]);
    }
    const together = [...signs.values()].filter((states) => states.length > 1);
    expect(together).toEqual([
      ["paused", "searching"],
      ["unreadable", "lost"],
    ]);
  });

  test("forbids to drive in where the robot is in the way", () => {
    const paused = guidance({ state: "paused", reason: "robot_not_parked", steps: [] });
    expect([iconOf(paused), toneOf(paused)]).toEqual(["closed", "ask"]);
    const blind = guidance({ state: "paused", reason: "camera_down", steps: [] });
    expect([iconOf(blind), toneOf(blind)]).toEqual(["look", "calm"]);
  });

  test("gives a number only to what can be driven", () => {
    expect(bigStep(guidance())?.shown_cm).toBe(30);
    expect(bigStep(guidance({ state: "thin" }))).toBeNull();
    expect(bigStep(guidance({ steps: [step("down", 20)] }))).toBeNull();
    expect(bigStep(guidance({ steps: [] }))).toBeNull();
  });
});

describe("the picture", () => {
  test("shows wall, zones and car at every distance", () => {
    for (const z_mm of [215, 300, 540, 900, 1300]) {
      const shown = guidance({ car: car({ z_mm, x_mm: 700 }) });
      const frame = frameFor(shown, null);
      for (const [x, z] of [...shown.zones.reachable.map(([x = 0, z = 0]) => [x, z]), [700, z_mm]]) {
        const [u, v] = placed(frame, x ?? 0, z ?? 0);
        expect(u).toBeGreaterThan(0);
        expect(u).toBeLessThan(350);
        expect(v).toBeGreaterThan(0);
        expect(v).toBeLessThan(290);
      }
    }
  });

  test("does not pump: it zooms out at once and in only with room to spare", () => {
    const at = (z_mm: number): Guidance => guidance({ car: car({ z_mm }) });
    const wide = frameFor(at(840), null);
    expect(frameFor(at(500), null).span_mm).toBeLessThan(wide.span_mm);
    expect(frameFor(at(780), null).span_mm).toBeLessThan(wide.span_mm);
    expect(frameFor(at(780), wide)).toEqual(wide);
    const near = frameFor(at(300), wide);
    expect(near.span_mm).toBeLessThan(wide.span_mm);
    expect(frameFor(at(840), near).span_mm).toBe(wide.span_mm);
  });

  test("is turned round for those who back in", () => {
    const frame = frameFor(guidance({ driver_faces: "away" }), null);
    const robot = placed(frame, 650, 0)[1];
    const socket = placed(frame, 650, 500)[1];
    expect(robot).toBeGreaterThan(socket);
    expect(placed(frame, 800, 300)[0]).toBeLessThan(placed(frame, 600, 300)[0]);
  });

  test("draws the doubt as the covariance has it", () => {
    const frame = frameFor(guidance(), null);
    const px = 290 / frame.span_mm;
    const round = uncertainty(car({ sigma_x_mm: 3, sigma_z_mm: 3 }), frame);
    expect(round.long).toBeCloseTo(6 * px);
    expect(round.short).toBeCloseTo(6 * px);
    const sloping = uncertainty(
      car({ sigma_x_mm: 3, sigma_z_mm: 3, correlation_xz: 0.9 }),
      frame,
    );
    expect(sloping.turn_deg).toBeCloseTo(45);
    expect(sloping.long / sloping.short).toBeCloseTo(Math.sqrt(1.9 / 0.1));
    expect(uncertainty(car({ sigma_z_mm: 9 }), frame).turn_deg).toBeCloseTo(90);
  });

  test("points the way that the words say, whoever drives how", () => {
    const steps = [step("forward", 30), step("left", 4)];
    expect(wayOf(guidance({ steps }))).toEqual([-40, -300]);
    const backing = [step("back", 30), step("right", 4)];
    expect(wayOf(guidance({ steps: backing, driver_faces: "away" }))).toEqual([-40, -300]);
  });
});

describe("the screen reader", () => {
  test("hears every state, and numbers only now and then", () => {
    const announcer = new Announcer();
    expect(announcer.next(guidance(), guidance(), 0)).toBe("30 cm forward. Straight on.");
    const nearer = guidance({ headline: "25 cm forward", steps: [step("forward", 25)] });
    expect(announcer.next(nearer, nearer, 100)).toContain("30 cm");
    expect(announcer.next(nearer, nearer, 5000)).toContain("30 cm");
    const near = guidance({ headline: "15 cm forward", steps: [step("forward", 15)] });
    expect(announcer.next(near, near, 5100)).toContain("15 cm");
    const stop = guidance({ state: "stop", headline: "Stop", detail: "You are there.", steps: [] });
    expect(announcer.next(stop, stop, 5150)).toBe("Stop. You are there.");
  });
});

describe("the home page", () => {
  let rest: FakeRest;

  beforeEach(() => {
    vi.stubGlobal("WebSocket", FakeSocket);
    rest = new FakeRest();
    trouble.value = null;
    channel.start();
    render(h(App, null));
  });

  afterEach(() => {
    channel.close();
    cleanup();
  });

  const card = (): HTMLElement => screen.getByRole("region", { name: "Parking guidance" });

  test("has nothing to show before the server has spoken of it", () => {
    FakeSocket.newest.says(snapshot(live()));
    expect(screen.queryByRole("region", { name: "Parking guidance" })).toBeNull();
  });

  test("is one quiet line until a car arrives, then shows itself", async () => {
    FakeSocket.newest.says(snapshot(live({ guidance: waiting })));
    await screen.findByRole("button", { name: /Parking guidance/ });
    expect(card().querySelector(".order")).toBeNull();

    FakeSocket.newest.says(delta({ guidance: guidance() }, 2));
    await waitFor(() => expect(card().querySelector(".order strong")?.textContent).toBe("30"));
    expect(within(card()).getByText("forward")).toBeTruthy();
    expect(within(card()).getByRole("img").querySelector(".way")).not.toBeNull();

    const good = guidance({
      state: "good",
      headline: "Stop here",
      detail: "The car stands well.",
      steps: [],
      car: car({ z_mm: 239, still: true }),
    });
    FakeSocket.newest.says(delta({ guidance: good }, 3));
    await waitFor(() => expect(card().querySelector(".order-word")?.textContent).toBe("Stop here"));
    expect(card().querySelector("[data-tone=good] .sign")?.getAttribute("data-icon")).toBe("good");
    expect(card().querySelector("[aria-live=polite]")?.textContent).toContain("Stop here");

    FakeSocket.newest.says(delta({ guidance: { ...good, arriving: false } }, 4));
    await waitFor(() => expect(card().querySelector(".order")).toBeNull());
  });

  test("can be hidden for one arrival and opened at any time", async () => {
    FakeSocket.newest.says(snapshot(live({ guidance: guidance() })));
    fireEvent.click(await screen.findByRole("button", { name: "Hide" }));
    await waitFor(() => expect(card().querySelector(".order")).toBeNull());
    FakeSocket.newest.says(delta({ guidance: guidance({ headline: "25 cm forward" }) }, 2));
    await waitFor(() => expect(card().querySelector(".order")).toBeNull());
    FakeSocket.newest.says(delta({ guidance: waiting }, 3));
    await waitFor(() => expect(card().dataset["arriving"]).toBe("false"));
    FakeSocket.newest.says(delta({ guidance: guidance() }, 4));
    await waitFor(() => expect(card().querySelector(".order")).not.toBeNull());
    FakeSocket.newest.says(delta({ guidance: waiting }, 5));
    fireEvent.click(await screen.findByRole("button", { name: /Parking guidance/ }));
    expect((await within(card()).findAllByText(/Waiting for a car/)).length).toBeGreaterThan(0);
  });

  test("lets the simulated car be driven, and says why it refuses", async () => {
    const refusal = { code: "car_refuses", title: "No", detail: "It would hit.", remedy: "Less." };
    rest.answer("POST /simulation/car", [200, {}], [409, refusal]);
    FakeSocket.newest.says(snapshot(live({ guidance: guidance() })));
    fireEvent.click(await screen.findByRole("button", { name: "Brake" }));
    await waitFor(() => expect(rest.requests.at(-1)?.body).toEqual({ type: "brake" }));
    fireEvent.click(screen.getByRole("button", { name: "5 cm on" }));
    expect(await screen.findByText(/It would hit\./)).toBeTruthy();
  });

  test("shows no pedals before a real camera", async () => {
    const state = live({ guidance: guidance() });
    const service = { ...state.service, simulated_parts: ["robot" as const] };
    FakeSocket.newest.says(snapshot({ ...state, service }));
    await screen.findByRole("button", { name: "Hide" });
    expect(screen.queryByRole("button", { name: "Brake" })).toBeNull();
  });
});
