// Lays the camera's picture into the pyramid of its view while this viewer wants to see it. It
// comes by an ordinary request, one after the other, so that a slow phone gets fewer, not older.

const NODE = "/robot/platform/camera/view/picture";
const PERIOD_MS = 600;
const AFTER_FAILURE_MS = 4000;

/** Whether the picture would be seen now. */
function wanted() {
  const node = window.__viserSceneTree?.getState()[NODE];
  return Boolean(node?.effectiveVisibility) && document.visibilityState === "visible";
}

async function refresh() {
  if (!wanted()) return PERIOD_MS;
  const response = await fetch("camera.jpg", { cache: "no-store" });
  if (!response.ok) return AFTER_FAILURE_MS;
  const picture = new Uint8Array(await response.arrayBuffer());
  const props = { _format: "jpeg", _data: picture };
  window.__viserSceneTree?.actions.updateSceneNodeProps(NODE, props);
  window.__viserMutable?.requestRender?.();
  return PERIOD_MS;
}

async function keepFresh() {
  const pause = await refresh().catch(() => AFTER_FAILURE_MS);
  setTimeout(keepFresh, pause);
}
setTimeout(keepFresh, PERIOD_MS);
