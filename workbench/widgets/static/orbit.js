// How a person turns and zooms figures: by mouse, by keys and by buttons.

const TURN_PER_PIXEL = 0.01;
const TURNS = { ArrowLeft: [-0.15, 0], ArrowRight: [0.15, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
const ZOOM_STEP = 1.25;
const ORBIT_HINT = "Drag, or use the arrow keys, to turn; wheel, + or − to zoom.";

/** Let dragging turn and the wheel zoom what a canvas shows; `figures` gives them. */
function orbitByMouse(canvas, figures, redraw, signal) {
  const on = (type, act, options = {}) => canvas.addEventListener(type, act, { signal, ...options });
  let from = null;
  on("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    from = [event.clientX, event.clientY];
  });
  for (const type of ["pointerup", "pointercancel"]) on(type, () => (from = null));
  on("pointermove", (event) => {
    if (!from || !event.buttons || !figures()) return;
    figures().turnBy((event.clientX - from[0]) * TURN_PER_PIXEL, (event.clientY - from[1]) * TURN_PER_PIXEL);
    from = [event.clientX, event.clientY];
    redraw();
  });
  on("wheel", (event) => {
    // Only where the person is at work here: elsewhere the wheel scrolls the page.
    if ((document.activeElement !== canvas && !event.ctrlKey) || !figures()) return;
    event.preventDefault();
    figures().zoomBy(1.0015 ** -event.deltaY);
    redraw();
  }, { passive: false });
}

/** Turn or zoom as a key says; tell whether it was one that does. */
function orbitByKey(event, figures) {
  if (event.metaKey || event.altKey || event.ctrlKey || !figures) return false;
  if (event.key in TURNS) figures.turnBy(...TURNS[event.key]);
  else if (event.key === "+") figures.zoomBy(ZOOM_STEP);
  else if (event.key === "-") figures.zoomBy(1 / ZOOM_STEP);
  else if (event.key === "0") figures.resetView();
  else return false;
  // JupyterLab would take the key as a command to its cells.
  event.stopPropagation();
  event.preventDefault();
  return true;
}

/** Buttons that zoom, and one that looks as at first. */
function orbitButtons(figures, redraw, signal) {
  const button = (text, label, act) => {
    const node = element("button", { type: "button", text, "aria-label": label, title: label });
    node.addEventListener("click", () => {
      if (!figures()) return;
      act(figures());
      redraw();
    }, { signal });
    return node;
  };
  return element("span", { class: "wb-group", role: "group", "aria-label": "View" }, [
    button("−", "Zoom out", (shown) => shown.zoomBy(1 / ZOOM_STEP)),
    button("+", "Zoom in", (shown) => shown.zoomBy(ZOOM_STEP)),
    button("Reset view", "Reset view", (shown) => shown.resetView()),
  ]);
}
