// Scatter panels with linked selecting and hovering, their tool bar and their legend.

const CLICK = 4; // a shorter drag is a click
const NARROWEST = 230;
const CRISP = 5000; // from this many samples on, soft rims cannot be seen
const HINT =
  "Drag or click to select, Shift adds, Escape clears. In a focused panel the arrow keys move " +
  "from sample to sample, up and down by ten; Enter or Space selects.";

class Scatter {
  constructor(model, root, signal) {
    this.model = model;
    this.root = root;
    this.signal = signal;
    this.panels = [];
    this.chosen = [];
    this.hovered = -1;
    this.mode = "rectangle";
    this.build();
    this.readData();
    onTraits(model, ["panels"], () => this.readPanels(), signal);
    const data = ["points", "classes", "class_names", "color_by", "control_points", "sample_word"];
    onTraits(model, data, () => this.readData(), signal);
    onTraits(model, ["selection"], () => this.readSelection(), signal);
    watchTheme(() => this.restyle(), signal);
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(root);
    signal.addEventListener("abort", () => observer.disconnect());
  }

  build() {
    const button = (text, act, pressed) => {
      const node = element("button", { type: "button", text, "aria-pressed": pressed });
      node.addEventListener("click", act, { signal: this.signal });
      return node;
    };
    const choose = (mode) => () => {
      this.mode = mode;
      this.rectangle.setAttribute("aria-pressed", String(mode === "rectangle"));
      this.lasso.setAttribute("aria-pressed", String(mode === "lasso"));
    };
    this.rectangle = button("Rectangle", choose("rectangle"), "true");
    this.lasso = button("Lasso", choose("lasso"), "false");
    this.clearing = button("Clear selection", () => this.select([]));
    this.count = element("span", { class: "wb-count" });
    this.hoverText = element("span", { class: "wb-hover" });
    const shapes = element("span", { class: "wb-group", role: "group", "aria-label": "Shape of the selection" }, [this.rectangle, this.lasso]);
    const bar = element("div", { class: "wb-bar" }, [shapes, this.clearing, this.count, this.hoverText]);
    this.grid = element("div", { class: "wb-grid" });
    this.legend = element("div", { class: "wb-legend", role: "group", "aria-label": "Legend" });
    this.live = element("div", { class: "wb-live", role: "status", "aria-live": "polite" });
    const hintId = `wb-hint-${Math.random().toString(36).slice(2)}`;
    this.hint = element("p", { class: "wb-hint", id: hintId, text: HINT });
    this.root.append(bar, this.grid, this.legend, this.hint, this.live);
  }

  readPanels() {
    const specs = this.model.get("panels");
    if (specs.length !== this.panels.length) return this.readData();
    const { n, word } = this.state;
    this.panels.forEach((panel, i) => panel.describe(specs[i], n, word));
  }

  readData() {
    const specs = this.model.get("panels");
    while (this.panels.length > specs.length) this.panels.pop().figure.remove();
    while (this.panels.length < specs.length) {
      const panel = new Panel(this.hint.id);
      this.panels.push(panel);
      this.grid.append(panel.figure);
      this.listen(panel);
    }
    this.points = typed(this.model.get("points"), Float32Array);
    this.state = {
      n: specs.length ? Math.floor(this.points.length / 2 / specs.length) : 0,
      classes: typed(this.model.get("classes"), Int32Array),
      names: this.model.get("class_names") ?? [],
      colorBy: this.model.get("color_by"),
      word: this.model.get("sample_word") || "sample",
    };
    const { n, classes } = this.state;
    if (classes.length !== n && this.state.colorBy === "class") this.state.colorBy = "none";
    this.controls = [...typed(this.model.get("control_points"), Int32Array)].filter((i) => i < n);
    this.isControl = new Uint8Array(n);
    for (const i of this.controls) this.isControl[i] = 1;
    if (this.hovered >= n) this.hovered = -1;
    this.chosen = [...typed(this.model.get("selection"), Int32Array)].filter((i) => i < n);
    this.readPanels();
    this.restyle();
  }

  readSelection() {
    const { n } = this.state;
    this.chosen = [...typed(this.model.get("selection"), Int32Array)].filter((i) => i < n);
    this.tellSelection();
    this.drawMarks();
  }

  restyle() {
    const theme = themeOf(this.root);
    const { n } = this.state;
    const radius = n > 8000 ? 1.6 : n > 2000 ? 2.2 : n > 500 ? 2.8 : 3.6;
    const { swatchOf, swatches } = colouring(this.state, theme);
    const dots = swatches.map(([colour, shape]) => makeDot(colour, shape, radius, n > CRISP));
    this.look = { theme, radius, swatchOf, swatches, dots, cross: makeCross(theme) };
    this.drawLegend();
    this.resize(true);
  }

  resize(force = false) {
    const width = this.root.clientWidth;
    if (!width || !this.panels.length || (!force && width === this.width)) return;
    this.width = width;
    const count = this.panels.length;
    const fitting = Math.floor(width / NARROWEST);
    const columns = fitting >= count ? count : Math.max(1, Math.min(2, fitting));
    this.grid.style.gridTemplateColumns = `repeat(${columns}, minmax(0, 1fr))`;
    this.panels.forEach((panel, p) => {
      const { n } = this.state;
      panel.place(this.points.subarray(2 * p * n, 2 * (p + 1) * n), panel.plot.clientWidth);
      panel.drawBase(this.look, this.controls);
    });
    this.tellSelection();
    this.drawMarks();
  }

  drawMarks() {
    for (const panel of this.panels) {
      if (panel.size) panel.drawMarks(this.look, this.chosen, this.isControl);
    }
    this.drawTop();
  }

  drawTop() {
    for (const panel of this.panels) {
      if (!panel.size) continue;
      const outline = this.drag?.panel === panel && this.drag.moved ? this.outline() : null;
      panel.drawTop(this.look, this.hovered, outline);
    }
  }

  drawLegend() {
    const { names, classes, colorBy, word } = this.state;
    const items = [];
    if (colorBy === "class") {
      names.forEach((name, group) => {
        const mark = this.legendMark(makeDot(...this.look.swatches[group], 4));
        const item = element("button", { type: "button", title: `Select all of class ${name}` }, [mark, name]);
        item.addEventListener("click", ({ shiftKey }) => {
          const members = [];
          classes.forEach((c, i) => c === group && members.push(i));
          this.select(shiftKey ? [...this.chosen, ...members] : members);
        }, { signal: this.signal });
        items.push(item);
      });
    }
    if (colorBy === "time") {
      const stops = TIME_STOPS[this.look.theme.name].map((c) => `rgb(${c.join(" ")})`);
      const ramp = element("i", { style: `background: linear-gradient(to right, ${stops.join(", ")})` });
      items.push(element("span", { class: "wb-ramp" }, [`first ${word}`, ramp, "last"]));
    }
    if (this.controls.length) {
      const text = `control point (${this.controls.length})`;
      items.push(element("span", { class: "wb-mark" }, [this.legendMark(this.look.cross), text]));
    }
    this.legend.replaceChildren(...items);
  }

  /** Show a mark in the legend as it is in the panels. */
  legendMark(sprite) {
    const canvas = element("canvas", { "aria-hidden": "true", style: "width: 14px; height: 14px" });
    const context = fitCanvas(canvas, 14, 14);
    const raster = new Raster(context);
    raster.stamp(raster.fit(sprite), raster.place(7, 7));
    context.putImageData(raster.image, 0, 0);
    return canvas;
  }

  // Selecting and hovering.

  select(samples) {
    this.chosen = [...new Set(samples)].sort((a, b) => a - b);
    this.tellSelection();
    this.live.textContent = this.count.textContent || "selection cleared";
    this.drawMarks();
    this.model.set("selection", new DataView(Int32Array.from(this.chosen).buffer));
    this.model.save_changes();
  }

  tellSelection() {
    const { n, word } = this.state;
    const count = this.chosen.length;
    this.root.classList.toggle("wb-dimmed", count > 0);
    this.clearing.disabled = count === 0;
    this.count.textContent = count ? `${count} of ${n} ${word}s selected` : "";
  }

  hover(sample, spoken = false) {
    if (sample === this.hovered) return;
    this.hovered = sample;
    this.hoverText.textContent = sample < 0 ? "" : this.name(sample);
    if (spoken) this.live.textContent = this.name(sample);
    announceHover(this.model.get("channel"), sample);
    this.drawTop();
  }

  name(sample) {
    const { classes, names, word } = this.state;
    const parts = [`${word} ${sample}`, names[classes[sample]]];
    if (this.isControl[sample]) parts.push("control point");
    return parts.filter(Boolean).join(" · ");
  }

  listen(panel) {
    const on = (type, act) => panel.plot.addEventListener(type, act, { signal: this.signal });
    const at = (event) => {
      const box = panel.base.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    on("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.capture(panel, event.pointerId);
      const before = event.shiftKey ? this.chosen : [];
      this.drag = { panel, path: [at(event)], moved: false, before, kept: this.chosen };
    });
    on("pointermove", (event) => {
      const [x, y] = at(event);
      if (this.drag?.panel === panel) this.brush(x, y);
      else this.hover(panel.nearest(x, y));
    });
    on("pointerup", (event) => this.release(panel, event));
    on("pointercancel", () => this.abandon());
    on("pointerleave", () => !this.drag && this.hover(-1));
    on("keydown", (event) => this.key(event));
  }

  capture(panel, pointer) {
    try {
      panel.plot.setPointerCapture(pointer);
    } catch (error) {
      // A pointer that is already gone cannot be captured; the drag works without.
      if (error.name !== "NotFoundError") throw error;
    }
  }

  brush(x, y) {
    const { path, panel } = this.drag;
    path.push([x, y]);
    this.drag.moved ||= Math.hypot(x - path[0][0], y - path[0][1]) >= CLICK;
    if (!this.drag.moved) return;
    const { before } = this.drag;
    const lasso = this.mode === "lasso";
    const found = lasso ? panel.within(path) : panel.withinBox(path[0], [x, y]);
    this.chosen = before.length ? [...new Set([...before, ...found])] : found;
    this.tellSelection();
    this.drawMarks();
  }

  outline() {
    const { path } = this.drag;
    if (this.mode === "lasso") return path;
    const [[x0, y0], [x1, y1]] = [path[0], path.at(-1)];
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
  }

  release(panel, event) {
    const drag = this.drag;
    if (drag?.panel !== panel) return;
    this.drag = null;
    if (drag.moved) return this.select(this.chosen);
    const sample = panel.nearest(...drag.path[0]);
    if (event.shiftKey) this.toggle(sample);
    else this.select(sample < 0 ? [] : [sample]);
  }

  abandon() {
    if (!this.drag) return;
    this.chosen = this.drag.kept;
    this.drag = null;
    this.tellSelection();
    this.drawMarks();
  }

  toggle(sample) {
    if (sample < 0) return;
    const others = this.chosen.filter((i) => i !== sample);
    this.select(others.length < this.chosen.length ? others : [...others, sample]);
  }

  key(event) {
    const { n } = this.state;
    const steps = { ArrowRight: 1, ArrowLeft: -1, ArrowUp: 10, ArrowDown: -10 };
    const ends = { Home: 0, End: n - 1 };
    if (event.key === "Escape") {
      if (this.drag) this.abandon();
      else this.select([]);
    } else if (event.key === "Enter" || event.key === " ") this.toggle(this.hovered);
    else if (event.key in steps || event.key in ends) {
      const next = ends[event.key] ?? (this.hovered < 0 ? 0 : this.hovered + steps[event.key]);
      if (n > 0) this.hover(Math.max(0, Math.min(n - 1, next)), true);
    } else return;
    event.preventDefault();
    // JupyterLab would take Enter, Escape and the arrows as commands to its cells.
    event.stopPropagation();
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-scatter" });
    el.append(root);
    new Scatter(model, root, stop.signal);
    return () => stop.abort();
  },
};
