// What is laid over the picture, switched by each viewer for himself. LAYERS names the layers and
// their nodes; the server never touches the visibility of these nodes after the beginning.

const KEPT_AS = "plugpilot.twin.layers";
const LOOK_AGAIN_MS = 250;

/** The viewer's own choice by layer, as far as there is one; a browser may refuse to keep it. */
const chosen = (() => {
  try {
    return JSON.parse(localStorage.getItem(KEPT_AS)) ?? {};
  } catch {
    return {};
  }
})();

const isOn = (layer) => chosen[layer.id] ?? layer.on;

/** Tells the client's store; nodes that come (again) later are told when they are there. */
function apply() {
  const tree = window.__viserSceneTree;
  if (!tree) return;
  const nodes = tree.getState();
  for (const layer of LAYERS) {
    const visible = isOn(layer);
    for (const name of layer.nodes) {
      if (nodes[name] && nodes[name].overrideVisibility !== visible) {
        tree.actions.updateNodeAttributes(name, { overrideVisibility: visible });
        window.__viserMutable?.requestRender?.();
      }
    }
  }
}
setInterval(apply, LOOK_AGAIN_MS);

function choose(layer, visible) {
  chosen[layer.id] = visible;
  layer.chosenAt = visible ? performance.now() : 0;
  try {
    localStorage.setItem(KEPT_AS, JSON.stringify(chosen));
  } catch {
    // It holds for this visit then.
  }
  apply();
}

function element(tag, attributes, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

function row(layer) {
  const box = element("input", { type: "checkbox", role: "switch", "data-layer": layer.id });
  box.checked = isOn(layer);
  box.addEventListener("change", () => choose(layer, box.checked));
  return element("label", {}, element("span", {}, layer.title), box);
}

/** Looks at the plug from close by, or at everything again. */
function look(at) {
  const mutable = window.__viserMutable;
  const plug = mutable?.nodeRefFromName?.["/robot/platform/plug"];
  if (at === "plug" && plug && mutable.cameraControl) {
    const [x, y, z] = plug.matrixWorld.elements.slice(12, 15);
    mutable.cameraControl.setLookAt(x - 0.42, y + 0.3, z - 0.55, x + 0.02, y - 0.02, z, true);
  } else {
    mutable?.resetCameraPose?.(true);
  }
}

function button(title, text, action) {
  const made = element("button", { type: "button", title }, text);
  made.addEventListener("click", action);
  return made;
}

addEventListener("DOMContentLoaded", () => {
  const list = element("div", { id: "layers", hidden: "" }, ...LAYERS.map(row));
  const layers = button("Choose what is shown", "Layers", () => {
    list.hidden = !list.hidden;
    layers.setAttribute("aria-expanded", String(!list.hidden));
  });
  layers.setAttribute("aria-expanded", "false");
  layers.setAttribute("aria-controls", "layers");
  const bar = element(
    "div",
    { id: "twin-bar" },
    layers,
    button("Look at the plug", "Plug", () => look("plug")),
    button("Look at everything", "Whole", () => look("whole")),
  );
  document.body.append(element("div", { id: "twin-controls" }, list, bar));
  document.addEventListener("pointerdown", (event) => {
    if (list.hidden || event.target.closest("#twin-controls")) return;
    layers.click();
  });
});
