/**
 * Opens the home page when the robot cannot be reached, and shows notifications.
 *
 * It keeps the page itself, never an answer of the robot: what is not on the list below goes to
 * the network untouched, so no state can be older than the page says. A new version is fetched
 * beside the old one and waits until the page says that nobody is in the middle of something.
 */
import { noticeOf } from "./notices";

declare const self: ServiceWorkerGlobalScope;

/** The build puts in what belongs to the home page, and a digest of it. */
declare const __SHELL__: { readonly version: string; readonly files: readonly string[] };

const { version, files } = __SHELL__;
const CACHE = `home-${version}`;
const PAGE = "/";
const ICON = "/icons/icon-192.png";
/** A network that takes longer to bring the page is as good as none. */
const PATIENCE_MS = 4000;

self.addEventListener("install", (event) => {
  event.waitUntil(fill());
});

self.addEventListener("activate", (event) => {
  event.waitUntil(tidy());
});

self.addEventListener("message", (event) => {
  if (event.data === "take over") void self.skipWaiting();
});

self.addEventListener("fetch", (event) => {
  const { request } = event;
  const { origin, pathname } = new URL(request.url);
  if (request.method !== "GET" || origin !== self.location.origin) return;
  if (request.mode === "navigate" && pathname === PAGE) event.respondWith(page(request));
  else if (files.includes(pathname)) event.respondWith(kept(request));
});

self.addEventListener("push", (event) => {
  const { title, body, lang, stays } = noticeOf(event.data?.text() ?? "");
  // The same tag: a newer notification takes the place of an older one.
  const shown = { body, lang, tag: "plugpilot", renotify: true, requireInteraction: stays };
  event.waitUntil(self.registration.showNotification(title, { ...shown, icon: ICON }));
});

self.addEventListener("notificationclick", (event) => {
  event.notification.close();
  event.waitUntil(openPage());
});

/** The page that is open comes to the front; else a new one. */
async function openPage(): Promise<void> {
  const open = await self.clients.matchAll({ type: "window", includeUncontrolled: true });
  const page = open.find((each) => new URL(each.url).pathname === PAGE);
  if (page === undefined) await self.clients.openWindow(PAGE);
  else await page.focus();
}

async function fill(): Promise<void> {
  const cache = await caches.open(CACHE);
  // Not from the browser's own cache, which may hold the page of yesterday.
  await cache.addAll([PAGE, ...files].map((path) => new Request(path, { cache: "no-cache" })));
}

async function tidy(): Promise<void> {
  const names = await caches.keys();
  await Promise.all(names.filter((name) => name !== CACHE).map((name) => caches.delete(name)));
  await self.clients.claim();
}

/** The newest page there is. */
async function page(request: Request): Promise<Response> {
  try {
    return await fetch(request, { signal: AbortSignal.timeout(PATIENCE_MS) });
  } catch {
    return (await caches.match(PAGE)) ?? Response.error();
  }
}

/** The name of a file holds a hash of its contents: what is kept is what would come. */
async function kept(request: Request): Promise<Response> {
  return (await caches.match(request)) ?? fetch(request);
}
