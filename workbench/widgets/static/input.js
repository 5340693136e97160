// What mouse and keyboard do in the panels: select, hover, or move control points.

const ARROWS = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End"];

const HINTS = {
  select:
    "Drag or click to select, Shift adds, Escape clears. In a focused panel the arrow keys move " +
    "from sample to sample, up and down by ten; Enter or Space selects.",
  move:
    "Drag a cross: the other samples follow. In a focused panel the arrow keys lead from one " +
    "control point to the next; Enter picks it up, the arrow keys move it (Shift: by one pixel), " +
    "Enter drops it, Escape puts it back.",
};

class Input {
  constructor(view) {
    this.view = view;
    this.brush = new Brush(view);
    this.tool = null; // what the mouse drags with
  }

  /** The outline of the selection that is being drawn in a panel, if any. */
  outline(panel) {
    return this.tool === this.brush ? this.brush.outline(panel) : null;
  }

  get moving() {
    return this.view.mode === "move";
  }

  listen(panel) {
    const { view } = this;
    const { mover } = view;
    const on = (type, act) => panel.plot.addEventListener(type, act, { signal: view.signal });
    const at = (event) => {
      const box = panel.base.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    on("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.capture(panel, event.pointerId);
      this.tool = this.moving ? mover : this.brush;
      this.tool.press(panel, at(event), event);
    });
    on("pointermove", (event) => {
      const [x, y] = at(event);
      if (this.tool?.panel === panel) this.tool.move([x, y]);
      else if (!mover.grip) view.hover(this.under(panel, x, y), panel);
    });
    on("pointerup", (event) => {
      const { tool } = this;
      if (tool?.panel !== panel) return;
      this.tool = null;
      tool.release(event);
    });
    on("pointercancel", () => this.abandon());
    on("pointerleave", () => !this.tool && !mover.grip && view.hover(-1, panel));
    on("blur", () => mover.grip && !this.tool && mover.drop());
    on("keydown", (event) => {
      if (!this.key(event, panel)) return;
      event.preventDefault();
      // JupyterLab would take Enter, Escape and the arrows as commands to its cells.
      event.stopPropagation();
    });
  }

  /** The sample under the mouse; in the mode that moves them, a control point before others. */
  under(panel, x, y) {
    const control = this.moving ? panel.cloud.nearest(x, y, this.view.state.controls) : -1;
    return control < 0 ? panel.cloud.nearest(x, y) : control;
  }

  capture(panel, pointer) {
    try {
      panel.plot.setPointerCapture(pointer);
    } catch (error) {
      // A pointer that is already gone cannot be captured; the drag works without.
      if (error.name !== "NotFoundError") throw error;
    }
  }

  /** Give up what is being dragged, and leave things as they were. */
  abandon() {
    const { tool } = this;
    this.tool = null;
    if (tool) tool.abandon();
    else this.view.mover.abandon();
  }

  /** Do what a key says; give whether it said something. */
  key(event, panel) {
    const { view } = this;
    const { key } = event;
    if (this.moving && view.mover.key(event, panel)) return true;
    if (key === "Escape" && (this.tool || view.mover.grip)) this.abandon();
    else if (key === "Escape") view.select([]);
    else if (key === "Enter" || key === " ") view.toggle(view.hovered);
    else if (!ARROWS.includes(key)) return false;
    else if (view.state.n) view.hover(stepped(key, view.hovered, view.state.n), panel, true);
    return true;
  }
}

/** Where a key leads in a list from a place in it (-1: none yet). */
function stepped(key, at, length) {
  const steps = { ArrowRight: 1, ArrowLeft: -1, ArrowUp: 10, ArrowDown: -10 };
  const ends = { Home: 0, End: length - 1 };
  const next = ends[key] ?? (at < 0 ? 0 : at + steps[key]);
  return Math.max(0, Math.min(length - 1, next));
}
