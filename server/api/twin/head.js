// Runs before the 3D client, in the same page.
// The colour scheme is that of the browser unless the address says ?theme=light or ?theme=dark.
// A window narrower than high sees the whole robot from left to right.
{
  const query = new URLSearchParams(location.search);
  const theme = query.get("theme");
  const light = theme ? theme === "light" : matchMedia("(prefers-color-scheme: light)").matches;
  if (light) query.delete("darkMode");
  else query.set("darkMode", "");
  document.documentElement.dataset.theme = light ? "light" : "dark";
  const aspect = innerWidth / Math.max(innerHeight, 1);
  if (aspect < 1 && !query.has("initialCameraFov")) {
    const across = 42 * (Math.PI / 180);
    const fov = 2 * Math.atan(Math.tan(across / 2) / Math.max(aspect, 0.45));
    query.set("initialCameraFov", fov.toFixed(3));
  }
  history.replaceState(null, "", location.pathname + "?" + query.toString());
}

// The client reconnects only while the document has the focus, which a frame that nobody has
// touched never has.
document.hasFocus = () => document.visibilityState === "visible";
document.addEventListener("visibilitychange", () => {
  window.dispatchEvent(new Event(document.hidden ? "blur" : "focus"));
});

// Phones drop the graphics context of hidden pages; what comes back has lost its lights.
document.addEventListener("webglcontextrestored", () => location.reload(), true);

// Tells the page around this frame whether the picture is alive: the server moves an invisible
// node with every step.
{
  const STALE_AFTER_MS = 1500;
  let beat = null;
  let beatAt = performance.now();
  let said = null;
  setInterval(() => {
    const node = window.__viserMutable?.nodePoseData?.["/heartbeat"];
    const newest = node?.position?.[0] ?? null;
    const now = performance.now();
    if (newest !== null && newest !== beat) {
      beat = newest;
      beatAt = now;
    }
    const word = beat !== null && now - beatAt < STALE_AFTER_MS ? "live" : "stale";
    if (word === said) return;
    said = word;
    document.documentElement.dataset.twin = word;
    if (parent !== window) parent.postMessage({ twin: word }, location.origin);
  }, 250);
}
