import { cleanup, fireEvent, render, screen, waitFor } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import openapi from "../../web/openapi.json";
import { session } from "@/access/session";
import { close, putAway, routine, versions } from "@/calibration/desk";
import { leftOver, platformAt } from "@/calibration/mechanism";
import { CalibrationPanel } from "@/calibration/opening";
import { secondsLeft } from "@/calibration/pace";
import { CalibrationBody } from "@/calibration/panel";
import { enlargement, planeAround } from "@/calibration/plots/plane";
import { numberIn, requestOf } from "@/calibration/request";
import { ROUTINES } from "@/calibration/routines";
import type { CalibrationDetail, Routine } from "@/calibration/types";
import { channel } from "@/live/page";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { at, live, robot, snapshot } from "./states";

const DETAIL = openapi.paths["/api/v1/calibrations/{calibration_id}"].get.responses["200"].content["application/json"]
  .example as unknown as CalibrationDetail;
const CHECKS = openapi.paths["/api/v1/calibrations/checks"].get.responses["200"].content["application/json"].example;
const { evidence: _, ...VERSION } = DETAIL;
const FRESH = { ...DETAIL, in_force: false };
const BEGIN = "POST /calibrations/routine";

let rest: FakeRest;
/** Each test has a routine of its own: one that was read is not shown again. */
let begun = 0;

beforeEach(() => {
  begun += 1;
  vi.stubGlobal("WebSocket", FakeSocket);
  FakeSocket.made.length = 0;
  localStorage.clear();
  sessionStorage.clear();
  session.value = null;
  versions.value = null;
  rest = new FakeRest()
    .answer("GET /calibrations?limit=20", [200, { items: [VERSION], next_cursor: null }])
    .answer("GET /calibrations/checks?limit=20", [200, CHECKS])
    .answer("GET /vehicles", [200, { items: [{ id: "zoe", name: "Renault Zoe" }] }])
    .answer(`GET /calibrations/${DETAIL.id}`, [200, FRESH])
    .answer(BEGIN, [202, {}])
    .answer(`POST /calibrations/${DETAIL.id}/activation`, [200, {}])
    .answer("POST /calibrations/roll-back", [200, {}])
    .answer("POST /calibrations/routine/cancel", [200, {}])
    .answer("POST /calibrations/routine/resume", [200, {}]);
  channel.start();
});

afterEach(async () => {
  cleanup();
  putAway();
  close();
  channel.close();
  await new Promise((resolve) => setTimeout(resolve, 0));
});

const running = (changes: Partial<Routine> = {}): Routine => ({
  kind: "robot",
  state: "running",
  doing: "Looking at the label from many places.",
  done: 7,
  total: 25,
  looks: [
    { x_mm: 640, y_mm: 330, seen: true },
    { x_mm: 700, y_mm: 360, seen: false },
  ],
  begun_by: "Anna",
  begun_at: at(begun),
  calibration_id: null,
  check_id: null,
  problem: null,
  ...changes,
});

let shown = 0;
const show = (now: Routine | null, more: object = {}): void => {
  shown += 1;
  FakeSocket.newest.says(snapshot(live({ calibration: { routine: now, in_force: { sockets: [] }, ...more } }), shown));
};
const button = (name: string): HTMLButtonElement => screen.getByRole("button", { name });
const press = async (name: string): Promise<void> => {
  await waitFor(() => expect(button(name).disabled).toBe(false));
  fireEvent.click(button(name));
};
const sent = (what: string): unknown => rest.requests.filter((each) => each.what === what).at(-1)?.body;

describe("a routine", () => {
  test("begins with what was measured, and without what was not", async () => {
    render(h(CalibrationBody, null));
    show(null);
    fireEvent.click(await screen.findByRole("button", { name: /Measure the robot/ }));
    fireEvent.input(screen.getAllByLabelText(/really went/)[0]!, { target: { value: "300,7" } });
    await press("Begin to measure");
    await waitFor(() => expect(rest.commands).toEqual([BEGIN]));
    expect(sent(BEGIN)).toEqual({
      kind: "robot",
      vehicle_id: "zoe",
      left_belt: { commanded_mm: 300, measured_mm: 300.7 },
      label_sigma_mm: 0.15,
    });
  });

  test("does not begin with nonsense, or with the plug in a car", async () => {
    render(h(CalibrationBody, null));
    show(null);
    fireEvent.click(await screen.findByRole("button", { name: /Check at nine places/ }));
    fireEvent.input(screen.getByLabelText(/Approaches/), { target: { value: "2" } });
    await screen.findByText("Give 3 to 30.");
    expect(button("Begin the check").disabled).toBe(true);
    fireEvent.input(screen.getByLabelText(/Approaches/), { target: { value: "3" } });
    FakeSocket.newest.says(snapshot(live({ robot: robot({ plug: "inserted" }) }), 900));
    await screen.findByText("The plug is in a car: unplug first.");
    expect(button("Begin the check").disabled).toBe(true);
    expect(rest.commands).toEqual([]);
  });

  test("under way shows how far it is, whatever was open, and can be ended", async () => {
    render(h(CalibrationBody, null));
    show(running());
    await screen.findByText("Place 7 of 25");
    await screen.findByText("Looking at the label from many places.");
    expect(document.querySelectorAll(".look.missed").length).toBe(1);
    await press("End it");
    await waitFor(() => expect(rest.commands).toEqual(["POST /calibrations/routine/cancel"]));
  });

  test("opens the panel by itself after a reload", async () => {
    render(h(CalibrationPanel, null));
    show(running());
    await screen.findByText("Place 7 of 25");
  });

  test("that was interrupted says why and goes on", async () => {
    render(h(CalibrationBody, null));
    const problem = {
      type: "urn:x",
      status: 409,
      code: "calibration_label_lost",
      title: "The label was seen too seldom",
      detail: "The label was seen from 9 places.",
      remedy: "Look for glare.",
    };
    show(running({ state: "interrupted", problem }));
    await screen.findByText(/seen from 9 places. Look for glare./);
    await press("Go on");
    await waitFor(() => expect(rest.commands).toEqual(["POST /calibrations/routine/resume"]));
  });

  test("that failed says that nothing was kept, once", async () => {
    render(h(CalibrationBody, null));
    show(running({ state: "failed" }));
    await screen.findByText(/Nothing was kept/);
    await press("Close");
    await screen.findByText("In use");
    expect(routine.value?.state).toBe("failed");
  });
});

describe("what came of it", () => {
  const finished = (): Routine => running({ state: "finished", calibration_id: DETAIL.id, done: 25 });

  test("is used with one press when it is better", async () => {
    render(h(CalibrationBody, null));
    show(finished());
    await screen.findByText("The robot has been measured");
    expect(screen.getByText("2.41 mm")).toBeTruthy();
    expect(screen.getByText("0.034 mm")).toBeTruthy();
    expect(document.querySelectorAll(".arrow").length).toBe(DETAIL.evidence!.looks.length);
    await press("Use it");
    await waitFor(() => expect(sent(`POST /calibrations/${DETAIL.id}/activation`)).toEqual({ accept_worse: false }));
    await screen.findByText("Robot, version 3");
  });

  test("that is worse says by how much before it can be used", async () => {
    rest.answer(`GET /calibrations/${DETAIL.id}`, [200, { ...FRESH, error: 0.12, error_in_use: 0.05 }]);
    render(h(CalibrationBody, null));
    show(finished());
    await screen.findByText(/misses by 0.120 mm, the one in use by 0.050 mm. That is 0.070 mm more/);
    expect(screen.queryByRole("button", { name: "Use it" })).toBeNull();
    await press("Use it all the same");
    await waitFor(() => expect(sent(`POST /calibrations/${DETAIL.id}/activation`)).toEqual({ accept_worse: true }));
  });

  test("that the server finds worse meanwhile says the server's numbers", async () => {
    rest.answer(`POST /calibrations/${DETAIL.id}/activation`, [
      409,
      { code: "calibration_worse", title: "Worse", detail: "It misses.", remedy: "", context: { error_mm: 0.034, in_force_mm: 0.01 } },
    ]);
    render(h(CalibrationBody, null));
    show(finished());
    await screen.findByText("The robot has been measured");
    await press("Use it");
    await screen.findByText(/the one in use by 0.010 mm/);
    expect(button("Use it all the same").disabled).toBe(false);
  });

  test("is discarded with one press and comes no more", async () => {
    render(h(CalibrationBody, null));
    show(finished());
    await screen.findByText("The robot has been measured");
    await press("Discard");
    await screen.findByText("In use");
    cleanup();
    render(h(CalibrationBody, null));
    await screen.findByText("In use");
    expect(rest.commands).toEqual([]);
  });

  test("is taken back with one press", async () => {
    render(h(CalibrationBody, null));
    show(null, { in_force: { robot: VERSION, camera: null, sockets: [] } });
    await press("Roll back: Robot");
    await waitFor(() => expect(sent("POST /calibrations/roll-back")).toEqual({ kind: "robot", vehicle_id: null }));
  });

  test("cannot be used by somebody who may only look", async () => {
    session.value = {
      paired: true,
      person: { id: "1", name: "Anna", role: "viewer", ends_at: null },
      device_id: "2",
      rights: ["anyone", "person", "read", "stop"],
      passkeys: false,
      screen: false,
    };
    render(h(CalibrationBody, null));
    show(finished());
    await screen.findByText("The robot has been measured");
    expect(button("Use it").disabled).toBe(true);
  });
});

test("a taught socket is named by its car and taken back for that car", async () => {
  const socket = {
    ...FRESH,
    kind: "socket",
    error: 0.02,
    error_in_use: 1.4,
    evidence: null,
    in_force: true,
    values: { kind: "socket", vehicle_id: "zoe", socket: { x_mm: 120, y_mm: -4.5, z_mm: 0 } },
  };
  rest.answer("GET /calibrations?limit=20", [200, { items: [socket], next_cursor: null }]);
  rest.answer(`GET /calibrations/${DETAIL.id}`, [200, socket]);
  render(h(CalibrationBody, null));
  show(null);
  fireEvent.click(await screen.findByRole("button", { name: /Socket of Renault Zoe version 3/ }));
  await screen.findByText("1.40 mm");
  await press("Roll back");
  await waitFor(() => expect(sent("POST /calibrations/roll-back")).toEqual({ kind: "socket", vehicle_id: "zoe" }));
});

test("a check shows its figures and where the robot came to", async () => {
  render(h(CalibrationBody, null));
  show(null);
  fireEvent.click(await screen.findByRole("button", { name: /AP 0.03 mm · RP 0.09 mm/ }));
  await screen.findByText("0.094 mm");
  expect(document.querySelectorAll(".plot circle.below").length).toBe(1);
  expect(document.querySelectorAll(".plot circle.above").length).toBe(1);
});

describe("the mechanism", () => {
  const { values } = VERSION;
  if (values.kind !== "robot") throw new Error("the example is no robot");

  test("stands where the server has it", () => {
    // Both from twin.as_built.PlanarAsBuilt.forward and cv2.Rodrigues with the same numbers.
    const place = platformAt(
      {
        left_leg_mm: 533.21, right_leg_mm: 530.87, left_foot_x_mm: 55, left_foot_y_mm: 0,
        right_foot_x_mm: 1246.42, right_foot_y_mm: -1.13, left_rail_rad: 0.0021, right_rail_rad: -0.0021,
        left_scale: 1.0024, right_scale: 0.9981,
      },
      { rho1_mm: 212.4, rho2_mm: 180.9 },
    );
    expect(place?.x_mm).toBeCloseTo(668.9753, 3);
    expect(place?.y_mm).toBeCloseTo(351.8144, 3);
    const left = leftOver({ residual_mm: [0.011, -0.004, 0.052] }, [0.013, -0.021, 3.127]);
    expect(left.x_mm).toBeCloseTo(-0.010513, 6);
    expect(left.y_mm).toBeCloseTo(0.003457, 6);
  });

  test("whose legs do not reach each other stands nowhere", () => {
    expect(platformAt({ ...values.mechanism, left_leg_mm: 10 }, { rho1_mm: 0, rho2_mm: 0 })).toBeNull();
  });
});

describe("drawings", () => {
  test("keep all places inside, up above down", () => {
    const places = [{ x_mm: 500, y_mm: 100 }, { x_mm: 900, y_mm: 100 }, { x_mm: 700, y_mm: 400 }];
    const plane = planeAround(places);
    for (const place of places) {
      const [x, y] = plane.at(place);
      expect(x).toBeGreaterThan(0);
      expect(x).toBeLessThan(plane.width);
      expect(y).toBeGreaterThan(0);
      expect(y).toBeLessThan(plane.height);
    }
    expect(plane.at(places[2]!)[1]).toBeLessThan(plane.at(places[0]!)[1]);
  });

  test("enlarge by 1, 2 or 5 and never beyond their room", () => {
    for (const longest of [0.0007, 0.013, 0.4, 3]) {
      const times = enlargement(longest, 20);
      expect(longest * times).toBeLessThanOrEqual(20);
      expect(longest * times).toBeGreaterThan(7.9);
      expect([1, 2, 5]).toContain(Number(times.toExponential()[0]));
    }
    expect(enlargement(0, 20)).toBe(1);
    expect(enlargement(50, 20)).toBe(1);
  });
});

test("the time left follows the pace that was seen", () => {
  const first = { done: 3, at_ms: 1000 };
  expect(secondsLeft(10, first, first, 6)).toBe(60);
  expect(secondsLeft(10, first, { done: 7, at_ms: 9000 }, 6)).toBe(20);
});

test("numbers are read with the comma of the reader's country", () => {
  expect(numberIn(" 300,7 ")).toBe(300.7);
  expect(numberIn("300.7")).toBe(300.7);
  for (const text of ["", " ", "1,2,3", "abc"]) expect(numberIn(text)).toBeNull();
});

test("a whole number has no fraction, and an empty optional one is left out", () => {
  expect(requestOf("check", ROUTINES.check, { approaches: "3.5" }, null).wrong).toEqual({ approaches: "noNumber" });
  expect(requestOf("check", ROUTINES.check, { approaches: "" }, null)).toEqual({ body: { kind: "check" }, wrong: {} });
});
