/**
 * Replaces an old page by the new one after an update, without loss of anything.
 *
 * Two signs tell that the server was updated: the service worker has a new version of the page,
 * or the robot's software names another version than when the page was opened.
 */
import { effect, signal } from "@preact/signals";
import { store } from "@/live/page";
import { description } from "@/robot/view";
import { renew } from "./push";

const LOOK_MS = 2000;

/** There is a newer page than this one. */
const newer = signal(false);

let waiting: ServiceWorker | null = null;

/** Registers the service worker where the connection allows one, and watches for updates. */
export function stayFresh(): void {
  watchVersion();
  setInterval(replaceWhenIdle, LOOK_MS);
  if (!("serviceWorker" in navigator)) return; // plain http: the page needs the network
  if (document.readyState === "complete") void register();
  else addEventListener("load", () => void register());
}

/** True when nobody would lose anything by loading the page anew. */
export function isIdle(): boolean {
  if (description.value.stoppable) return false; // the stop button stays under the finger
  return document.querySelector("dialog[open], form, iframe, input:focus, select:focus") === null;
}

function watchVersion(): void {
  let first: string | null = null;
  effect(() => {
    const version = store.live.value?.service.version;
    if (version === undefined) return;
    first ??= version;
    if (version !== first) newer.value = true;
  });
}

async function register(): Promise<void> {
  let registration: ServiceWorkerRegistration;
  try {
    registration = await navigator.serviceWorker.register("/worker.js");
  } catch {
    return; // A certificate that the browser does not trust allows none; the page works without.
  }
  const look = (): void => {
    // The first one ever replaces nothing.
    if (registration.waiting !== null && navigator.serviceWorker.controller !== null) {
      waiting = registration.waiting;
      newer.value = true;
    }
  };
  look();
  registration.addEventListener("updatefound", () => {
    registration.installing?.addEventListener("statechange", look);
  });
  if ("Notification" in window && Notification.permission === "granted") {
    // What fails now is tried again when the page is opened the next time.
    void renew().catch(() => undefined);
  }
  // A page that stays open for weeks asks when it comes back to the robot.
  effect(() => {
    if (store.link.value === "live") void registration.update().catch(() => undefined);
  });
}

function replaceWhenIdle(): void {
  if (!newer.value || store.link.value !== "live" || !isIdle()) return;
  newer.value = false;
  if (waiting === null) {
    location.reload();
    return;
  }
  navigator.serviceWorker.addEventListener("controllerchange", () => location.reload());
  waiting.postMessage("take over");
}
