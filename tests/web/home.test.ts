import { cleanup, fireEvent, render, screen, waitFor, within } from "@testing-library/preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { h } from "preact";
import { App } from "@/app";
import { channel } from "@/live/page";
import { choice, pending, question, trouble } from "@/robot/actions";
import { dismissedJobId } from "@/robot/view";
import type { Live } from "@/api/wire";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { job, live, robot, snapshot, START, station } from "./states";

const ZOE = { id: "zoe", name: "Renault Zoe" };
const ID3 = { id: "id3", name: "ID.3" };
const MOVING = live({ robot: robot({ mode: "moving" }), job: job({ phase: "aligning" }) });

let rest: FakeRest;

beforeEach(() => {
  vi.stubGlobal("WebSocket", FakeSocket);
  rest = new FakeRest();
  rest.answer("GET /vehicles", [200, { items: [ZOE] }]).answer("POST /jobs", [202, job()]);
  choice.value = question.value = trouble.value = dismissedJobId.value = null;
  channel.start();
  render(h(App, null));
});

afterEach(async () => {
  await waitFor(() => expect(pending.value).toBe(false));
  channel.close();
  cleanup();
});

/** The robot is so now. */
function show(state: Live): void {
  FakeSocket.newest.says(snapshot(state));
}

const button = (name: string): HTMLButtonElement => screen.getByRole("button", { name });
const press = async (name: string): Promise<void> => {
  await screen.findByRole("button", { name });
  fireEvent.click(button(name));
};
const headline = (): string => screen.getByRole("heading", { level: 1 }).textContent;

describe("planning", () => {
  test("asks for three things and sends dates by the robot's clock", async () => {
    show(live());
    await press("Plan a charge");
    const dialog = await screen.findByRole("dialog", { name: "Plan a charge" });
    const box = within(dialog);
    fireEvent.click(box.getByLabelText("Only"));
    fireEvent.input(await box.findByLabelText("Energy, kWh"), { target: { value: "15" } });
    fireEvent.click(box.getByRole("button", { name: "Plan it" }));
    await waitFor(() => expect(rest.commands).toEqual(["POST /jobs"]));
    const ready = new Date(START);
    ready.setHours(7, 0, 0, 0);
    if (ready <= new Date(START)) ready.setDate(ready.getDate() + 1);
    expect(rest.requests.at(-1)?.body).toEqual({
      type: "charge",
      vehicle_id: "zoe",
      not_before: null,
      unplug_by: ready.toISOString(),
      target_energy_wh: 15_000,
    });
  });
});

describe("a job that waits", () => {
  test("goes on or is given up with one press", async () => {
    rest.answer("POST /jobs/job-1/resume", [202, job()]).answer("POST /jobs/job-1/pause", [202, job()]);
    show(live({ job: job({ phase: "charging" }) }));
    await press("Pause");
    await waitFor(() => expect(rest.commands).toEqual(["POST /jobs/job-1/pause"]));
    show(live({ job: job({ phase: "charging", paused: true }) }));
    await press("Go on");
    await waitFor(() => expect(rest.commands.at(-1)).toBe("POST /jobs/job-1/resume"));
  });
});

describe("charging", () => {
  test("takes one press with one car", async () => {
    show(live());
    await press("Charge");
    await waitFor(() => expect(rest.commands).toEqual(["POST /jobs"]));
    expect(rest.requests.at(-1)?.body).toEqual({ type: "charge", vehicle_id: "zoe" });
  });

  test("takes two presses with several cars, the last one's first", async () => {
    rest.answer("GET /vehicles", [200, { items: [ID3, ZOE] }]);
    show(live({ job: job({ state: "succeeded", phase: "parking" }) }));
    await press("Charge");
    const dialog = await screen.findByRole("dialog", { name: "Which car?" });
    const names = within(dialog).getAllByRole("button").map((each) => each.textContent);
    expect(names).toEqual(["Renault Zoe", "ID.3", "Not yet"]);
    await press("ID.3");
    await waitFor(() => expect(rest.commands).toEqual(["POST /jobs"]));
    expect(rest.requests.at(-1)?.body).toEqual({ type: "charge", vehicle_id: "id3" });
    expect(screen.queryByRole("dialog")).toBeNull();
  });

  test("says what to do when no car is known", async () => {
    rest.answer("GET /vehicles", [200, { items: [] }]);
    show(live());
    await press("Charge");
    expect((await screen.findByText(/No car is known yet/)).closest("[role=alert]")).not.toBeNull();
    expect(rest.commands).toEqual([]);
  });

  test("shows the server's own words when it is refused, until put away", async () => {
    const problem = { code: "x", title: "Busy", detail: "Anna is there.", remedy: "Wait." };
    rest.answer("POST /jobs", [409, problem]);
    show(live());
    await press("Charge");
    const alert = await screen.findByText(/Anna is there\./);
    expect(alert.closest("[role=alert]")?.textContent).toContain("What to do: Wait.");
    await press("Got it");
    await waitFor(() => expect(screen.queryByText(/Anna is there/)).toBeNull());
  });

  test("is ended by finish, and shows what the car got", async () => {
    rest.answer("POST /jobs/job-1/finish", [202, job()]);
    show(
      live({
        robot: robot({ plug: "inserted" }),
        job: job({ phase: "charging" }),
        station: station({ power_w: 10_980, session_energy_wh: 15_340 }),
      }),
    );
    expect(await screen.findByText("11.0 kW")).toBeTruthy();
    expect(screen.getByText("15.3 kWh")).toBeTruthy();
    await press("Stop and unplug");
    await waitFor(() => expect(rest.commands).toEqual(["POST /jobs/job-1/finish"]));
  });

  test("can be cancelled on the way", async () => {
    rest.answer("POST /jobs/job-1/cancel", [202, job()]);
    show(MOVING);
    await press("Cancel");
    await waitFor(() => expect(rest.commands).toEqual(["POST /jobs/job-1/cancel"]));
  });
});

test("a plug in the car is unplugged, for the car of the last job", async () => {
  show(live({ robot: robot({ plug: "inserted" }), job: job({ state: "failed" }) }));
  await press("Unplug");
  await waitFor(() => expect(rest.commands).toEqual(["POST /jobs"]));
  expect(rest.requests.at(-1)?.body).toEqual({ type: "unplug", vehicle_id: "zoe" });
});

describe("stop", () => {
  test("is there only while something moves", async () => {
    show(live());
    await screen.findByText("Ready to charge");
    expect(screen.queryByRole("button", { name: "Stop" })).toBeNull();
    show(MOVING);
    expect(await screen.findByRole("button", { name: "Stop" })).toBeTruthy();
  });

  test("goes out as the finger touches, without a question, and needs no REST if confirmed", async () => {
    show(MOVING);
    fireEvent.pointerDown(await screen.findByRole("button", { name: "Stop" }));
    const [sent] = FakeSocket.newest.sent;
    expect(sent).toMatchObject({ type: "stop" });
    FakeSocket.newest.says({ type: "reply", id: sent!.id!, ok: true, problem: null });
    expect(await screen.findByRole("button", { name: "Stop" })).toBeTruthy();
    expect(rest.commands).toEqual([]);
  });

  test("goes over REST when the confirmation stays out", async () => {
    rest.answer("POST /robot/stop", [200, {}]);
    show(MOVING);
    fireEvent.pointerDown(await screen.findByRole("button", { name: "Stop" }));
    await waitFor(() => expect(rest.commands).toEqual(["POST /robot/stop"]), { timeout: 2000 });
  });

  test("stays and still works when the connection is gone", async () => {
    rest.answer("POST /robot/stop", [200, {}]);
    show(MOVING);
    await screen.findByRole("button", { name: "Stop" });
    FakeSocket.newest.breaks();
    await waitFor(() => expect(button("Cancel").disabled).toBe(true));
    fireEvent.pointerDown(button("Stop"));
    await waitFor(() => expect(rest.commands).toEqual(["POST /robot/stop"]));
  });

  test("says so when nothing confirms it", async () => {
    rest.answer("POST /robot/stop", new TypeError("Failed to fetch"));
    show(MOVING);
    await screen.findByRole("button", { name: "Stop" });
    FakeSocket.newest.breaks();
    fireEvent.pointerDown(button("Stop"));
    expect(await screen.findByText(/The stop was not confirmed/)).toBeTruthy();
  });

  test("works from the keyboard, once", async () => {
    show(MOVING);
    fireEvent.click(await screen.findByRole("button", { name: "Stop" }), { detail: 0 });
    expect(FakeSocket.newest.sent.filter(({ type }) => type === "stop")).toHaveLength(1);
    fireEvent.click(screen.getByRole("button", { name: /Stop/ }), { detail: 1 });
    expect(FakeSocket.newest.sent.filter(({ type }) => type === "stop")).toHaveLength(1);
  });
});

describe("before the robot may move again", () => {
  test("a release asks first", async () => {
    rest.answer("POST /robot/reset", [200, {}]);
    show(live({ robot: robot({ mode: "stopped" }) }));
    await press("Release the stop");
    await screen.findByRole("dialog", { name: "May the robot move again?" });
    expect(rest.commands).toEqual([]);
    await press("Yes, release");
    await waitFor(() => expect(rest.commands).toEqual(["POST /robot/reset"]));
  });

  test("and nothing is sent after a no", async () => {
    show(live({ robot: robot({ mode: "emergency_stop" }) }));
    await press("Release the stop");
    await press("Not yet");
    await waitFor(() => expect(screen.queryByRole("dialog")).toBeNull());
    expect(rest.commands).toEqual([]);
  });

  test("an unknown plug is looked at", async () => {
    rest.answer("POST /robot/plug-confirmation", [200, {}]);
    show(live({ robot: robot({ plug: "unknown" }) }));
    await press("Yes, it is out");
    const dialog = await screen.findByRole("dialog", { name: "Have you looked?" });
    fireEvent.click(within(dialog).getByRole("button", { name: "Yes, it is out" }));
    await waitFor(() => expect(rest.commands).toEqual(["POST /robot/plug-confirmation"]));
    expect(rest.requests.at(-1)?.body).toEqual({ state: "free" });
  });

  test("a plug that a person sees in the car is unplugged", async () => {
    show(live({ robot: robot({ plug: "unknown" }) }));
    await press("No, it is still in");
    await waitFor(() => expect(rest.requests.at(-1)?.body).toMatchObject({ type: "unplug" }));
  });
});

describe("a failure", () => {
  test("is put away for good", async () => {
    show(live({ job: job({ state: "failed" }) }));
    await waitFor(() => expect(headline()).toBe("The car could not be charged"));
    await press("Got it");
    await waitFor(() => expect(headline()).toBe("Ready to charge"));
  });
});

describe("the connection", () => {
  test("is named, and buttons wait for it", async () => {
    show(live());
    expect(await screen.findByText("Live")).toBeTruthy();
    expect(button("Charge").disabled).toBe(false);
    FakeSocket.newest.breaks();
    expect(await screen.findByText("Reconnecting")).toBeTruthy();
    expect(button("Charge").disabled).toBe(true);
  });

  test("shows that a simulator is one, and how fast it runs", async () => {
    show(live());
    expect(await screen.findByText("Simulator ×10")).toBeTruthy();
    const real = { ...live().service, simulated: false, simulated_parts: [], speed: 1 };
    show(live({ service: real }));
    await waitFor(() => expect(screen.queryByText(/Simulat/)).toBeNull());
  });

  test("shows that a real robot may look at a simulated car", async () => {
    const service = { ...live().service, simulated: false, speed: 1 };
    show(live({ service: { ...service, simulated_parts: ["camera", "station"] } }));
    expect(await screen.findByText("Simulated car")).toBeTruthy();
    show(live({ service: { ...service, simulated_parts: ["station"] } }));
    expect(await screen.findByText("Simulated station")).toBeTruthy();
  });
});

describe("camera and 3D view", () => {
  const image = (): Element | null => document.querySelector("img");
  const frame = (): HTMLIFrameElement | null => document.querySelector("iframe");

  test("are loaded only when asked for, one at a time", async () => {
    show(live());
    await screen.findByText("Live");
    expect([image(), frame()]).toEqual([null, null]);
    await press("Camera See what the robot sees");
    await waitFor(() => expect(image()?.getAttribute("src")).toBe("/api/v1/camera/stream.mjpg"));
    await press("3D view See the robot from all sides");
    await waitFor(() => expect(frame()?.getAttribute("src")).toBe("/twin/"));
    expect(image()).toBeNull();
    await press("3D view See the robot from all sides");
    await waitFor(() => expect(frame()).toBeNull());
  });

  test("a broken camera can be tried again", async () => {
    show(live());
    await press("Camera See what the robot sees");
    await waitFor(() => expect(image()).not.toBeNull());
    fireEvent.error(image()!);
    expect(await screen.findByText("The camera is not answering.")).toBeTruthy();
    await press("Try again");
    await waitFor(() => expect(image()).not.toBeNull());
  });

  test("an absent camera is said, not shown", async () => {
    show(live({ service: { ...live().service, camera_online: false } }));
    await screen.findByText("Live");
    await press("Camera See what the robot sees");
    expect(await screen.findByText("The camera is not answering.")).toBeTruthy();
    expect(image()).toBeNull();
  });

  test("the 3D view's own word about its age is believed, a stranger's is not", async () => {
    show(live());
    await press("3D view See the robot from all sides");
    await waitFor(() => expect(frame()).not.toBeNull());
    const say = (twin: string, source: MessageEventSource | null): void => {
      const { origin } = location;
      dispatchEvent(new MessageEvent("message", { data: { twin }, origin, source }));
    };
    const warning = /not moving with the robot/;
    say("stale", window);
    expect(screen.queryByText(warning)).toBeNull();
    say("stale", frame()!.contentWindow);
    expect(await screen.findByText(warning)).toBeTruthy();
    say("live", frame()!.contentWindow);
    await waitFor(() => expect(screen.queryByText(warning)).toBeNull());
  });
});
