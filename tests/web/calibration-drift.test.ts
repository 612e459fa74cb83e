import { cleanup, fireEvent, render, screen } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { session } from "@/access/session";
import { close } from "@/calibration/desk";
import { CalibrationPanel } from "@/calibration/opening";
import { CalibrationBody } from "@/calibration/panel";
import { channel } from "@/live/page";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { live, snapshot } from "./states";

describe("what jobs have shown", () => {
  const drift = {
    jobs: 100, left_percent: 0.18, left_sigma_percent: 0.025, right_percent: 0.01, right_sigma_percent: 0.025,
    moved_mm: 0.22, proven_mm: 0.12, exceeds: true, at_bound: false, refused_in_a_row: 0,
  };

  beforeEach(() => {
    vi.stubGlobal("WebSocket", FakeSocket);
    FakeSocket.made.length = 0;
    localStorage.clear();
    sessionStorage.clear();
    session.value = null;
    new FakeRest()
      .answer("GET /calibrations?limit=20", [200, { items: [], next_cursor: null }])
      .answer("GET /calibrations/checks?limit=20", [200, { items: [], next_cursor: null }])
      .answer("GET /vehicles", [200, { items: [{ id: "zoe", name: "Renault Zoe" }] }]);
    channel.start();
  });

  afterEach(async () => {
    cleanup();
    close();
    channel.close();
    await new Promise((resolve) => setTimeout(resolve, 0));
  });

  const shows = (more: object): void =>
    FakeSocket.newest.says(snapshot(live({ calibration: { in_force: { sockets: [] }, hints: [], ...more } }), 500));

  test("leads to measuring the robot anew when the belts have moved too far, said once", async () => {
    render(h(CalibrationBody, null));
    const hint = { code: "belts_drifted", title: "The robot has drifted", text: "Look.", vehicle_id: null };
    shows({ drift, hints: [hint] });
    await screen.findByText(/moved by up to 0.22 mm .* within 0.12 mm is proven/);
    await screen.findByText(/tension of the left belt/);
    expect(screen.queryByText("The robot has drifted.")).toBeNull();
    fireEvent.click(screen.getByRole("button", { name: "Measure the robot" }));
    await screen.findByText("Before you begin");
  });

  test("is quiet while all is well, and not there before the first job", async () => {
    render(h(CalibrationBody, null));
    shows({ drift: { ...drift, jobs: 0 } });
    await screen.findByText("In use");
    expect(screen.queryByText("What jobs have shown")).toBeNull();
    cleanup();
    render(h(CalibrationBody, null));
    shows({ drift: { ...drift, exceeds: false, moved_mm: 0.05 } });
    await screen.findByText("What jobs have shown");
    expect(screen.queryByRole("button", { name: "Measure the robot" })).toBeNull();
  });

  test("names what wears, and the panel says so while it is closed", async () => {
    render(h(CalibrationPanel, null));
    shows({ hints: [{ code: "plug_heavy", title: "The plug goes in harder", text: "Clean it.", vehicle_id: "zoe" }] });
    await screen.findByText("Something wants care");
    cleanup();
    render(h(CalibrationBody, null));
    await screen.findByText(/The plug goes in harder/);
    await screen.findByText(/Clean it\./);
  });
});
