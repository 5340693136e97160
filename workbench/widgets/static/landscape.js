// The error landscape of a sample with the ways of optimizers on it: picking, hovering, keys.

const REACH_OF_SAMPLE = 12; // how far from a sample, in pixels, a click still picks it
const LARGEST = 560;
const HINT =
  "Click a sample to pick it, or any other place to keep that place in view; Escape lets it go. " +
  "In the focused plane the arrow keys pick the next sample, up and down go by ten; with Shift " +
  "they move the place. Comma and full stop step back and forward, Space plays.";

class Landscape {
  constructor(model, root, signal) {
    Object.assign(this, { model, root, signal, hovered: null, shown: { step: 0, glide: 1 } });
    const hintId = `wb-hint-${Math.random().toString(36).slice(2)}`;
    this.plane = new Plane(hintId);
    this.stepper = new Stepper(
      (step, glide) => this.showStep(step, glide),
      (step) => this.save("step", step),
      signal,
    );
    this.optimizers = element("div", { class: "wb-bar wb-land-optimizers", role: "group", "aria-label": "Optimizer" });
    this.legend = element("div", { class: "wb-land-legend" });
    this.readout = element("div", { class: "wb-detail wb-land-readout" });
    this.live = element("div", { class: "wb-live", role: "status", "aria-live": "polite" });
    const marks = element("div", { class: "wb-hint", text: "✕ control point · ○ picked sample at its start · ◇ lowest error · ● tried, lower · ◌ tried, not lower" });
    const { bar, text, curve } = this.stepper;
    this.zoom = element("button", { type: "button", text: "Close-up", title: "Map the surroundings of the ways only" });
    this.zoom.addEventListener("click", () => this.save("zoomed", !model.get("zoomed")), { signal });
    const under = element("div", { class: "wb-bar wb-land-under" }, [this.readout, this.zoom]);
    const hint = element("p", { class: "wb-hint", id: hintId, text: HINT });
    root.append(this.plane.plot, under, this.legend, marks, this.optimizers, bar, text, curve, hint, this.live);
    this.read();
    this.tellZoom();
    const shape = ["points", "control_points", "errors", "columns", "extent", "mapped", "error_name", "sample_word"];
    onTraits(model, [...shape, "message", "sample"], () => this.read(), signal);
    onTraits(model, ["traces", "active", "step"], () => this.readTraces(), signal);
    onTraits(model, ["zoomed"], () => this.tellZoom(), signal);
    onTraits(model, ["place"], () => this.announce("place"), signal);
    watchTheme(() => this.resize(true), signal);
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(root);
    signal.addEventListener("abort", () => observer.disconnect());
    this.listen();
  }

  save(name, value) {
    if (JSON.stringify(this.model.get(name)) === JSON.stringify(value)) return;
    this.model.set(name, value);
    this.model.save_changes();
  }

  tellZoom() {
    this.zoom.setAttribute("aria-pressed", String(this.model.get("zoomed")));
  }

  read() {
    const { model } = this;
    const points = typed(model.get("points"), Float32Array);
    const n = points.length / 2;
    const controls = [...typed(model.get("control_points"), Int32Array)].filter((i) => i < n);
    const isControl = new Uint8Array(n);
    for (const i of controls) isControl[i] = 1;
    const columns = model.get("columns");
    let errors = typed(model.get("errors"), Float32Array);
    if (columns < 2 || errors.length % columns || errors.length < 2 * columns) errors = new Float32Array(0);
    const sample = model.get("sample") < n ? model.get("sample") : -1;
    const range = errors.length ? errorRange(errors) : { low: 0, high: 1 };
    const faint = model.get("mapped") !== sample;
    this.state = { points, n, controls, isControl, errors, columns, range, sample, faint, word: model.get("sample_word") };
    this.plane.message.textContent = model.get("message");
    this.legend.replaceChildren(...(errors.length ? heatLegend(range, model.get("error_name")) : []));
    this.plane.plot.setAttribute("aria-label", this.describe());
    this.readTraces();
    this.resize(true);
  }

  describe() {
    const { n, errors, range, columns, sample, word } = this.state;
    const parts = [`Error landscape of ${word} ${sample} over the plane of ${n} ${word}s`];
    if (errors.length) {
      const best = lowestOf(errors);
      const rows = errors.length / columns;
      const [x0, x1, y0, y1] = this.model.get("extent");
      const x = x0 + ((best % columns) / (columns - 1)) * (x1 - x0);
      const y = y0 + (Math.floor(best / columns) / (rows - 1)) * (y1 - y0);
      parts.push(`lowest error ${brief(range.low)} at ${brief(x)}, ${brief(y)}`);
    }
    return [...parts, this.model.get("message")].filter(Boolean).join(", ");
  }

  readTraces() {
    const { model } = this;
    const traces = model.get("traces");
    this.listOptimizers(traces, model.get("active"));
    if (this.stepper.playing && this.stepper.active === model.get("active") && this.stepper.traces === traces) return;
    this.stepper.take(traces, model.get("active"), model.get("step"));
  }

  listOptimizers(traces, active) {
    const key = JSON.stringify([traces.map(({ name, title, message, steps }) => [name, title, message, steps.length, steps.at(-1)?.error]), active]);
    if (key === this.listed) return;
    this.listed = key;
    const focused = this.optimizers.contains(document.activeElement) ? active : null;
    this.optimizers.replaceChildren(...traces.map(({ name, title, steps }, index) => {
      const swatch = element("canvas", { class: "wb-land-swatch", "aria-hidden": "true" });
      const context = fitCanvas(swatch, 26, 10);
      context.beginPath();
      context.moveTo(1, 5);
      context.lineTo(25, 5);
      this.plane.rimmed(context, wayOf(index).colour, 2, wayOf(index).dash);
      const result = steps.length ? ` ${brief(steps[0].error)} → ${brief(steps.at(-1).error)}` : "";
      const node = element("button", { type: "button", "aria-pressed": String(name === active) }, [swatch, element("b", { text: title }), result]);
      node.addEventListener("click", () => this.choose(name), { signal: this.signal });
      if (name === focused) queueMicrotask(() => node.focus());
      return node;
    }));
  }

  choose(name) {
    this.stepper.play(false);
    this.model.set("active", name);
    this.model.set("step", 0);
    this.model.save_changes();
    this.readTraces();
  }

  resize(force = false) {
    const width = Math.min(LARGEST, this.root.clientWidth - 10);
    if (width <= 0 || (!force && width === this.plane.size)) return;
    this.plane.plot.style.width = `${width}px`;
    this.plane.fit(this.plane.plot.clientWidth, this.model.get("extent"));
    this.plane.drawBase(this.state, themeOf(this.root));
    this.stepper.drawCurve();
    this.showStep(this.shown.step, this.shown.glide);
    this.drawTop();
  }

  showStep(step, glide) {
    if (!this.state) return;
    const { sample, points, faint } = this.state;
    const traces = faint ? [] : this.model.get("traces");
    const active = this.model.get("active");
    const count = traces.find(({ name }) => name === active)?.steps.length ?? 0;
    this.shown = { step: Math.min(step, Math.max(0, count - 1)), glide };
    if (!this.plane.size) return;
    const start = sample >= 0 ? [points[2 * sample], points[2 * sample + 1]] : null;
    this.here = this.plane.drawWays({ traces, active, ...this.shown, start, faint });
    if (!this.hovered) this.announce("step");
  }

  /** The place that all views speak of: hovered, else pinned, else where the sample is. */
  announce(reason) {
    const pinned = this.model.get("place");
    const place = this.hovered ?? (pinned.length === 2 ? pinned : this.here);
    this.drawTop();
    this.tellPlace(place);
    announcePlace(this.model.get("channel"), place ?? null, reason);
  }

  tellPlace(place) {
    const { errors, columns } = this.state;
    if (!place) return void (this.readout.textContent = "");
    const [x0, x1, y0, y1] = this.model.get("extent");
    const rows = errors.length / columns;
    const column = Math.round(((place[0] - x0) / (x1 - x0)) * (columns - 1));
    const row = Math.round(((place[1] - y0) / (y1 - y0)) * (rows - 1));
    const known = errors.length && column >= 0 && column < columns && row >= 0 && row < rows;
    const height = known ? ` · error on the map ${brief(errors[row * columns + column])}` : "";
    const { sample, word, isControl } = this.state;
    const picked = sample < 0 ? "" : `${word} ${sample}${isControl[sample] ? " (control point)" : ""} · `;
    this.readout.textContent = `${picked}place ${place.map((v) => v.toFixed(3)).join(", ")}${height}`;
  }

  drawTop() {
    if (!this.plane.size) return;
    const pinned = this.model.get("place");
    this.plane.drawTop(this.hovered ?? (pinned.length === 2 ? pinned : null), !this.hovered);
  }

  pick(sample) {
    const { n, word } = this.state;
    if (!n) return;
    const next = Math.max(0, Math.min(n - 1, sample));
    this.stepper.play(false);
    this.model.set("sample", next);
    this.model.set("step", 0);
    this.model.set("place", []);
    this.model.save_changes();
    this.live.textContent = `${word} ${next}`;
    this.read();
  }

  nearest([px, py]) {
    const { points, n } = this.state;
    let [best, gap] = [-1, REACH_OF_SAMPLE ** 2];
    for (let i = 0; i < n; i++) {
      const [x, y] = this.plane.toPixel([points[2 * i], points[2 * i + 1]]);
      const distance = (x - px) ** 2 + (y - py) ** 2;
      if (distance < gap) [best, gap] = [i, distance];
    }
    return best;
  }

  pin(place) {
    this.save("place", place);
    this.announce("place");
  }

  listen() {
    const { plot, base } = this.plane;
    const on = (type, act) => plot.addEventListener(type, act, { signal: this.signal });
    const at = (event) => {
      const box = base.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    on("pointermove", (event) => {
      this.hovered = this.plane.toPlace(at(event));
      this.announce("hover");
    });
    on("pointerleave", () => {
      this.hovered = null;
      this.announce("leave");
    });
    on("click", (event) => {
      const sample = this.nearest(at(event));
      if (sample >= 0) this.pick(sample);
      else this.pin(this.plane.toPlace(at(event)));
    });
    on("keydown", (event) => this.key(event));
  }

  key(event) {
    const arrows = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const { sample, n } = this.state;
    if (event.key in arrows) {
      const [dx, dy] = arrows[event.key];
      if (event.shiftKey) this.movePlace(dx, dy);
      else this.pick(sample < 0 ? 0 : sample + dx + 10 * dy);
    } else if (event.key === "Home") this.pick(0);
    else if (event.key === "End") this.pick(n - 1);
    else if (event.key === ",") this.stepper.go(this.stepper.step - 1);
    else if (event.key === ".") this.stepper.go(this.stepper.step + 1);
    else if (event.key === " ") this.stepper.play(!this.stepper.playing);
    else if (event.key === "Escape") this.pin([]);
    else return;
    event.preventDefault();
    // JupyterLab would take these keys as commands to its cells.
    event.stopPropagation();
  }

  movePlace(dx, dy) {
    const pinned = this.model.get("place");
    const from = pinned.length === 2 ? pinned : this.here;
    if (!from) return;
    this.hovered = null;
    const { spanX, spanY } = this.plane;
    this.pin([from[0] + (dx * spanX) / 50, from[1] + (dy * spanY) / 50]);
    this.live.textContent = this.readout.textContent;
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-land" });
    el.append(root);
    new Landscape(model, root, stop.signal);
    return () => stop.abort();
  },
};
