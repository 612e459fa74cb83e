import { cleanup, fireEvent, render, screen, waitFor } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, beforeEach, describe, expect, test } from "vitest";
import { session } from "@/access/session";
import type { Configuration, ConfigurationField } from "@/api/wire";
import { read, textOf, valueOf } from "@/technician/config/draft";
import { discard, draft } from "@/technician/config/editor";
import { ConfigPanel } from "@/technician/config/panel";
import { FakeRest } from "./rest";

const field = (changes: Partial<ConfigurationField>): ConfigurationField => ({
  key: "webhooks.timeout_s",
  kind: "number",
  words: "Longest time",
  optional: false,
  choices: [],
  least: 0,
  most: 60,
  changeable: true,
  ...changes,
});
const FIELDS = [
  field({}),
  field({ key: "logging.level", kind: "choice", choices: ["info", "debug"], least: null, most: null }),
  field({ key: "webhooks.retry_after_s", kind: "other", least: null, most: null }),
  field({ key: "robot.port", kind: "text", changeable: false }),
];
const CONFIG: Configuration = {
  changeable: ["logging", "webhooks"],
  settings: {
    webhooks: { timeout_s: 10, retry_after_s: [0, 5] },
    logging: { level: "info" },
    robot: { port: "auto" },
  },
};

describe("what was typed", () => {
  test("becomes a change of the right kind", () => {
    const { patch, unreadable } = read(
      { "webhooks.timeout_s": " 5 ", "logging.level": "debug", "webhooks.retry_after_s": "[1, 2]" },
      FIELDS,
    );
    expect(patch).toEqual({ webhooks: { timeout_s: 5, retry_after_s: [1, 2] }, logging: { level: "debug" } });
    expect(unreadable).toEqual({});
  });

  test("empty means the value of the start; nonsense is named", () => {
    const { patch, unreadable } = read({ "webhooks.timeout_s": "", "webhooks.retry_after_s": "[1," }, FIELDS);
    expect(patch).toEqual({ webhooks: { timeout_s: null } });
    expect(Object.keys(unreadable)).toEqual(["webhooks.retry_after_s"]);
  });

  test("values are found and shown", () => {
    expect(textOf(valueOf(CONFIG.settings, "webhooks.retry_after_s"))).toBe("[0,5]");
    expect(textOf(valueOf(CONFIG.settings, "nothing.there"))).toBe("");
  });
});

describe("the panel", () => {
  let rest: FakeRest;

  beforeEach(() => {
    session.value = null;
    discard();
    rest = new FakeRest()
      .answer("GET /config", [200, CONFIG])
      .answer("GET /config/fields", [200, { fields: FIELDS }])
      .answer("GET /config/versions", [
        200,
        {
          versions: [
            { number: 3, at: "2026-03-01T18:04:05Z", by: "Anna", changes: { webhooks: { timeout_s: 10 } } },
            { number: 0, at: null, by: "", changes: {} },
          ],
        },
      ]);
    render(h(ConfigPanel, null));
    const details = document.querySelector("details")!;
    details.open = true;
    fireEvent(details, new Event("toggle"));
  });
  afterEach(cleanup);

  const enter = async (text: string): Promise<void> => {
    fireEvent.input(await screen.findByLabelText("timeout s"), { target: { value: text } });
  };
  const save = (): HTMLButtonElement => screen.getByRole("button", { name: "Save" });

  test("shows the difference before anything is saved", async () => {
    rest.answer("POST /config/check", [
      200,
      { troubles: [], differences: [{ key: "webhooks.timeout_s", before: 10, after: 5 }] },
    ]);
    await enter("5");
    await waitFor(() => expect(document.querySelector("ins")?.textContent).toBe("5"));
    expect(rest.commands).toEqual(["POST /config/check"]);
    rest.answer("PATCH /config", [200, CONFIG]);
    fireEvent.click(save());
    await screen.findByText("Saved. It is in force now.");
    expect(rest.requests.find(({ what }) => what === "PATCH /config")?.body).toEqual({ webhooks: { timeout_s: 5 } });
    expect(draft.value).toEqual({});
  });

  test("marks the field that is wrong and saves nothing", async () => {
    rest.answer("POST /config/check", [
      200,
      { troubles: [{ key: "webhooks.timeout_s", sentence: "must be less than 60." }], differences: [] },
    ]);
    await enter("600");
    await screen.findByText("must be less than 60.");
    expect(screen.getByLabelText("timeout s").getAttribute("aria-invalid")).toBe("true");
    expect(save().disabled).toBe(true);
  });

  test("keeps what was typed when somebody else was quicker", async () => {
    rest.answer("POST /config/check", [
      200,
      { troubles: [], differences: [{ key: "webhooks.timeout_s", before: 10, after: 5 }] },
    ]);
    rest.answer("PATCH /config", [
      412,
      { code: "precondition_failed", title: "Changed meanwhile", detail: "Look.", remedy: "Save again." },
    ]);
    await enter("5");
    await waitFor(() => expect(save().disabled).toBe(false));
    fireEvent.click(save());
    await waitFor(() => expect(document.body.textContent).toContain("Changed meanwhile."));
    expect(draft.value).toEqual({ "webhooks.timeout_s": "5" });
  });

  test("goes back only when asked twice", async () => {
    rest.answer("POST /config/versions/0/restore", [200, CONFIG]);
    fireEvent.click(await screen.findByRole("button", { name: "Go back to this" }));
    expect(rest.commands).toEqual([]);
    fireEvent.click(await screen.findByRole("button", { name: "Press again to go back" }));
    await waitFor(() => expect(rest.commands).toEqual(["POST /config/versions/0/restore"]));
  });

  test("says what needs a restart and where it stands", async () => {
    await screen.findByText("robot.port");
    await screen.findByText(/Change them there, then start PlugPilot again/);
  });
});
