// The pad's plane: the trajectory coloured by time, markers, and what follows the mouse, on two
// canvases, so that a move of the mouse redraws little.

const PAD_TALL = [260, 460];
const MARKER_RADIUS = 6.5;
const CHEVRON = 5;
const SHORTEST_STEP = 1.2; // pixels
const TICKS = 7; // seconds that are written beside a trajectory, about

class PadPlane extends PlaneView {
  constructor(describedBy) {
    super();
    const layer = (name) => element("canvas", { class: name, "aria-hidden": "true" });
    [this.base, this.top] = [layer("wb-base"), layer("wb-top")];
    this.plot = element("div", {
      class: "wb-plot wb-pad-plot", tabindex: "0", role: "application", "aria-describedby": describedBy,
    }, [this.base, this.top]);
  }

  resize() {
    this.width = this.plot.clientWidth;
    this.height = this.plot.clientHeight;
  }

  drawBase(scene, { selected, theme }) {
    const context = emptied(this.base, this.width, this.height);
    context.lineJoin = context.lineCap = "round";
    this.colours = ramp(TIME_STOPS[theme.name]);
    if (!scene.follows && scene.embedding.length) {
      this.trace(context, scene.embedding);
      context.globalAlpha = 0.3;
      context.strokeStyle = theme.text;
      context.lineWidth = 1;
      context.stroke();
      context.globalAlpha = 1;
    }
    this.drawCurve(context, scene);
    this.drawTimes(context, scene, theme);
    for (let j = 0; j < scene.count; j++) if (j !== selected) this.drawMarker(context, scene, j, theme, false);
    if (selected >= 0 && selected < scene.count) this.drawMarker(context, scene, selected, theme, true);
  }

  /** Take a curve into the path, without steps too short to be seen. */
  trace(context, points, from = 0, to = points.length / 2 - 1) {
    const { scale, view, width, height } = this;
    context.beginPath();
    let [lastX, lastY] = [NaN, NaN];
    for (let i = from; i <= to; i++) {
      const x = width / 2 + (points[2 * i] - view.x) * scale;
      const y = height / 2 - (points[2 * i + 1] - view.y) * scale;
      if (i < to && Math.abs(x - lastX) + Math.abs(y - lastY) < SHORTEST_STEP) continue;
      if (i === from) context.moveTo(x, y);
      else context.lineTo(x, y);
      [lastX, lastY] = [x, y];
    }
  }

  drawCurve(context, scene) {
    context.lineWidth = 2.6;
    context.lineJoin = "bevel"; // steps are short, and round joins take twice the time
    strokeByTime(context, scene, this.colours, (from, to) => this.trace(context, scene.points, from, to));
  }

  /** Write seconds beside the trajectory and point in its direction: colour is not all. */
  drawTimes(context, scene, theme) {
    const step = roundStep(scene.duration, TICKS);
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "left";
    context.textBaseline = "middle";
    const taken = Array.from({ length: scene.count }, (_, j) => {
      const [x, y] = this.toPixel(scene.marker(j));
      return [x - 10, y - 10, x + 10, y + 10];
    });
    for (let t = 0; t <= scene.duration * 1.000001; t += step) {
      const [x, y] = this.toPixel(scene.placeAt(scene.start + t));
      this.drawChevron(context, scene, t + step / 2, theme);
      context.beginPath();
      context.arc(x, y, 2.6, 0, 2 * Math.PI);
      context.fillStyle = theme.text;
      context.fill();
      const text = `${Number(t.toPrecision(6))} s`;
      const wide = context.measureText(text).width;
      const boxes = [[6, -9], [6, 9], [-6 - wide, -9], [-6 - wide, 9]].map(([dx, dy]) => [x + dx, y + dy - 7, x + dx + wide, y + dy + 7]);
      const free = boxes.find((box) => !taken.some((other) => overlap(box, other)));
      if (!free) continue;
      taken.push(free);
      written(context, text, free[0], free[1] + 7, theme);
    }
  }

  drawChevron(context, scene, t, theme) {
    if (t >= scene.duration) return;
    const reach = scene.duration / 120;
    const [x0, y0] = this.toPixel(scene.placeAt(scene.start + t - reach));
    const [x, y] = this.toPixel(scene.placeAt(scene.start + t + reach));
    const way = Math.hypot(x - x0, y - y0);
    if (way < 2 || this.nearestMarker(scene, [x, y]) >= 0) return; // it hardly moves there, or a marker hides it
    const [dx, dy] = [((x - x0) / way) * CHEVRON, ((y - y0) / way) * CHEVRON];
    context.beginPath();
    context.moveTo(x - dx - dy, y - dy + dx);
    context.lineTo(x, y);
    context.lineTo(x - dx + dy, y - dy - dx);
    context.strokeStyle = theme.text;
    context.lineWidth = 1.6;
    context.stroke();
  }

  drawMarker(context, scene, j, theme, selected) {
    const [x, y] = this.toPixel(scene.marker(j));
    const frame = scene.markerFrames[j];
    const radius = MARKER_RADIUS + (selected ? 2 : 0);
    const disc = (r, colour) => {
      context.beginPath();
      context.arc(x, y, r, 0, 2 * Math.PI);
      context.fillStyle = colour;
      context.fill();
    };
    if (selected) disc(radius + 4.5, theme.brand);
    disc(radius + 2, theme.name === "dark" ? "#f2f2f2" : theme.ground);
    disc(radius + 0.8, "#000000");
    const last = Math.max(1, scene.clipFrames - 1);
    disc(radius - 1.2, frame < 0 ? "#ffffff" : this.colours[Math.min(STEPS - 1, Math.round((frame / last) * (STEPS - 1)))]);
    if (frame >= 0) return;
    context.fillStyle = "#000000"; // a plus: a pose that no frame has
    context.fillRect(x - 3, y - 0.75, 6, 1.5);
    context.fillRect(x - 0.75, y - 3, 1.5, 6);
  }

  /** Draw what follows the mouse and the clock. */
  drawTop(scene, { place, pinned, now, hovered, selected, stretch, pen, theme }) {
    const context = emptied(this.top, this.width, this.height);
    context.lineCap = context.lineJoin = "round";
    if (stretch) this.drawStretch(context, scene, stretch, theme);
    if (pen) {
      this.trace(context, pen);
      context.strokeStyle = theme.brand;
      context.lineWidth = 3;
      context.stroke();
    }
    if (now) this.drawNow(context, now, theme);
    if (pinned) this.drawPin(context, pinned, theme);
    if (place) this.drawCross(context, place, theme);
    const named = hovered >= 0 ? hovered : selected;
    if (named >= 0 && named < scene.count) {
      const [x, y] = this.toPixel(scene.marker(named));
      context.font = "12px system-ui, sans-serif";
      context.textAlign = "left";
      context.textBaseline = "middle";
      const text = scene.nameOf(named);
      const wide = context.measureText(text).width;
      written(context, text, Math.max(4, Math.min(x + 14, this.width - wide - 6)), Math.max(9, y - 14), theme);
    }
  }

  /** Where the trajectory is at the time that is shown. */
  drawNow(context, now, theme) {
    const [x, y] = this.toPixel(now);
    for (const [r, colour] of [[7.5, theme.ground], [6, theme.brand], [2.4, theme.ground]]) {
      context.beginPath();
      context.arc(x, y, r, 0, 2 * Math.PI);
      context.fillStyle = colour;
      context.fill();
    }
  }

  /** The place that is kept in view. */
  drawPin(context, place, theme) {
    for (const [colour, width] of [[theme.ground, 5], [theme.text, 2]]) {
      context.beginPath();
      context.arc(...this.toPixel(place), 6, 0, 2 * Math.PI);
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.stroke();
    }
  }

  drawCross(context, place, theme) {
    const [x, y] = this.toPixel(place);
    for (const [colour, width] of [[theme.ground, 4], [theme.text, 1.6]]) {
      context.beginPath();
      for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
        context.moveTo(x + 4 * dx, y + 4 * dy);
        context.lineTo(x + 11 * dx, y + 11 * dy);
      }
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.stroke();
    }
  }

  /** Show which part of the trajectory a drag is felt in, and how much. */
  drawStretch(context, { points }, { index, radius, lengths }, theme) {
    const shares = [0.05, 0.3, 0.6, 0.9];
    shares.forEach((share, level) => {
      context.beginPath();
      for (let i = 1; i < lengths.length; i++) {
        if (falloff(Math.abs(lengths[i] - lengths[index]), radius) < share) continue;
        context.moveTo(...this.toPixel([points[2 * i - 2], points[2 * i - 1]]));
        context.lineTo(...this.toPixel([points[2 * i], points[2 * i + 1]]));
      }
      context.globalAlpha = 0.14;
      context.strokeStyle = theme.brand;
      context.lineWidth = 6 + 3 * level;
      context.stroke();
    });
    context.globalAlpha = 1;
    this.drawNow(context, [points[2 * index], points[2 * index + 1]], theme);
  }
}

/** Stroke a trajectory in as many strokes as there are colours; `trace` takes a part into the path. */
function strokeByTime(context, { times, start, duration }, colours, trace) {
  const stepOf = (i) => Math.min(STEPS - 1, Math.floor(((times[i] - start) / duration) * STEPS));
  let first = 0;
  for (let i = 1; i < times.length; i++) {
    if (i < times.length - 1 && stepOf(i) === stepOf(first)) continue;
    trace(first, i);
    context.strokeStyle = colours[stepOf(first)];
    context.stroke();
    first = i;
  }
}

/** Write on a light edge, so that lines below do not disturb. */
function written(context, text, x, y, theme) {
  context.strokeStyle = theme.ground;
  context.lineWidth = 3.5;
  context.lineJoin = "round";
  context.strokeText(text, x, y);
  context.fillStyle = theme.text;
  context.fillText(text, x, y);
}

/** Whether two boxes, [left, top, right, bottom], have something in common. */
function overlap(a, b) {
  return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
}

/** A round step that cuts a span into about so many parts. */
function roundStep(span, parts) {
  const rough = span / parts;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((m) => m * power).find((step) => step >= rough);
}
