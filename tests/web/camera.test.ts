import { cleanup, fireEvent, render, screen, waitFor } from "@testing-library/preact";
import { h } from "preact";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import openapi from "../../web/openapi.json";
import type { CameraInspection } from "@/api/wire";
import { magnification, side_px, SIGMAS_95 } from "@/technician/camera/ellipse";
import { CameraPanel } from "@/technician/camera/panel";
import { sentenceOf } from "@/technician/camera/picture";
import { FakeRest } from "./rest";

const EXAMPLE = openapi.paths["/api/v1/camera/inspection"].get.responses["200"].content["application/json"]
  .example as unknown as CameraInspection;
const TROUBLE = {
  type: "urn:x",
  title: "Too dark",
  status: 422,
  code: "picture_too_dark",
  detail: "Hardly any light.",
  remedy: "Switch a light on.",
};

let rest: FakeRest;

beforeEach(() => {
  rest = new FakeRest();
  vi.stubGlobal("URL", Object.assign(URL, { createObjectURL: () => "blob:x", revokeObjectURL: () => undefined }));
});
afterEach(cleanup);

const open = (): void => {
  const details = document.querySelector("details")!;
  details.open = true;
  fireEvent(details, new Event("toggle"));
};

describe("the panel", () => {
  test("asks for nothing before it is opened, and shows what was found then", async () => {
    rest.answer("GET /camera/inspection?after=0", [200, EXAMPLE]);
    rest.answer("GET /camera/inspection/42.jpg", [200, {}]);
    render(h(CameraPanel, null));
    expect(rest.requests).toEqual([]);
    open();
    await screen.findByText("318.442 ± 0.021 mm");
    expect(document.querySelectorAll("svg polygon.outline").length).toBe(1);
    expect(document.querySelectorAll("svg ellipse.sigma").length).toBe(2);
    await screen.findByText("30.0 Hz");
    cleanup();
    const asked = rest.requests.length;
    await new Promise((resolve) => setTimeout(resolve, 30));
    expect(rest.requests.length).toBeLessThanOrEqual(asked + 1);
  });

  test("says why there is no picture", async () => {
    rest.answer("GET /camera/inspection?after=0", [503, { ...TROUBLE, title: "No camera" }]);
    render(h(CameraPanel, null));
    open();
    await waitFor(() => expect(document.body.textContent).toContain("No camera."));
  });
});

describe("words", () => {
  test("tell a trusted pose from a coarse one, a stranger and nothing", () => {
    expect(sentenceOf(EXAMPLE)).toContain("passed every check");
    expect(sentenceOf({ ...EXAMPLE, trouble: TROUBLE })).toContain("nothing moves by it");
    expect(sentenceOf({ ...EXAMPLE, label: { ...EXAMPLE.label!, pose: null } })).toContain("no vehicle");
    expect(sentenceOf({ ...EXAMPLE, label: null, trouble: TROUBLE })).toBe(
      "Too dark. Hardly any light. Switch a light on.",
    );
  });
});

describe("the ellipse", () => {
  test("is drawn as large as fits into the label, by a power of ten", () => {
    const side = side_px({ outline_px: [[0, 0], [100, 0], [100, 100], [0, 100]] });
    expect(side).toBe(100);
    for (const major of [3, 0.5, 0.013, 0.0004]) {
      const times = magnification(major, side);
      const drawn = SIGMAS_95 * major * times;
      expect(Math.log10(times) % 1).toBe(0);
      expect(drawn).toBeLessThanOrEqual(30);
      expect(drawn).toBeGreaterThan(3);
    }
    expect(magnification(0, side)).toBe(1);
  });
});
