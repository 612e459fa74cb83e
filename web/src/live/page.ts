/** The one live connection of this page, and the stop that must always get through. */
import { stopByRest } from "@/api/client";
import type { StopKind } from "@/api/wire";
import { LiveChannel } from "./channel";
import { LiveStore } from "./store";

export const store = new LiveStore();
export const channel = new LiveChannel(store);

/** Connects, and comes back quickly when the network or the reader does. */
export function connect(): void {
  channel.start();
  addEventListener("online", () => channel.wake());
  // A page that was frozen, or kept for the way back, has not seen its connection end.
  document.addEventListener("resume", () => channel.wake());
  addEventListener("pageshow", () => channel.wake());
  document.addEventListener("visibilitychange", () => {
    if (document.visibilityState === "visible") channel.wake();
  });
}

/**
 * Stops the robot over the WebSocket, and over REST when no confirmation comes back.
 *
 * Stopping twice does no harm; not stopping does.
 *
 * @throws Refusal when neither way was confirmed.
 */
export async function stop(kind: StopKind): Promise<void> {
  if (await channel.stop(kind)) return;
  await stopByRest(kind);
}


