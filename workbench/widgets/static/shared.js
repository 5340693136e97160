// What all views share. It is put before each view's own module (see module.py).

// Okabe and Ito's colours, which stay apart for colour-blind readers; on a dark ground the
// dark ones are lightened, and on a light one yellow is darkened until it can be seen.
const PALETTES = {
  light: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b07d00", "#3aa6dd", "#4d4d4d", "#c9b400"],
  dark: ["#4da6e0", "#ff8540", "#2fc79a", "#e39cc3", "#e69f00", "#8fd3ff", "#c4c4c4", "#f0e442"],
};
// Beyond eight classes the shape changes, so that no two classes look alike.
const SHAPES = ["circle", "square", "triangle", "diamond"];
const TIME_STOPS = {
  light: [[213, 62, 20], [20, 150, 90], [30, 80, 190]],
  dark: [[255, 120, 80], [60, 205, 140], [120, 160, 255]],
};
const HOVER = "workbench-hover";

/** Copy a binary trait into a typed array; the bytes may start at any offset. */
function typed(view, Type) {
  if (!view) return new Type(0);
  const start = view.byteOffset ?? 0;
  const buffer = view.buffer ?? view;
  return new Type(buffer.slice(start, start + view.byteLength));
}

/** Colours of the surroundings, as resolved by the browser from the style sheet. */
function themeOf(root) {
  const style = getComputedStyle(root);
  const [r, g, b] = (style.backgroundColor.match(/[\d.]+/g) ?? ["255", "255", "255"]).map(Number);
  const name = 0.299 * r + 0.587 * g + 0.114 * b < 128 ? "dark" : "light";
  return { name, text: style.color, ground: style.backgroundColor, palette: PALETTES[name] };
}

/** Call back when JupyterLab or the system changes between light and dark. */
function watchTheme(callback, signal) {
  const observer = new MutationObserver(callback);
  observer.observe(document.body, {
    attributes: true,
    attributeFilter: ["data-jp-theme-name", "data-jp-theme-light", "class", "style"],
  });
  const system = matchMedia("(prefers-color-scheme: dark)");
  system.addEventListener("change", callback, { signal });
  signal.addEventListener("abort", () => observer.disconnect());
}

/** Tell the other views on the channel which sample is hovered; -1 means none. */
function announceHover(channel, sample) {
  document.dispatchEvent(new CustomEvent(HOVER, { detail: { channel, sample } }));
}

function onHover(model, callback, signal) {
  document.addEventListener(
    HOVER,
    ({ detail }) => detail.channel === model.get("channel") && callback(detail.sample),
    { signal },
  );
}

/** Call back once after any of these traits changed, however many changed together. */
function onTraits(model, names, callback, signal) {
  let waiting = false;
  const later = () => {
    if (waiting) return;
    waiting = true;
    queueMicrotask(() => {
      waiting = false;
      if (!signal.aborted) callback();
    });
  };
  for (const name of names) model.on(`change:${name}`, later);
  signal.addEventListener("abort", () => {
    for (const name of names) model.off?.(`change:${name}`, later);
  });
}

/** Make an element: element("p", {class: "hint", text: "…"}, children). */
function element(tag, attributes = {}, children = []) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "text") node.textContent = value;
    else if (value !== undefined) node.setAttribute(name, value);
  }
  node.append(...children);
  return node;
}

/** Fill a bar in the colour of a side of the body; that of the right is open, as its limbs are. */
function fillSide(context, side, theme, x, y, width, height) {
  context.fillStyle = { left: theme.palette[0], right: theme.palette[1] }[side] ?? theme.text;
  context.fillRect(x, y, width, height);
  if (side !== "right" || width <= 3) return;
  context.fillStyle = theme.ground;
  context.fillRect(x + 1.5, y + 1.5, width - 3, height - 3);
}

/** Give a canvas the pixels of its box and a context in CSS pixels. */
function fitCanvas(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.max(1, Math.round(width * ratio));
  canvas.height = Math.max(1, Math.round(height * ratio));
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return context;
}
