// The plane: the heat map with the samples on it, the ways of optimizers, and what follows the
// mouse, on a canvas each. Marks are white or coloured with a dark rim, to be seen on all depths.

const RIM = "rgb(10 10 30)";
const FAINT_RIM = "rgb(10 10 30 / 0.55)"; // under dashes, which a dark line would drown
const CORE = "#ffffff";
// Told apart on all depths by lightness and by dashes, not by hue alone.
const WAYS = [
  { colour: "#ffffff", dash: [] },
  { colour: "#ff9e4a", dash: [9, 3] },
  { colour: "#ff7fd0", dash: [3, 2] },
  { colour: "#8fe3ff", dash: [10, 3, 2, 3] },
];
const wayOf = (index) => WAYS[index % WAYS.length];

class Plane {
  constructor(describedBy) {
    const layer = (name) => element("canvas", { class: name, "aria-hidden": "true" });
    this.base = layer("wb-land-base");
    this.ways = layer("wb-land-ways");
    this.top = layer("wb-land-top");
    this.message = element("div", { class: "wb-message" });
    this.plot = element("div", {
      class: "wb-plot wb-land-plot", tabindex: "0", role: "application", "aria-describedby": describedBy,
    }, [this.base, this.ways, this.top, this.message]);
    this.size = 0;
  }

  /** Take a width in pixels and the square of the plane that is shown. */
  fit(size, [x0, x1, y0, y1]) {
    this.size = size;
    Object.assign(this, { x0, y0, spanX: x1 - x0 || 1, spanY: y1 - y0 || 1 });
  }

  toPixel([x, y]) {
    return [((x - this.x0) / this.spanX) * this.size, (1 - (y - this.y0) / this.spanY) * this.size];
  }

  toPlace([px, py]) {
    return [this.x0 + (px / this.size) * this.spanX, this.y0 + (1 - py / this.size) * this.spanY];
  }

  drawBase({ points, controls, isControl, errors, columns, range, faint }, theme) {
    const context = fitCanvas(this.base, this.size, this.size);
    if (errors.length) {
      paintHeatMap(context, errors, columns, range);
      this.drawContours(context, errors, columns, range);
      this.drawLowest(context, errors, columns);
    }
    this.base.style.opacity = faint ? "0.35" : "1";
    const n = points.length / 2;
    const radius = n > 2000 ? 1.4 : n > 500 ? 2 : 2.8;
    const onMap = errors.length > 0;
    context.lineWidth = 1;
    context.strokeStyle = onMap ? RIM : theme.ground;
    context.fillStyle = onMap ? "rgb(255 255 255 / 0.85)" : theme.palette[0];
    for (let i = 0; i < n; i++) {
      if (isControl[i]) continue;
      const [x, y] = this.toPixel([points[2 * i], points[2 * i + 1]]);
      context.beginPath();
      context.arc(x, y, radius, 0, 2 * Math.PI);
      context.fill();
      if (n <= 2000) context.stroke();
    }
    for (const i of controls) this.drawCross(context, [points[2 * i], points[2 * i + 1]]);
  }

  drawCross(context, place) {
    const [x, y] = this.toPixel(place);
    context.beginPath();
    for (const slope of [1, -1]) {
      context.moveTo(x - 4, y - 4 * slope);
      context.lineTo(x + 4, y + 4 * slope);
    }
    context.lineCap = "round";
    this.rimmed(context, CORE, 1.8);
  }

  drawContours(context, errors, columns, range) {
    const rows = errors.length / columns;
    const at = ([u, v]) => [(u / (columns - 1)) * this.size, (1 - v / (rows - 1)) * this.size];
    context.beginPath();
    for (const level of contourLevels(range)) {
      for (const [from, to] of contourSegments(errors, columns, level)) {
        context.moveTo(...at(from));
        context.lineTo(...at(to));
      }
    }
    context.strokeStyle = "rgb(255 255 255 / 0.35)";
    context.lineWidth = 0.8;
    context.stroke();
  }

  /** Mark the lowest error of the grid by a diamond. */
  drawLowest(context, errors, columns) {
    const rows = errors.length / columns;
    const best = lowestOf(errors);
    const x = ((best % columns) / (columns - 1)) * this.size;
    const y = (1 - Math.floor(best / columns) / (rows - 1)) * this.size;
    context.beginPath();
    [[0, -7], [7, 0], [0, 7], [-7, 0]].forEach(([dx, dy], i) => context[i ? "lineTo" : "moveTo"](x + dx, y + dy));
    context.closePath();
    this.rimmed(context, CORE, 2);
  }

  /** Stroke the path in a colour with a dark rim. */
  rimmed(context, colour, width, dash = []) {
    context.setLineDash([]);
    context.strokeStyle = dash.length ? FAINT_RIM : RIM;
    context.lineWidth = width + (dash.length ? 1.6 : 2.5);
    context.stroke();
    context.setLineDash(dash);
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.stroke();
    context.setLineDash([]);
  }

  /**
   * Draw the ways up to a step: others thin and whole, the active one with what its step tries.
   * `glide` says how far the sample is on its way from the step before, 0 to 1.
   */
  drawWays({ traces, active, step, glide, start, faint }) {
    const context = fitCanvas(this.ways, this.size, this.size);
    this.ways.style.opacity = faint ? "0.35" : "1";
    context.lineJoin = "round";
    traces.forEach((trace, index) => {
      if (trace.name !== active) this.drawWay(context, trace.steps, wayOf(index), 1.6);
    });
    const index = traces.findIndex((trace) => trace.name === active);
    const here = index >= 0 && traces[index].steps.length ? this.position(traces[index].steps, step, glide) : start;
    if (index >= 0 && traces[index].steps.length) {
      const { steps } = traces[index];
      const passed = steps.slice(0, Math.max(1, step + (glide >= 1)));
      this.drawWay(context, [...passed, { x: here[0], y: here[1] }], wayOf(index), 2.6);
      this.drawTries(context, steps, step, wayOf(index));
    }
    if (start) this.drawRing(context, start, 8, wayOf(0).colour);
    if (here) this.drawDot(context, here, 5, index >= 0 ? wayOf(index).colour : CORE);
    return here;
  }

  position(steps, step, glide) {
    const [to, from] = [steps[step], steps[Math.max(0, step - 1)]];
    const part = Math.max(0, Math.min(1, glide));
    return [from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)];
  }

  drawWay(context, steps, { colour, dash }, width) {
    context.beginPath();
    steps.forEach(({ x, y }, i) => context[i ? "lineTo" : "moveTo"](...this.toPixel([x, y])));
    this.rimmed(context, colour, width, dash);
  }

  /** What the step tried: lines from where it was, filled where the error is lower. */
  drawTries(context, steps, step, { colour }) {
    const { tries } = steps[step];
    const from = steps[Math.max(0, step - 1)];
    for (const [x, y, error, stage] of tries) {
      const [px, py] = this.toPixel([x, y]);
      if (stage === "probe" || stage === "step" || stage === "vertex") {
        context.beginPath();
        context.moveTo(...this.toPixel([from.x, from.y]));
        context.lineTo(px, py);
        context.strokeStyle = "rgb(255 255 255 / 0.7)";
        context.lineWidth = 1;
        context.stroke();
      }
      context.beginPath();
      context.arc(px, py, 3.6, 0, 2 * Math.PI);
      context.lineWidth = 1.6;
      const lower = error < from.error;
      context.fillStyle = lower ? colour : RIM;
      context.strokeStyle = lower ? RIM : colour;
      context.fill();
      context.stroke();
    }
  }

  drawRing(context, place, radius, colour) {
    context.beginPath();
    context.arc(...this.toPixel(place), radius, 0, 2 * Math.PI);
    this.rimmed(context, colour, 2);
  }

  drawDot(context, place, radius, colour) {
    context.beginPath();
    context.arc(...this.toPixel(place), radius, 0, 2 * Math.PI);
    this.rimmed(context, colour, 1);
    context.fillStyle = colour;
    context.fill();
  }

  /** Draw the place that is hovered or pinned. */
  drawTop(place, pinned) {
    const context = fitCanvas(this.top, this.size, this.size);
    if (!place) return;
    const [x, y] = this.toPixel(place);
    context.beginPath();
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(x + 4 * dx, y + 4 * dy);
      context.lineTo(x + 12 * dx, y + 12 * dy);
    }
    this.rimmed(context, CORE, 1.6);
    if (pinned) this.drawRing(context, place, 4, CORE);
  }
}
