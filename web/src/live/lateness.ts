/**
 * How late messages arrive, compared with the quickest one.
 *
 * A connection that is too slow does not fall silent: its messages wait in line, and a page that
 * looks at their coming alone shows the past as the present. The two clocks may begin anywhere;
 * only the difference between sending and arriving counts, and how it grows.
 */

/** Quartz clocks drift apart: so much is forgiven of each second, ten times what they do. */
const DRIFT = 5e-4;

export class Lateness {
  private quickestMs: number | null = null;
  private lastMs = 0;

  /** Takes a message that was sent at a time of one clock and came at a time of the other. */
  lateMs(sentMs: number, nowMs: number): number {
    const wayMs = nowMs - sentMs;
    const known = this.quickestMs;
    this.quickestMs =
      known === null ? wayMs : Math.min(wayMs, known + (nowMs - this.lastMs) * DRIFT);
    this.lastMs = nowMs;
    return wayMs - this.quickestMs;
  }

  /** The other clock has begun anew. */
  forget(): void {
    this.quickestMs = null;
  }
}
