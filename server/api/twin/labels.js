// Hides words that would stand on others. Of two that meet, the one of the layer that was chosen
// last stays, otherwise that of the layer further up in the list; warnings always stay.

const ROOM_PX = 2;
const ROOM_TO_COME_BACK_PX = 8;
const HEIGHT_PX = 16;
const PX_PER_LETTER = 6.2;
const PERIOD_MS = 200;

/** Labels that are hidden here, and by nobody else. */
const hidden = new Set();

const parentOf = (name) => name.slice(0, name.lastIndexOf("/"));

/** How soon a label gets its place; what belongs to no layer warns and always gets one. */
function rankOf(name) {
  const layer = LAYERS.findIndex(({ nodes }) => nodes.some((node) => name.startsWith(`${node}/`)));
  if (layer < 0) return -Infinity;
  const { chosenAt } = LAYERS[layer];
  return chosenAt ? -chosenAt : layer;
}

/** A 4x4 matrix, column by column, times a vector. */
function times(m, [x, y, z, w]) {
  return [0, 1, 2, 3].map((i) => m[i] * x + m[4 + i] * y + m[8 + i] * z + m[12 + i] * w);
}

/** Where a label is on the screen; null behind the viewer or while nobody knows. */
function placeOf(name, mutable, canvas) {
  const parent = mutable.nodeRefFromName[parentOf(name)];
  const at = mutable.nodePoseData[name]?.position;
  if (!parent || !at) return null;
  const { matrixWorldInverse, projectionMatrix } = mutable.camera;
  const world = times(parent.matrixWorld.elements, [...at, 1]);
  const [x, y, , w] = times(projectionMatrix.elements, times(matrixWorldInverse.elements, world));
  if (w <= 0) return null;
  return [((1 + x / w) / 2) * canvas.clientWidth, ((1 - y / w) / 2) * canvas.clientHeight];
}

/** The box that a label covers: left, top, right, bottom. */
function boxOf({ text, anchor }, [x, y]) {
  const width = text.length * PX_PER_LETTER + 6;
  const left = anchor.endsWith("left") ? 0 : anchor.endsWith("right") ? 1 : 0.5;
  const top = anchor.startsWith("top") ? 0 : anchor.startsWith("bottom") ? 1 : 0.5;
  return [x - left * width, y - top * HEIGHT_PX, x + (1 - left) * width, y + (1 - top) * HEIGHT_PX];
}

const meet = (a, b, room) =>
  a[0] < b[2] + room && b[0] < a[2] + room && a[1] < b[3] + room && b[1] < a[3] + room;

/** What is to be read now, the most important first. */
function wanted(nodes) {
  return Object.values(nodes)
    .filter((node) => node?.message?.type === "LabelMessage" && node.message.props.text)
    .filter(({ message }) => nodes[parentOf(message.name)]?.effectiveVisibility !== false)
    .map(({ message }) => ({ ...message, rank: rankOf(message.name) }))
    .sort((a, b) => a.rank - b.rank);
}

function declutter() {
  const tree = window.__viserSceneTree;
  const mutable = window.__viserMutable;
  const canvas = document.querySelector("canvas");
  if (!tree || !mutable?.camera || !canvas) return;
  const taken = [];
  for (const { name, props, rank } of wanted(tree.getState())) {
    const at = placeOf(name, mutable, canvas);
    if (at === null) continue;
    const box = boxOf(props, at);
    const room = hidden.has(name) ? ROOM_TO_COME_BACK_PX : ROOM_PX;
    const hide = Number.isFinite(rank) && taken.some((other) => meet(box, other, room));
    if (!hide) taken.push(box);
    if (hide === hidden.has(name)) continue;
    if (hide) hidden.add(name);
    else hidden.delete(name);
    tree.actions.updateNodeAttributes(name, { overrideVisibility: hide ? false : undefined });
    mutable.requestRender?.();
  }
}
setInterval(declutter, PERIOD_MS);
