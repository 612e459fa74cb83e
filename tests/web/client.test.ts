import { beforeEach, describe, expect, test, vi } from "vitest";
import { Refusal, cancelJob, finishJob, startJob } from "@/api/client";
import { randomKey } from "@/api/key";
import { words } from "@/words";
import { FakeRest } from "./rest";
import { job } from "./states";

const PROBLEM = {
  type: "urn:plugpilot:problem:control_busy",
  title: "Busy",
  status: 409,
  code: "control_busy",
  detail: "Anna moves the robot.",
  remedy: "Wait for Anna.",
};

let rest: FakeRest;

beforeEach(() => {
  rest = new FakeRest();
});

async function refusalOf(call: Promise<unknown>): Promise<Refusal> {
  const outcome = await call.then(
    () => null,
    (error: unknown) => error,
  );
  if (!(outcome instanceof Refusal)) throw new Error("the call was not refused");
  return outcome;
}

describe("starting a job", () => {
  test("repeats a lost request under the same key", async () => {
    const lost = new TypeError("Failed to fetch");
    rest.answer("POST /jobs", lost, lost, [202, job()]);
    expect((await startJob({ type: "charge" })).id).toBe("job-1");
    const keys = rest.requests.map(({ headers }) => headers["Idempotency-Key"]);
    expect(keys).toHaveLength(3);
    expect(new Set(keys).size).toBe(1);
  });

  test("gives up after three losses", async () => {
    rest.answer("POST /jobs", new TypeError("Failed to fetch"));
    const refusal = await refusalOf(startJob({ type: "charge" }));
    expect(rest.requests).toHaveLength(3);
    expect(refusal.answered).toBe(false);
    expect(refusal.trouble).toEqual(words.trouble.unreachable);
  });

  test("never repeats a request that was answered", async () => {
    rest.answer("POST /jobs", [409, PROBLEM]);
    const refusal = await refusalOf(startJob({ type: "charge" }));
    expect(rest.requests).toHaveLength(1);
    expect(refusal.trouble).toEqual({
      code: "control_busy",
      title: "Busy",
      detail: "Anna moves the robot.",
      remedy: "Wait for Anna.",
    });
  });

  test("uses another key for another press", async () => {
    rest.answer("POST /jobs", [202, job()]);
    await startJob({ type: "charge" });
    await startJob({ type: "charge" });
    const [first, second] = rest.requests;
    expect(first?.headers["Idempotency-Key"]).not.toBe(second?.headers["Idempotency-Key"]);
  });
});

test("an answer that is no problem document gets general words", async () => {
  expect((await refusalOf(cancelJob("x"))).trouble).toEqual(words.trouble.unexpected);
  rest.answer("POST /jobs/x/finish", [500, { message: "?" }]);
  expect((await refusalOf(finishJob("x"))).trouble).toEqual(words.trouble.unexpected);
});

test("keys are version 4 UUIDs, also where crypto.randomUUID does not exist", () => {
  vi.stubGlobal("crypto", { getRandomValues: crypto.getRandomValues.bind(crypto) });
  const keys = Array.from({ length: 200 }, randomKey);
  const form = /^[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}$/;
  expect(keys.every((key) => form.test(key))).toBe(true);
  expect(new Set(keys).size).toBe(200);
});
