import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import type { ClientMessage, Question, ReplyMessage } from "@/api/wire";
import { DeadMan, releaseWithTheHand } from "@/technician/jog/dead-man";
import type { Ending } from "@/technician/jog/dead-man";

const UP = { axis: "y", direction: 1 } as const;
const LEFT = { axis: "x", direction: -1 } as const;
const REFUSED: ReplyMessage = { type: "reply", id: 0, ok: false, problem: null };

let sent: (Question | ClientMessage)[];
let reply: ReplyMessage | null;
let endings: Ending[];
let deadMan: DeadMan;
let forget: () => void;

beforeEach(() => {
  vi.useFakeTimers();
  sent = [];
  endings = [];
  reply = { type: "reply", id: 0, ok: true };
  deadMan = new DeadMan(
    {
      ask: (message) => {
        sent.push(message);
        return Promise.resolve(reply);
      },
      tell: (message) => {
        sent.push(message);
        return true;
      },
    },
    (ending) => endings.push(ending),
  );
  forget = releaseWithTheHand(deadMan);
});

afterEach(() => {
  forget();
  vi.useRealTimers();
});

const types = (): string[] => sent.map(({ type }) => type);

describe("holding", () => {
  test("says so at once and then ten times a second", async () => {
    deadMan.hold(UP, 5);
    expect(sent).toEqual([{ type: "jog", axis: "y", direction: 1, speed_mm_s: 5 }]);
    await vi.advanceTimersByTimeAsync(1000);
    expect(types()).toEqual(Array(11).fill("jog"));
    expect(deadMan.held.value).toEqual(UP);
  });

  test("the same way twice is one hold", async () => {
    deadMan.hold(UP, 5);
    deadMan.hold({ ...UP }, 5);
    await vi.advanceTimersByTimeAsync(100);
    expect(types()).toEqual(["jog", "jog"]);
  });

  test("another way lets go of the first", () => {
    deadMan.hold(UP, 5);
    deadMan.hold(LEFT, 5);
    expect(types()).toEqual(["jog", "jog_end", "jog"]);
  });
});

describe("letting go", () => {
  test.each(["pointerup", "pointercancel", "blur", "pagehide", "contextmenu"])(
    "at %s, in the same moment and for good",
    async (name) => {
      deadMan.hold(UP, 5);
      dispatchEvent(new Event(name));
      expect(types()).toEqual(["jog", "jog_end"]);
      await vi.advanceTimersByTimeAsync(1000);
      expect(types()).toEqual(["jog", "jog_end"]);
    },
  );

  test("when the page is hidden", () => {
    deadMan.hold(UP, 5);
    const shown = vi.spyOn(document, "visibilityState", "get").mockReturnValue("hidden");
    document.dispatchEvent(new Event("visibilitychange"));
    shown.mockRestore();
    expect(types()).toEqual(["jog", "jog_end"]);
  });

  test("at a second finger", () => {
    deadMan.hold(UP, 5);
    dispatchEvent(Object.assign(new Event("touchstart"), { touches: [{}, {}] }));
    expect(types()).toEqual(["jog", "jog_end"]);
  });

  test("not at the finger that holds", () => {
    deadMan.hold(UP, 5);
    dispatchEvent(Object.assign(new Event("touchstart"), { touches: [{}] }));
    expect(types()).toEqual(["jog"]);
  });

  test("when the page is left for another", () => {
    deadMan.hold(UP, 5);
    forget();
    expect(types()).toEqual(["jog", "jog_end"]);
  });

  test("twice says it once", () => {
    deadMan.hold(UP, 5);
    deadMan.release();
    deadMan.release();
    expect(types()).toEqual(["jog", "jog_end"]);
  });
});

describe("a motion that nobody released", () => {
  test("ends when the robot refuses, and says why", async () => {
    reply = REFUSED;
    deadMan.hold(UP, 5);
    await vi.advanceTimersByTimeAsync(0);
    expect(deadMan.held.value).toBeNull();
    expect(endings).toEqual([{ kind: "refused", problem: null }]);
  });

  test("ends when no answer comes", async () => {
    deadMan.hold(UP, 5);
    await vi.advanceTimersByTimeAsync(300);
    reply = null;
    await vi.advanceTimersByTimeAsync(100);
    expect(types().at(-1)).toBe("jog_end");
    expect(endings).toEqual([{ kind: "no_answer" }]);
  });

  test("is not blamed on a refusal that comes after letting go", async () => {
    reply = REFUSED;
    deadMan.hold(UP, 5);
    deadMan.release();
    await vi.advanceTimersByTimeAsync(0);
    expect(endings).toEqual([]);
  });
});
