/** What a screen reader says: every new state, but numbers only when they have changed well. */
import type { Guidance } from "@/api/wire";
import type { Instruction } from "./instruction";

const PAUSE_MS = 2500;
const SHARE = 0.3;

export class Announcer {
  private said: { state: string; direction: string; cm: number; atMs: number } | null = null;
  private text = "";

  /** The text to have in the live region now. */
  next(guidance: Guidance, told: Instruction, nowMs: number): string {
    const [step] = guidance.steps;
    const now = {
      state: guidance.state,
      direction: step?.direction ?? "",
      cm: step?.shown_cm ?? 0,
      atMs: nowMs,
    };
    if (this.isNews(now)) {
      this.said = now;
      this.text = [told.headline, told.detail, told.remedy]
        .filter((part) => part !== "")
        .join(". ")
        .replaceAll("..", ".");
    }
    return this.text;
  }

  private isNews(now: NonNullable<Announcer["said"]>): boolean {
    const { said } = this;
    if (said === null || said.state !== now.state) return true;
    if (now.atMs - said.atMs < PAUSE_MS) return false;
    return said.direction !== now.direction || Math.abs(now.cm - said.cm) > SHARE * said.cm;
  }
}
