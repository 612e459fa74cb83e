// Tells the page around this frame where somebody has clicked, as a line of sight in the base frame
// [mm], if that page asked for it by ?pick in the address. It never reaches the 3D server: what
// becomes of it is the page's business.
if (new URLSearchParams(location.search).has("pick") && parent !== window) {
  const STEADY_PX = 6;
  const QUICK_MS = 600;
  const MM_PER_METRE = 1000;
  let down = null;

  /** A 4x4 matrix, column by column, times a vector. */
  const times = (m, [x, y, z, w]) =>
    [0, 1, 2, 3].map((i) => m[i] * x + m[4 + i] * y + m[8 + i] * z + m[12 + i] * w);

  /** A vector turned by the transpose of a matrix's rotation: from the world to the node. */
  const turnedBack = (m, [x, y, z]) =>
    [0, 1, 2].map((i) => m[4 * i] * x + m[4 * i + 1] * y + m[4 * i + 2] * z);

  /** The line of sight through a place on the canvas; null while nobody knows. */
  function sight(event, canvas) {
    const { camera, nodeRefFromName } = window.__viserMutable ?? {};
    const base = nodeRefFromName?.["/rails"];
    if (!camera || !base) return null;
    const box = canvas.getBoundingClientRect();
    const x = (2 * (event.clientX - box.left)) / box.width - 1;
    const y = 1 - (2 * (event.clientY - box.top)) / box.height;
    const inCamera = times(camera.projectionMatrixInverse.elements, [x, y, 0.5, 1]);
    const [fx, fy, fz, fw] = times(camera.matrixWorld.elements, inCamera);
    const from = camera.matrixWorld.elements.slice(12, 15);
    const along = [fx / fw - from[0], fy / fw - from[1], fz / fw - from[2]];
    const length = Math.hypot(...along);
    if (!(length > 0)) return null;
    const world = base.matrixWorld.elements;
    const origin = turnedBack(world, [0, 1, 2].map((i) => from[i] - world[12 + i]));
    const direction = turnedBack(world, along).map((each) => each / length);
    return { origin_mm: origin.map((each) => each * MM_PER_METRE), direction };
  }

  addEventListener(
    "pointerdown",
    (event) => {
      const usable = event.isPrimary && event.button === 0 && event.target.tagName === "CANVAS";
      down = usable ? { x: event.clientX, y: event.clientY, at: event.timeStamp } : null;
    },
    true,
  );
  addEventListener(
    "pointerup",
    (event) => {
      const began = down;
      down = null;
      if (!began || event.target.tagName !== "CANVAS") return;
      const moved = Math.hypot(event.clientX - began.x, event.clientY - began.y);
      if (moved > STEADY_PX || event.timeStamp - began.at > QUICK_MS) return;
      const found = sight(event, event.target);
      if (found) parent.postMessage({ twin: "picked", ...found }, location.origin);
    },
    true,
  );
}
