/** Notifications on this device: whether they can be, and switching them on and off. */
import { call } from "@/api/client";
import type { components } from "@/api/schema";
import { language } from "@/language/language";

type PushState = components["schemas"]["PushState"];
type PushSubscriptionWanted = components["schemas"]["PushSubscription"];

export type Notifying =
  | "impossible" // plain http, or a browser that cannot
  | "blocked" // somebody has said no; only the browser's settings help
  | "off"
  | "on";

const READY_MS = 4000;

/** Whether this browser is notified, as both sides know it. */
export async function notifying(): Promise<Notifying> {
  const registration = await installed();
  if (registration === null) return "impossible";
  if (Notification.permission === "denied") return "blocked";
  const own = await registration.pushManager.getSubscription();
  if (own === null) return "off";
  return (await readState()).subscribed ? "on" : "off";
}

/**
 * Asks the person, subscribes at the browser's push service, and tells the robot where that is.
 * Call it for a press: browsers ask nobody otherwise.
 *
 * @throws Refusal when the robot says no, or cannot be asked.
 */
export async function notify(): Promise<Notifying> {
  if ((await Notification.requestPermission()) !== "granted") return notifying();
  const registration = await installed();
  if (registration === null) return "impossible";
  const { public_key } = await readState();
  // One that was made for another key, before the robot's data was set up anew, is of no use.
  await (await registration.pushManager.getSubscription())?.unsubscribe();
  let made: PushSubscription;
  try {
    made = await registration.pushManager.subscribe({
      userVisibleOnly: true,
      applicationServerKey: public_key,
    });
  } catch (error) {
    // The browser's word for "there is no push service here".
    if (error instanceof DOMException) return "impossible";
    throw error;
  }
  await tell(made);
  return "on";
}

/** Ends it at both sides. */
export async function stopNotifying(): Promise<Notifying> {
  await call("/push", { method: "DELETE" });
  await (await (await installed())?.pushManager.getSubscription())?.unsubscribe();
  return "off";
}

/** Tells the robot again, in the language of now; push services change addresses at times. */
export async function renew(): Promise<void> {
  const registration = await installed();
  const own = await registration?.pushManager.getSubscription();
  if (own != null && (await readState()).subscribed) await tell(own);
}

async function installed(): Promise<ServiceWorkerRegistration | null> {
  if (!("serviceWorker" in navigator) || !("PushManager" in window)) return null;
  if (!("Notification" in window)) return null;
  const never = new Promise<null>((resolve) => setTimeout(() => resolve(null), READY_MS));
  return Promise.race([navigator.serviceWorker.ready, never]);
}

const readState = (): Promise<PushState> => call("/push");

async function tell(made: PushSubscription): Promise<void> {
  const { endpoint, keys } = made.toJSON();
  const wanted: PushSubscriptionWanted = {
    endpoint: endpoint ?? "",
    p256dh: keys?.["p256dh"] ?? "",
    auth: keys?.["auth"] ?? "",
    language: language.value,
  };
  await call("/push", { method: "PUT", body: wanted });
}
