import { beforeEach, describe, expect, test, vi } from "vitest";
import { channel } from "@/live/page";
import { begin, doorTrouble, may, secretIn, session, waitingInvitation } from "@/access/session";
import { FakeRest } from "./rest";
import { FakeSocket } from "./socket";

const SECRET = "jAv_GllMKyccnUsYYH0J1Q";
const STRANGER = {
  paired: false,
  person: null,
  device_id: null,
  rights: ["anyone"],
  passkeys: false,
  screen: false,
};
const VIEWER = {
  ...STRANGER,
  paired: true,
  person: { id: "1", name: "Anna", role: "viewer", ends_at: null },
  rights: ["anyone", "person", "read", "stop"],
};
const REFUSED = {
  type: "urn:plugpilot:problem:invitation",
  title: "This invitation is not valid",
  status: 403,
  code: "invitation",
  detail: "It was used before.",
  remedy: "Ask for a new one.",
};

let rest: FakeRest;

beforeEach(() => {
  vi.stubGlobal("WebSocket", FakeSocket);
  rest = new FakeRest();
  session.value = waitingInvitation.value = doorTrouble.value = null;
  location.hash = "";
  channel.close();
});

describe("the secret of an invitation", () => {
  test.each([
    [`http://192.168.1.20:8000/#pair=${SECRET}`, SECRET],
    [`#pair=${SECRET}`, SECRET],
    ["http://192.168.1.20:8000/", null],
    ["#pair=", null],
    ["#pair=<script>alert(1)</script>", null],
    [`#pair=${SECRET}&more`, null],
    ["", null],
  ])("in %s", (text, secret) => {
    expect(secretIn(text)).toBe(secret);
  });
});

describe("opening the page", () => {
  test("an invitation in the address lets in, and leaves the address", async () => {
    rest.answer("GET /access/session", [200, STRANGER]);
    rest.answer("POST /access/pairing", [200, VIEWER]);
    location.hash = `#pair=${SECRET}`;
    await begin();
    expect(rest.requests.at(-1)?.body).toEqual({ secret: SECRET });
    expect(location.hash).toBe("");
    expect(session.value?.paired).toBe(true);
    expect(may("stop")).toBe(true);
    expect(may("operate")).toBe(false);
  });

  test("whoever is paired already is asked first", async () => {
    rest.answer("GET /access/session", [200, VIEWER]);
    location.hash = `#pair=${SECRET}`;
    await begin();
    expect(rest.commands).toEqual([]);
    expect(waitingInvitation.value).toBe(SECRET);
  });

  test("an invitation that is not valid is explained", async () => {
    rest.answer("GET /access/session", [200, STRANGER]);
    rest.answer("POST /access/pairing", [403, REFUSED]);
    location.hash = `#pair=${SECRET}`;
    await begin();
    expect(session.value?.paired).toBe(false);
    expect(doorTrouble.value?.remedy).toBe("Ask for a new one.");
    expect(location.hash).toBe("");
  });
});
