// The pad's plane: the trajectory coloured by time, markers, and what follows the mouse, on two
// canvases, so that a move of the mouse redraws little.

const PAD_MARGIN = 34; // pixels around what is there, when all of it is shown
const PAD_TALL = [260, 460];
const MARKER_RADIUS = 6.5;
const CHEVRON = 5;
const TICKS = 7; // seconds that are written beside a trajectory, about

class PadPlane {
  constructor(describedBy) {
    const layer = (name) => element("canvas", { class: name, "aria-hidden": "true" });
    [this.base, this.top] = [layer("wb-base"), layer("wb-top")];
    this.plot = element("div", {
      class: "wb-plot wb-pad-plot", tabindex: "0", role: "application", "aria-describedby": describedBy,
    }, [this.base, this.top]);
    Object.assign(this, { width: 0, height: 0, view: null });
  }

  // Where things are.

  resize() {
    this.width = this.plot.clientWidth;
    this.height = this.plot.clientHeight;
  }

  /** Show all of a scene. */
  fit(scene) {
    const { low, high } = boxOf(Float64Array.from([...scene.points, ...scene.embedding, ...scene.markers]));
    this.view = { x: (low[0] + high[0]) / 2, y: (low[1] + high[1]) / 2, wide: high[0] - low[0], tall: high[1] - low[1], zoom: 1 };
  }

  /** Whether all of a scene is in sight. */
  holds(scene) {
    const inside = (points) => {
      for (let i = 0; i < points.length; i += 2) {
        const [x, y] = this.toPixel([points[i], points[i + 1]]);
        if (!(x >= 0 && y >= 0 && x <= this.width && y <= this.height)) return false;
      }
      return true;
    };
    return inside(scene.points) && inside(scene.markers);
  }

  /** Pixels in a unit of the plane. */
  get scale() {
    const { wide, tall, zoom } = this.view;
    const room = [this.width, this.height].map((size) => Math.max(20, size - 2 * PAD_MARGIN));
    return zoom * Math.min(room[0] / (wide || tall || 1), room[1] / (tall || wide || 1));
  }

  toPixel([x, y]) {
    const { scale, view } = this;
    return [this.width / 2 + (x - view.x) * scale, this.height / 2 - (y - view.y) * scale];
  }

  toPlace([px, py]) {
    const { scale, view } = this;
    return [view.x + (px - this.width / 2) / scale, view.y - (py - this.height / 2) / scale];
  }

  /** Zoom so that the place under a pixel stays there. */
  zoomAt(factor, pixel = [this.width / 2, this.height / 2]) {
    const [x, y] = this.toPlace(pixel);
    this.view.zoom = Math.min(40, Math.max(0.25, this.view.zoom * factor));
    const [nx, ny] = this.toPlace(pixel);
    this.view.x += x - nx;
    this.view.y += y - ny;
  }

  pan(dx, dy) {
    this.view.x -= dx / this.scale;
    this.view.y += dy / this.scale;
  }

  /** Bring a place into sight, for those who move it by keys. */
  reveal(place) {
    const [x, y] = this.toPixel(place);
    const [kx, ky] = [Math.max(12, Math.min(this.width - 12, x)), Math.max(12, Math.min(this.height - 12, y))];
    if (kx === x && ky === y) return false;
    this.pan(kx - x, ky - y);
    return true;
  }

  nearestMarker(scene, [px, py], reach = 14) {
    let [best, nearest] = [-1, reach];
    for (let j = 0; j < scene.count; j++) {
      const [x, y] = this.toPixel(scene.marker(j));
      const distance = Math.hypot(x - px, y - py);
      if (distance <= nearest) [best, nearest] = [j, distance];
    }
    return best;
  }

  /** The point of a curve within reach of a pixel, -1 if none is. */
  nearestOn(points, pixel, reach = 14) {
    if (!points.length) return -1;
    const { index, distance } = nearestPoint(points, this.toPlace(pixel));
    return distance * this.scale <= reach ? index : -1;
  }

  // Pictures.

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

  trace(context, points, from = 0, to = points.length / 2 - 1) {
    context.beginPath();
    for (let i = from; i <= to; i++) {
      const [x, y] = this.toPixel([points[2 * i], points[2 * i + 1]]);
      if (i === from) context.moveTo(x, y);
      else context.lineTo(x, y);
    }
  }

  /** Draw the trajectory in as many strokes as there are colours. */
  drawCurve(context, { points, times, start, duration }) {
    context.lineWidth = 2.6;
    const stepOf = (i) => Math.min(STEPS - 1, Math.floor(((times[i] - start) / duration) * STEPS));
    let first = 0;
    for (let i = 1; i < times.length; i++) {
      if (i < times.length - 1 && stepOf(i) === stepOf(first)) continue;
      this.trace(context, points, first, i);
      context.strokeStyle = this.colours[stepOf(first)];
      context.stroke();
      first = i;
    }
  }

  /** Write seconds beside the trajectory and point in its direction: colour is not all. */
  drawTimes(context, scene, theme) {
    const step = roundStep(scene.duration, TICKS);
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "left";
    context.textBaseline = "middle";
    const taken = [];
    for (let t = 0; t <= scene.duration * 1.000001; t += step) {
      const [x, y] = this.toPixel(scene.placeAt(scene.start + t));
      this.drawChevron(context, scene, t + step / 2, theme);
      context.beginPath();
      context.arc(x, y, 2.6, 0, 2 * Math.PI);
      context.fillStyle = theme.text;
      context.fill();
      if (taken.some(([tx, ty]) => Math.abs(tx - x) < 34 && Math.abs(ty - y) < 13)) continue;
      taken.push([x, y]);
      written(context, `${Number(t.toPrecision(6))} s`, x + 6, y - 8, theme);
    }
  }

  drawChevron(context, scene, t, theme) {
    if (t >= scene.duration) return;
    const reach = scene.duration / 200;
    const [x0, y0] = this.toPixel(scene.placeAt(scene.start + t - reach));
    const [x, y] = this.toPixel(scene.placeAt(scene.start + t + reach));
    const way = Math.hypot(x - x0, y - y0);
    if (way < 1) return; // it hardly moves there
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
  drawTop(scene, { place, now, hovered, selected, stretch, pen, theme }) {
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
      context.globalAlpha = 0.35;
      context.strokeStyle = theme.brand;
      context.lineWidth = 4 + 2 * level;
      context.stroke();
    });
    context.globalAlpha = 1;
    this.drawNow(context, [points[2 * index], points[2 * index + 1]], theme);
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

/** A round step that cuts a span into about so many parts. */
function roundStep(span, parts) {
  const rough = span / parts;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((m) => m * power).find((step) => step >= rough);
}
