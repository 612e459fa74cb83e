import { cleanup, fireEvent, render, screen, waitFor } from "@testing-library/preact";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { h } from "preact";
import { session } from "@/access/session";
import type { Session } from "@/access/calls";
import { App } from "@/app";
import type { Control } from "@/api/wire";
import { awaited } from "@/control/state";
import { channel } from "@/live/page";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { at, live, snapshot, START } from "./states";

const ANNA = { id: "anna", name: "Anna", role: "owner" } as const;
const BEN = { id: "ben", name: "Ben", role: "technician" } as const;
const SEAT = (person: typeof ANNA | typeof BEN): Control => ({
  holder: { person, since: START, ends_at: at(60) },
});
const ASKED = (person: typeof ANNA | typeof BEN): Pick<Control, "request"> => ({
  request: { id: "r1", person, asked_at: START, ends_at: at(28) },
});

let rest: FakeRest;

beforeEach(() => {
  vi.stubGlobal("WebSocket", FakeSocket);
  rest = new FakeRest();
  for (const what of ["POST /robot/control/request", "DELETE /robot/control/request", "POST /robot/control/answer"])
    rest.answer(what, [200, {}]);
  awaited.value = null;
  session.value = {
    paired: true,
    person: { ...ANNA, ends_at: null },
    device_id: "phone",
    rights: ["read", "stop", "operate"],
    passkeys: false,
    screen: false,
  } as Session;
  channel.start();
  render(h(App, null));
});

afterEach(() => {
  channel.close();
  cleanup();
  session.value = null;
});

const show = (control: Control): void =>
  FakeSocket.newest.says(snapshot({ ...live(), control }));

test("whoever is in control is asked, and answers", async () => {
  show({ ...SEAT(ANNA), ...ASKED(BEN) });
  const alert = await screen.findByText("Ben (technician) asks for control");
  expect(alert.closest("[role=alert]")?.textContent).toContain("28\u00a0s");
  fireEvent.click(screen.getByRole("button", { name: "Give control" }));
  await waitFor(() => expect(rest.commands).toEqual(["POST /robot/control/answer"]));
  expect(rest.requests.at(-1)?.body).toEqual({ request_id: "r1", give: true });
});

test("others see who is in control, and ask before they do anything but stop", async () => {
  show(SEAT(BEN));
  await screen.findByText("Ben (technician) is in control");
  expect(screen.getByRole<HTMLButtonElement>("button", { name: "Charge" }).disabled).toBe(true);
  fireEvent.click(screen.getByRole("button", { name: "Ask for control" }));
  await waitFor(() => expect(rest.commands).toEqual(["POST /robot/control/request"]));
});

test("whoever asks can ask no more, and sees what came of it", async () => {
  show({ ...SEAT(BEN), ...ASKED(ANNA) });
  await screen.findByText("You have asked Ben (technician) for control");
  fireEvent.click(screen.getByRole("button", { name: "Ask no more" }));
  await waitFor(() => expect(rest.commands).toEqual(["DELETE /robot/control/request"]));
  show({ ...SEAT(BEN), answer: { request_id: "r1", person: ANNA, by: BEN, answer: "unanswered", at: START } });
  await screen.findByText("Ben (technician) has not answered and keeps control");
  fireEvent.click(screen.getByRole("button", { name: "Got it" }));
  await screen.findByText("Ben (technician) is in control");
});

test("an answer from before this page was opened is not shown", async () => {
  show({ ...SEAT(ANNA), answer: { request_id: "r0", person: ANNA, by: BEN, answer: "given", at: START } });
  await screen.findByRole("button", { name: "Charge" });
  expect(screen.queryByText(/has given you control/)).toBeNull();
});
