// Scatter panels with linked selecting, hovering and moving.

const NARROWEST = 230;
const MOST_COLUMNS = 4;
const CRISP = 5000; // from this many samples on, soft rims cannot be seen

class Scatter {
  constructor(model, root, signal) {
    Object.assign(this, { model, root, signal });
    this.panels = [];
    this.chosen = [];
    this.hovered = -1;
    this.mode = "rectangle";
    this.stage = "final";
    this.mover = new Mover(this);
    this.input = new Input(this);
    this.build();
    this.read();
    onTraits(model, ["panels"], () => this.readPanels(), signal);
    onTraits(model, [...PLACES, ...LOOKS], () => this.read(), signal);
    onTraits(model, ["moved"], () => this.readMoved(), signal);
    onTraits(model, ["selection"], () => this.readSelection(), signal);
    onHover(model, (sample) => this.follow(sample), signal);
    watchTheme(() => this.restyle(), signal);
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(root);
    signal.addEventListener("abort", () => observer.disconnect());
  }

  build() {
    this.toolbar = new Toolbar(this, this.signal);
    this.grid = element("div", { class: "wb-grid" });
    this.legend = element("div", { class: "wb-legend", role: "group", "aria-label": "Legend" });
    this.remark = element("div", { class: "wb-remark", role: "status" });
    this.live = element("div", { class: "wb-live", role: "status", "aria-live": "polite" });
    const hintId = `wb-hint-${Math.random().toString(36).slice(2)}`;
    this.hint = element("p", { class: "wb-hint", id: hintId, text: HINTS.select });
    this.root.append(this.toolbar.node, this.toolbar.line, this.remark, this.grid, this.legend, this.hint, this.live);
  }

  // Reading traits.

  readPanels() {
    const specs = this.model.get("panels");
    if (specs.length !== this.panels.length) return this.read();
    this.state.specs = specs;
    this.mover.isNew.fill(false);
    this.describe();
  }

  read() {
    const before = this.state;
    this.state = readState(this.model);
    // New colours alone must not disturb who is dragging.
    const changed = PLACES.some((name) => before?.views[name] !== this.state.views[name]);
    if (changed || before.panels !== this.state.panels) this.readPlaces(before);
    else if (before.values && this.state.values && !sameNumbers(before.values, this.state.values)) {
      this.valuesPrecedeMoving = false;
    }
    if (!this.state.canMove && this.mode === "move") this.setMode("rectangle");
    this.describe();
    this.restyle();
  }

  readPlaces(before) {
    const { state } = this;
    this.input.abandon();
    this.matchPanels();
    const sameSamples = before?.n === state.n && before.panels === state.panels;
    if (!sameSamples) [this.hovered, this.stage] = [-1, "final"];
    this.chosen = this.readChosen();
    this.valuesPrecedeMoving = false;
    this.mover.read(readMoved(this.model, state), state);
    this.aim(sameSamples);
  }

  matchPanels() {
    while (this.panels.length > this.state.panels) this.panels.pop().figure.remove();
    while (this.panels.length < this.state.panels) {
      const panel = new Panel(this.hint.id);
      this.panels.push(panel);
      this.grid.append(panel.figure);
      this.input.listen(panel);
    }
  }

  readChosen() {
    return [...typed(this.model.get("selection"), Int32Array)].filter((i) => i < this.state.n);
  }

  readSelection() {
    this.mark(this.readChosen());
  }

  readMoved() {
    const moved = readMoved(this.model, this.state);
    if (this.mover.read(moved, this.state)) this.showMoved();
  }

  // Showing.

  shown(p) {
    return shownIn(p, this);
  }

  describe() {
    this.panels.forEach((panel, p) => {
      const { tag, detail } = this.shown(p);
      panel.describe(this.state.specs[p], this.state, tag, detail);
    });
    this.tellSelection();
  }

  /** Send all panels to the positions that they should show. */
  aim(travelling) {
    this.panels.forEach((panel, p) => {
      const { points } = this.shown(p);
      if (sameNumbers(panel.cloud.points, points)) return;
      panel.cloud.aim(points, frameOf(points), travelling && this.duration() > 0);
    });
    this.travel();
  }

  duration() {
    return matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : this.state.duration;
  }

  /** Draw frame by frame until no panel travels any more. */
  travel() {
    if (this.ticking || !this.panels.some((panel) => panel.cloud.travelling)) return;
    this.ticking = true;
    requestAnimationFrame((now) => {
      this.ticking = false;
      if (this.signal.aborted) return;
      for (const panel of this.panels) {
        if (!panel.cloud.travelling) continue;
        panel.cloud.advance(now, this.duration());
        this.drawPanel(panel);
      }
      this.travel();
    });
  }

  showMoved() {
    this.valuesPrecedeMoving = this.mover.anyMoved;
    this.aim(true);
    this.describe();
    this.drawLegend();
    this.travel();
    this.draw();
  }

  setStage(stage) {
    this.stage = stage;
    this.aim(true);
    this.describe();
    this.drawLegend();
    this.say(stage === "raw" ? "positions before optimization" : "optimized positions");
    this.draw();
  }

  setMode(mode) {
    if (this.mover.grip) this.mover.putBack();
    this.mode = mode;
    this.root.classList.toggle("wb-moving", mode === "move");
    this.hint.textContent = mode === "move" ? HINTS.move : HINTS.select;
    this.toolbar.show(this);
  }

  restyle() {
    const { state } = this;
    const { n } = state;
    const theme = themeOf(this.root);
    const radius = n > 8000 ? 1.6 : n > 2000 ? 2.2 : n > 500 ? 2.8 : 3.6;
    this.look = { theme, radius, crisp: n > CRISP, ...colouring(state, theme) };
    this.drawLegend();
    this.resize(true);
  }

  resize(force = false) {
    const width = this.root.clientWidth;
    if (!width || !this.panels.length || (!force && width === this.width)) return;
    if (width !== this.width) this.input.abandon(); // its pixels are others now
    this.width = width;
    const fitting = Math.max(1, Math.min(MOST_COLUMNS, Math.floor(width / NARROWEST)));
    // As many rows as needed, then as few columns as fill them.
    this.columns = Math.ceil(this.panels.length / Math.ceil(this.panels.length / fitting));
    this.grid.style.gridTemplateColumns = `repeat(${this.columns}, minmax(0, 1fr))`;
    const marks = makeMarks(this.look, screenRatio());
    for (const panel of this.panels) panel.fit(panel.plot.clientWidth, marks);
    this.draw();
  }

  draw() {
    for (const panel of this.panels) this.drawPanel(panel);
  }

  drawPanel(panel) {
    if (!panel.raster) return;
    panel.drawBase(this.look.swatchOf[this.panels.indexOf(panel)], this.state.controls);
    panel.drawMarks(this.chosen, this.state.isControl);
    this.drawTop(panel);
  }

  drawTop(panel) {
    if (!panel.raster) return;
    panel.drawTop(this.look, this.hovered, this.mover.heldIn(panel), this.input.outline(panel));
  }

  drawLegend() {
    showLegend(this.legend, legendEntries(this.state, this.look, screenRatio()), (group, adding) => {
      const members = [...this.state.classes.keys()].filter((i) => this.state.classes[i] === group);
      this.select(adding ? [...this.chosen, ...members] : members);
    });
    const remark = remarkOnValues(this);
    if (remark) this.legend.append(element("span", { class: "wb-hint", text: remark }));
  }

  /** Say something to a screen reader. */
  say(text) {
    this.live.textContent = text;
  }

  /** Write a sentence above the panels. */
  note(text) {
    this.remark.textContent = text;
  }

  // Selecting and hovering.

  /** Mark samples as selected, without telling Python yet. */
  mark(samples) {
    this.chosen = samples;
    this.tellSelection();
    for (const panel of this.panels) {
      if (!panel.raster) continue;
      panel.drawMarks(this.chosen, this.state.isControl);
      this.drawTop(panel);
    }
  }

  select(samples) {
    this.mark([...new Set(samples)].sort((a, b) => a - b));
    this.say(this.toolbar.count.textContent || "selection cleared");
    this.model.set("selection", new DataView(Int32Array.from(this.chosen).buffer));
    this.model.save_changes();
  }

  toggle(sample) {
    if (sample < 0) return;
    const others = this.chosen.filter((i) => i !== sample);
    this.select(others.length < this.chosen.length ? others : [...others, sample]);
  }

  tellSelection() {
    this.root.classList.toggle("wb-dimmed", this.chosen.length > 0);
    this.toolbar.show(this);
  }

  hover(sample, panel, spoken = false) {
    const name = sample < 0 ? "" : this.name(sample, panel);
    this.toolbar.hovered.textContent = name;
    if (spoken) this.say(name);
    if (sample === this.hovered) return;
    this.hovered = sample;
    announceHover(this.model.get("channel"), sample);
    this.panels.forEach((each) => this.drawTop(each));
  }

  /** Show the sample that is hovered in another view. */
  follow(sample) {
    if (sample === this.hovered || sample >= this.state.n) return;
    this.hovered = sample;
    this.toolbar.hovered.textContent = sample < 0 ? "" : this.name(sample);
    this.panels.forEach((panel) => this.drawTop(panel));
  }

  name(sample, panel) {
    const { n, classes, names, word, isControl, values, range, colorBy, valueName } = this.state;
    const value = values?.[this.panels.indexOf(panel) * n + sample];
    const parts = [`${word} ${sample}`, names[classes[sample]]];
    if (colorBy === "value" && panel) {
      parts.push(`${valueName} ${Number.isFinite(value) ? brief(value, digitsFor(range)) : "unknown"}`);
    }
    if (isControl[sample]) parts.push("control point");
    return parts.filter(Boolean).join(" · ");
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
