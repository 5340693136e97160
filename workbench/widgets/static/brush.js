// Selecting with the mouse: by a rectangle, a lasso or a click.

const CLICK = 4; // a shorter drag is a click

class Brush {
  constructor(view) {
    this.view = view;
    this.drag = null;
  }

  get panel() {
    return this.drag?.panel ?? null;
  }

  press(panel, at, { shiftKey }) {
    const kept = this.view.chosen;
    this.drag = { panel, path: [at], moved: false, before: shiftKey ? kept : [], kept };
  }

  move([x, y]) {
    const { path, panel, before } = this.drag;
    path.push([x, y]);
    this.drag.moved ||= Math.hypot(x - path[0][0], y - path[0][1]) >= CLICK;
    if (!this.drag.moved) return;
    const { cloud } = panel;
    const found = this.view.mode === "lasso" ? cloud.within(path) : cloud.withinBox(path[0], [x, y]);
    this.view.mark(before.length ? [...new Set([...before, ...found])] : found);
  }

  /** The outline to draw in a panel, if any. */
  outline(panel) {
    if (this.panel !== panel || !this.drag.moved) return null;
    const { path } = this.drag;
    if (this.view.mode === "lasso") return path;
    const [[x0, y0], [x1, y1]] = [path[0], path.at(-1)];
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
  }

  release({ shiftKey }) {
    const { panel, path, moved } = this.drag;
    this.drag = null;
    if (moved) return this.view.select(this.view.chosen);
    const sample = panel.cloud.nearest(...path[0]);
    if (shiftKey) this.view.toggle(sample);
    else this.view.select(sample < 0 ? [] : [sample]);
  }

  abandon() {
    const { kept } = this.drag;
    this.drag = null;
    this.view.mark(kept);
  }
}
