/**
 * Hold-to-move: the robot moves only as long as this keeps saying so, ten times a second.
 *
 * Anything that casts doubt on the hand at the button ends it: release, lost focus, a hidden page,
 * a second finger, a refusal, or no answer. The server stops by itself after 250 ms of silence.
 */
import { signal } from "@preact/signals";
import type { ReadonlySignal, Signal } from "@preact/signals";
import type { ClientMessage, Problem, Question, ReplyMessage } from "@/api/wire";
import type { Way } from "./axes";
import { sameWay } from "./axes";

const BEAT_MS = 100;

/** What it needs of the live channel. */
export interface Line {
  ask(message: Question): Promise<ReplyMessage | null>;
  tell(message: ClientMessage): boolean;
}

/** Why a motion ended that nobody released. */
export type Ending = { readonly kind: "no_answer" } | { readonly kind: "refused"; readonly problem: Problem | null };

/** Says again and again that a hand holds something, until it lets go. */
export class Grip<Held> {
  private readonly what: Signal<Held | null> = signal(null);
  private beat: ReturnType<typeof setInterval> | null = null;

  constructor(
    private readonly line: Line,
    private readonly same: (a: Held, b: Held) => boolean,
    private readonly onEnding: (ending: Ending) => void,
  ) {}

  /** What is held now. */
  get held(): ReadonlySignal<Held | null> {
    return this.what;
  }

  /** A hand has taken hold; whatever was held before is let go. */
  take(held: Held, question: Question): void {
    if (this.holds(held)) return;
    this.release();
    this.what.value = held;
    const say = (): void => void this.say(held, question);
    this.beat = setInterval(say, BEAT_MS);
    say();
  }

  /** The hand has let go, or may have. Harmless when nothing is held. */
  release(): void {
    if (this.beat === null) return;
    clearInterval(this.beat);
    this.beat = null;
    this.what.value = null;
    this.line.tell({ type: "jog_end" });
  }

  private holds(held: Held): boolean {
    const now = this.what.value;
    return now !== null && this.same(now, held);
  }

  private async say(held: Held, question: Question): Promise<void> {
    const reply = await this.line.ask(question);
    if (reply?.ok === true || !this.holds(held)) return;
    this.release();
    this.onEnding(reply === null ? { kind: "no_answer" } : { kind: "refused", problem: reply.problem ?? null });
  }
}

/** Holds one way to jog. */
export class DeadMan {
  private readonly grip: Grip<Way>;

  constructor(line: Line, onEnding: (ending: Ending) => void) {
    this.grip = new Grip<Way>(line, sameWay, onEnding);
  }

  /** What is held now. */
  get held(): ReadonlySignal<Way | null> {
    return this.grip.held;
  }

  /** A hand has taken hold of a way; whatever was held before is let go. */
  hold(way: Way, speed_mm_s: number): void {
    this.grip.take(way, { type: "jog", ...way, speed_mm_s });
  }

  /** The hand has let go, or may have. Harmless when nothing is held. */
  release(): void {
    this.grip.release();
  }
}

/** Lets go at everything that a page can notice of a hand or an eye that has gone. */
export function releaseWithTheHand(deadMan: { release(): void }): () => void {
  const release = (): void => deadMan.release();
  const releaseOnSecondFinger = (event: TouchEvent): void => {
    if (event.touches.length > 1) deadMan.release();
  };
  const releaseWhenHidden = (): void => {
    if (document.visibilityState !== "visible") deadMan.release();
  };
  const hand = ["pointerup", "pointercancel", "blur", "pagehide", "contextmenu"] as const;
  for (const name of hand) addEventListener(name, release);
  addEventListener("touchstart", releaseOnSecondFinger, { passive: true });
  document.addEventListener("visibilitychange", releaseWhenHidden);
  return () => {
    for (const name of hand) removeEventListener(name, release);
    removeEventListener("touchstart", releaseOnSecondFinger);
    document.removeEventListener("visibilitychange", releaseWhenHidden);
    deadMan.release();
  };
}
