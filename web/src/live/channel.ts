/** The WebSocket to the server: stays connected for ever, feeds the store, carries stops. */
import type { ClientMessage, Question, ReplyMessage, ServerMessage, StopKind } from "@/api/wire";
import type { LiveStore } from "./store";

/** A robot that is back is on the page again within two seconds; a try each second costs nothing. */
const BACK_OFF_MS = [250, 500, 1000] as const;
const TICK_MS = 200;
/** A connection this many stale periods silent is dead, even if no one said so. */
const DEAD_AFTER_PERIODS = 5;
const OPEN_PATIENCE_MS = 6000;
const REPLY_PATIENCE_MS = 400;
/** After a sleep the connection may be dead without knowing: so long it has for a sign of life. */
const WAKE_PATIENCE_MS = 1000;

/** What the channel needs of the browser; tests bring their own. */
export interface Surroundings {
  open(): WebSocket;
  nowMs(): number;
  /** Uniform in [0, 1): spreads the reconnections of many pages after a restart. */
  random(): number;
}

export function browserSurroundings(): Surroundings {
  return {
    open: () => {
      const scheme = location.protocol === "https:" ? "wss" : "ws";
      return new WebSocket(`${scheme}://${location.host}/api/v1/ws`);
    },
    nowMs: () => performance.now(),
    random: Math.random,
  };
}

export class LiveChannel {
  private socket: WebSocket | null = null;
  private attempts = 0;
  private openedAtMs = 0;
  private probed = false;
  /** Until when a connection that slept must have said something; null when nobody asks. */
  private proveByMs: number | null = null;
  private retry: ReturnType<typeof setTimeout> | null = null;
  private ticker: ReturnType<typeof setInterval> | null = null;
  private nextId = 1;
  private readonly waiting = new Map<number, (reply: ReplyMessage) => void>();

  constructor(
    private readonly store: LiveStore,
    private readonly around: Surroundings = browserSurroundings(),
  ) {}

  /** Connects, and keeps connecting until close(). */
  start(): void {
    this.ticker ??= setInterval(() => this.tick(), TICK_MS);
    this.connect();
  }

  close(): void {
    if (this.ticker !== null) clearInterval(this.ticker);
    if (this.retry !== null) clearTimeout(this.retry);
    this.ticker = this.retry = null;
    this.drop();
  }

  /** Tries again at once: the network came back or the page came to the front. */
  hurry(): void {
    if (this.retry === null) return;
    clearTimeout(this.retry);
    this.retry = null;
    this.connect();
  }

  /** The page woke up: tries again at once, or asks a connection that slept whether it lives. */
  wake(): void {
    if (this.retry !== null) {
      this.hurry();
    } else if (this.tell({ type: "resync" })) {
      this.proveByMs = this.around.nowMs() + WAKE_PATIENCE_MS;
    }
  }

  /** Sends a stop; resolves to whether the server confirmed it in time. */
  async stop(kind: StopKind): Promise<boolean> {
    return (await this.ask({ type: kind }))?.ok ?? false;
  }

  /** Sends a message; resolves to its answer, or null when none came in time. */
  ask(message: Question, patienceMs = REPLY_PATIENCE_MS): Promise<ReplyMessage | null> {
    const id = this.nextId++;
    if (!this.tell({ ...message, id })) return Promise.resolve(null);
    return new Promise((resolve) => {
      const end = (reply: ReplyMessage | null): void => {
        clearTimeout(timer);
        this.waiting.delete(id);
        resolve(reply);
      };
      const timer = setTimeout(() => end(null), patienceMs);
      this.waiting.set(id, end);
    });
  }

  /** Sends a message that needs no answer; false when there is no connection. */
  tell(message: ClientMessage): boolean {
    const { socket } = this;
    if (socket === null || socket.readyState !== WebSocket.OPEN) return false;
    socket.send(JSON.stringify(message));
    return true;
  }

  private connect(): void {
    this.drop();
    const socket = this.around.open();
    this.socket = socket;
    this.openedAtMs = this.around.nowMs();
    this.probed = false;
    this.proveByMs = null;
    socket.onmessage = (event: MessageEvent<string>) => {
      this.receive(JSON.parse(event.data) as ServerMessage);
    };
    socket.onclose = () => {
      this.store.lost();
      this.reconnectLater();
    };
  }

  private receive(message: ServerMessage): void {
    const nowMs = this.around.nowMs();
    this.probed = false;
    this.proveByMs = null;
    switch (message.type) {
      case "snapshot":
        this.attempts = 0;
        this.store.snapshot(message, nowMs);
        break;
      case "delta":
        this.store.delta(message, nowMs);
        break;
      case "reply":
        this.waiting.get(message.id)?.(message);
        break;
    }
  }

  private reconnectLater(): void {
    this.drop();
    const longest = BACK_OFF_MS[Math.min(this.attempts, BACK_OFF_MS.length - 1)]!;
    this.attempts += 1;
    const delayMs = longest * (0.7 + 0.6 * this.around.random());
    this.retry = setTimeout(() => {
      this.retry = null;
      this.connect();
    }, delayMs);
  }

  /** Asks a silent server for a sign of life, and gives a dead connection up. */
  private tick(): void {
    const nowMs = this.around.nowMs();
    this.store.tick(nowMs);
    if (this.socket === null) return;
    const { heardAtMs, staleAfterMs } = this.store;
    if (heardAtMs === null) {
      if (nowMs - this.openedAtMs > OPEN_PATIENCE_MS) this.giveUp();
    } else if (
      nowMs - heardAtMs > staleAfterMs * DEAD_AFTER_PERIODS ||
      (this.proveByMs !== null && nowMs > this.proveByMs)
    ) {
      this.giveUp();
    } else if (nowMs - heardAtMs > staleAfterMs / 2 && !this.probed) {
      this.probed = true;
      this.socket.send(JSON.stringify({ type: "resync" }));
    }
  }

  private giveUp(): void {
    this.store.lost();
    this.reconnectLater();
  }

  /** Lets go of the socket without hearing of it again. */
  private drop(): void {
    const { socket } = this;
    this.socket = null;
    if (socket === null) return;
    socket.onmessage = socket.onclose = null;
    socket.close();
  }
}
