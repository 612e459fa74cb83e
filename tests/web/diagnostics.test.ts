import { cleanup, fireEvent, render, screen, waitFor } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { session } from "@/access/session";
import { speak } from "@/language/catalogue";
import { channel } from "@/live/page";
import { DiagnosticsPanel } from "@/technician/diagnostics/panel";
import { newsWanted } from "@/technician/diagnostics/updated";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";
import { live, snapshot } from "./states";

const VERSIONS = {
  software: "0.1.0",
  python: "3.11.9",
  system: "Linux",
  libraries: [{ name: "numpy", version: "2.0.0" }],
  board: null,
  firmware: null,
  protocol_hash: "13345a36",
  releases: [
    { version: "0.2.0", released_on: "2026-12-01", changes: ["Measures the belts."] },
    { version: "0.1.0", released_on: "2026-11-22", changes: ["Plugs in and unplugs by itself."] },
  ],
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

test("what is new is listed, the newest first, and in which language", async () => {
  const news = await screen.findByText("What is new");
  const versions = [...news.closest("details")!.querySelectorAll("h3")].map(({ textContent }) => textContent);
  expect(versions).toEqual(["0.2.0 2026-12-01", "0.1.0 2026-11-22"]);
  expect(screen.getByText("Measures the belts.").closest("[lang]")?.getAttribute("lang")).toBe("en");
  expect(screen.queryByText("The notes are in English.")).toBeNull();
  await speak("de");
  await screen.findByText("Die Notizen sind auf Englisch.");
  await speak("en");
});

test("what is new opens by itself when somebody wants it", async () => {
  const news = (await screen.findByText("What is new")).closest("details")!;
  expect(news.open).toBe(false);
  newsWanted.value = true;
  await waitFor(() => expect(news.open).toBe(true));
});

describe("the line after an update", () => {
  const SEEN = "plugpilot.version.seen";

  /** The page as loaded anew, with what this browser has kept, on a robot of that version. */
  async function visit(version: string): Promise<void> {
    cleanup();
    channel.close();
    vi.resetModules();
    const [page, { UpdatedLine }, words] = await Promise.all([
      import("@/live/page"),
      import("@/technician/diagnostics/updated-line"),
      import("@/language/catalogue"),
    ]);
    await words.speak("en");
    vi.stubGlobal("WebSocket", FakeSocket);
    FakeSocket.made.length = 0;
    page.channel.start();
    render(h(UpdatedLine, null));
    const { service } = live();
    FakeSocket.newest.says(snapshot(live({ service: { ...service, version } })));
    await waitFor(() => expect(page.store.live.value?.service.version).toBe(version));
    page.channel.close();
  }

  test("comes neither at the first visit nor without an update", async () => {
    localStorage.removeItem(SEEN);
    await visit("0.1.0");
    expect(screen.queryByRole("button")).toBeNull();
    expect(localStorage.getItem(SEEN)).toBe("0.1.0");
    await visit("0.1.0");
    expect(screen.queryByRole("button")).toBeNull();
  });

  test("comes once, and is put away for good", async () => {
    localStorage.setItem(SEEN, "0.1.0");
    await visit("0.2.0");
    await screen.findByRole("button", { name: "Updated to 0.2.0: what is new" });
    fireEvent.click(screen.getByRole("button", { name: "Put away" }));
    await waitFor(() => expect(screen.queryByRole("button")).toBeNull());
    await visit("0.2.0");
    expect(screen.queryByRole("button")).toBeNull();
  });
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
