/** What the page knows about the robot, and how old that is. */
import { batch, computed, signal } from "@preact/signals";
import type { ReadonlySignal, Signal } from "@preact/signals";
import { PROTOCOL_VERSION } from "@/api/wire";
import type { DeltaMessage, Live, SnapshotMessage } from "@/api/wire";
import { Lateness } from "./lateness";

export type Link = "connecting" | "live" | "lost";

const DEFAULT_STALE_AFTER_MS = 1000;
/** A short interruption is not worth a headline. */
const UNREACHABLE_AFTER_MS = 2000;

/** Puts the changed sections over the old ones; absent ones did not change, null is none any more. */
export function merge(live: Live, changes: DeltaMessage["changes"]): Live {
  return {
    robot: changes.robot ?? live.robot,
    job: changes.job === undefined ? live.job : changes.job,
    station: changes.station ?? live.station,
    service: changes.service ?? live.service,
    twin: changes.twin ?? live.twin ?? {},
    guidance: (changes.guidance === undefined ? live.guidance : changes.guidance) ?? null,
    queue: changes.queue ?? live.queue ?? {},
    calibration: changes.calibration ?? live.calibration ?? {},
    control: changes.control ?? live.control ?? {},
    outlook: (changes.outlook === undefined ? live.outlook : changes.outlook) ?? null,
  };
}

/** The live state as signals. Times are milliseconds of a clock that never jumps. */
export class LiveStore {
  readonly live: Signal<Live | null> = signal(null);
  readonly link: Signal<Link> = signal<Link>("connecting");
  /** The server speaks a newer protocol: the page itself is old. */
  readonly outdated: Signal<boolean> = signal(false);
  /** The values on the page are older than they may be. */
  readonly stale: ReadonlySignal<boolean>;
  /** Only the robot's own measurements are too old, the connection is fine. */
  readonly robotStale: Signal<boolean> = signal(false);
  /** There was no connection for long enough to say so. */
  readonly unreachable: Signal<boolean> = signal(false);

  staleAfterMs = DEFAULT_STALE_AFTER_MS;
  /** When the newest message came; null before the first one of this connection. */
  heardAtMs: number | null = null;

  private sequence = 0;
  private robotStamp = "";
  private robotStampAtMs = 0;
  private notLiveSinceMs: number | null = null;
  private readonly silent: Signal<boolean> = signal(false);
  /** Messages come, but too late. */
  private readonly late: Signal<boolean> = signal(false);
  private readonly lateness = new Lateness();

  constructor() {
    this.stale = computed(
      () =>
        this.live.value !== null &&
        (this.link.value !== "live" || this.silent.value || this.late.value),
    );
  }

  /** Takes a snapshot: everything before it is void. */
  snapshot(message: SnapshotMessage, nowMs: number): void {
    batch(() => {
      if (message.version !== PROTOCOL_VERSION) {
        this.outdated.value = true;
        return;
      }
      this.staleAfterMs = (message.stale_after_s ?? DEFAULT_STALE_AFTER_MS / 1000) * 1000;
      this.sequence = message.sequence;
      this.link.value = "live";
      // The server's clock may have begun anew with it.
      const startedAt = message.live.service.started_at;
      if (startedAt !== this.live.value?.service.started_at) this.lateness.forget();
      this.judge(message.sent_s, nowMs);
      this.take(message.live, nowMs);
    });
  }

  /** Takes changed sections; one that is not newer than what is known is dropped. */
  delta(message: DeltaMessage, nowMs: number): void {
    const known = this.live.value;
    if (known === null || this.link.value !== "live" || message.sequence <= this.sequence) return;
    batch(() => {
      this.sequence = message.sequence;
      this.judge(message.sent_s, nowMs);
      this.take(merge(known, message.changes), nowMs);
    });
  }

  /** The connection ended; the last values stay, shown as stale. */
  lost(): void {
    batch(() => {
      this.link.value = "lost";
      this.heardAtMs = null;
    });
  }

  /** Looks at the clock; call it a few times per second. */
  tick(nowMs: number): void {
    batch(() => {
      this.silent.value = this.heardAtMs !== null && nowMs - this.heardAtMs > this.staleAfterMs;
      const live = this.live.value;
      this.robotStale.value =
        live !== null &&
        live.robot.mode !== "offline" &&
        nowMs - this.robotStampAtMs > this.staleAfterMs;
      if (this.link.value === "live") this.notLiveSinceMs = null;
      else this.notLiveSinceMs ??= nowMs;
      this.unreachable.value =
        this.notLiveSinceMs !== null && nowMs - this.notLiveSinceMs > UNREACHABLE_AFTER_MS;
    });
  }

  private judge(sent_s: number | null | undefined, nowMs: number): void {
    if (sent_s == null) return;
    this.late.value = this.lateness.lateMs(sent_s * 1000, nowMs) > this.staleAfterMs;
  }

  private take(live: Live, nowMs: number): void {
    if (live.robot.updated_at !== this.robotStamp) {
      this.robotStamp = live.robot.updated_at;
      this.robotStampAtMs = nowMs;
    }
    this.heardAtMs = nowMs;
    this.live.value = live;
    this.tick(nowMs);
  }
}
