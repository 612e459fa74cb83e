import { cleanup, fireEvent, render, screen, waitFor } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { session } from "@/access/session";
import { DiagnosticsPanel } from "@/technician/diagnostics/panel";
import { FakeRest } from "./rest";

const VERSIONS = {
  software: "0.1.0",
  python: "3.11.9",
  system: "Linux",
  libraries: [{ name: "numpy", version: "2.0.0" }],
  board: null,
  firmware: null,
  protocol_hash: "13345a36",
};

let rest: FakeRest;

beforeEach(() => {
  session.value = null;
  vi.stubGlobal("URL", Object.assign(URL, { createObjectURL: () => "blob:x", revokeObjectURL: () => undefined }));
  rest = new FakeRest().answer("GET /versions", [200, VERSIONS]);
  render(h(DiagnosticsPanel, null));
  const details = document.querySelector("details")!;
  details.open = true;
  fireEvent(details, new Event("toggle"));
});
afterEach(cleanup);

const press = async (): Promise<void> => {
  fireEvent.click(await screen.findByRole("button", { name: "Download diagnostics" }));
};

test("versions are shown, and what is not known is said", async () => {
  await screen.findByText("13345a36");
  expect(screen.getAllByText("not known yet").length).toBe(2);
});

test("the file is collected and handed over once", async () => {
  rest.answer("GET /diagnostics.zip", [200, { bytes: 1 }]);
  await press();
  await screen.findByText("Downloaded, 1 kB.");
  expect(rest.requests.filter(({ what }) => what === "GET /diagnostics.zip").length).toBe(1);
});

test("a refusal is said in words", async () => {
  rest.answer("GET /diagnostics.zip", [
    503,
    { code: "storage", title: "The disk is full", detail: "Nothing can be read.", remedy: "Make room." },
  ]);
  await press();
  await waitFor(() => expect(document.body.textContent).toContain("The disk is full."));
});
