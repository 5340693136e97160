// One scatter panel. It has two canvases: the base holds all samples and is redrawn when
// data, colours or size change; the overlay holds what follows the mouse, so that a mouse
// move costs little whatever the number of samples.

const TIME_STEPS = 64;
const REACH = 14; // how far from a sample, in pixels, the mouse still hovers it
const MARGIN = 12;

/** Draw one sample into a small canvas, which is then stamped at every position. */
function makeSprite(colour, shape, radius) {
  const ratio = window.devicePixelRatio || 1;
  const half = Math.ceil((radius + 1) * ratio);
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 2 * half;
  const context = canvas.getContext("2d");
  context.translate(half, half);
  context.scale(ratio, ratio);
  context.fillStyle = colour;
  tracePath(context, shape, radius);
  context.fill();
  return { canvas, half: half / ratio, size: (2 * half) / ratio };
}

function tracePath(context, shape, r) {
  context.beginPath();
  if (shape === "square") context.rect(-r * 0.9, -r * 0.9, r * 1.8, r * 1.8);
  else if (shape === "circle") context.arc(0, 0, r, 0, 2 * Math.PI);
  else {
    const corners = shape === "diamond"
      ? [[0, -1.25], [1.25, 0], [0, 1.25], [-1.25, 0]]
      : [[0, -1.2], [1.1, 0.8], [-1.1, 0.8]];
    corners.forEach(([x, y], i) => context[i ? "lineTo" : "moveTo"](x * r, y * r));
    context.closePath();
  }
}

function timeColour(t, theme) {
  const stops = TIME_STOPS[theme.name];
  const place = t * (stops.length - 1);
  const low = Math.min(stops.length - 2, Math.floor(place));
  const mix = (i) => Math.round(stops[low][i] + (place - low) * (stops[low + 1][i] - stops[low][i]));
  return `rgb(${mix(0)} ${mix(1)} ${mix(2)})`;
}

/** Which swatch each sample has, and the swatches: pairs of colour and shape. */
function colouring(state, theme) {
  const { n, classes, names, colorBy } = state;
  const swatchOf = new Uint16Array(n);
  if (colorBy === "class" && classes.length === n) {
    swatchOf.set(classes);
    const swatches = names.map((_, i) => [
      theme.palette[i % theme.palette.length],
      SHAPES[Math.floor(i / theme.palette.length) % SHAPES.length],
    ]);
    return { swatchOf, swatches };
  }
  if (colorBy === "time") {
    for (let i = 0; i < n; i++) swatchOf[i] = (i * (TIME_STEPS - 1)) / Math.max(1, n - 1);
    const steps = Array.from({ length: TIME_STEPS }, (_, i) => i / (TIME_STEPS - 1));
    return { swatchOf, swatches: steps.map((t) => [timeColour(t, theme), "circle"]) };
  }
  return { swatchOf, swatches: [[theme.palette[0], "circle"]] };
}

/** One panel: where its samples are on the screen, and how they are drawn. */
class Panel {
  constructor(label) {
    this.base = element("canvas", { class: "wb-base", "aria-hidden": "true" });
    this.overlay = element("canvas", { class: "wb-overlay", "aria-hidden": "true" });
    this.message = element("div", { class: "wb-message" });
    this.plot = element(
      "div",
      { class: "wb-plot", tabindex: "0", role: "application", "aria-describedby": label },
      [this.base, this.overlay, this.message],
    );
    this.title = element("div", { class: "wb-title" });
    this.detail = element("div", { class: "wb-detail" });
    const caption = element("figcaption", {}, [this.title, this.detail]);
    this.figure = element("figure", { class: "wb-panel" }, [caption, this.plot]);
  }

  describe(spec, n, word) {
    this.title.textContent = spec.title ?? "";
    this.detail.textContent = spec.detail ?? "";
    this.message.textContent = spec.message ?? "";
    this.figure.classList.toggle("wb-busy", spec.state === "busy");
    this.figure.classList.toggle("wb-failed", spec.state === "failed");
    this.plot.setAttribute("aria-busy", String(spec.state === "busy"));
    const parts = ["Scatter panel", spec.title, spec.detail, `${n} ${word}s`, spec.message];
    this.plot.setAttribute("aria-label", parts.filter(Boolean).join(", "));
  }

  /** Place the samples in a box, equal units on both axes. */
  place(points, size) {
    this.size = size;
    const n = points.length / 2;
    this.x = new Float32Array(n);
    this.y = new Float32Array(n);
    let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
    for (let i = 0; i < n; i++) {
      const [px, py] = [points[2 * i], points[2 * i + 1]];
      if (px < left) left = px;
      if (px > right) right = px;
      if (py < bottom) bottom = py;
      if (py > top) top = py;
    }
    const extent = Math.max(right - left, top - bottom) || 1;
    const scale = (size - 2 * MARGIN) / extent;
    for (let i = 0; i < n; i++) {
      this.x[i] = size / 2 + (points[2 * i] - (left + right) / 2) * scale;
      this.y[i] = size / 2 - (points[2 * i + 1] - (bottom + top) / 2) * scale;
    }
  }

  stamp(context, sprite, i) {
    context.drawImage(sprite.canvas, this.x[i] - sprite.half, this.y[i] - sprite.half, sprite.size, sprite.size);
  }

  cross(context, samples, theme) {
    const arm = 4;
    context.beginPath();
    for (const i of samples) {
      const [x, y] = [this.x[i], this.y[i]];
      context.moveTo(x - arm, y - arm);
      context.lineTo(x + arm, y + arm);
      context.moveTo(x - arm, y + arm);
      context.lineTo(x + arm, y - arm);
    }
    context.lineCap = "round";
    context.strokeStyle = theme.ground;
    context.lineWidth = 4;
    context.stroke();
    context.strokeStyle = theme.text;
    context.lineWidth = 1.6;
    context.stroke();
  }

  drawBase(look, controls) {
    const context = fitCanvas(this.base, this.size, this.size);
    for (let i = 0; i < this.x.length; i++) {
      if (this.x[i] === this.x[i]) this.stamp(context, look.sprites[look.swatchOf[i]], i);
    }
    this.cross(context, controls, look.theme);
    fitCanvas(this.overlay, this.size, this.size);
  }

  drawOverlay(look, chosen, isControl, hovered, outline) {
    const context = this.overlay.getContext("2d");
    context.clearRect(0, 0, this.size, this.size);
    const crossed = [];
    for (const i of chosen) {
      this.stamp(context, look.sprites[look.swatchOf[i]], i);
      if (isControl[i]) crossed.push(i);
    }
    if (crossed.length) this.cross(context, crossed, look.theme);
    if (outline) this.drawOutline(context, outline, look.theme);
    if (hovered >= 0 && this.x[hovered] === this.x[hovered]) {
      for (const [colour, width] of [[look.theme.ground, 5], [look.theme.text, 2]]) {
        context.beginPath();
        context.arc(this.x[hovered], this.y[hovered], look.radius + 4, 0, 2 * Math.PI);
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.stroke();
      }
    }
  }

  drawOutline(context, outline, theme) {
    context.beginPath();
    outline.forEach(([x, y], i) => context[i ? "lineTo" : "moveTo"](x, y));
    context.closePath();
    context.fillStyle = "rgb(128 128 128 / 0.15)";
    context.fill();
    context.strokeStyle = theme.text;
    context.lineWidth = 1;
    context.setLineDash([4, 3]);
    context.stroke();
    context.setLineDash([]);
  }

  nearest(x, y) {
    let [best, reach] = [-1, REACH * REACH];
    for (let i = 0; i < this.x.length; i++) {
      const [dx, dy] = [this.x[i] - x, this.y[i] - y];
      const distance = dx * dx + dy * dy;
      if (distance < reach) [best, reach] = [i, distance];
    }
    return best;
  }

  /** Samples within a closed polygon, by the even-odd rule. */
  within(polygon) {
    const xs = polygon.map(([x]) => x);
    const ys = polygon.map(([, y]) => y);
    const box = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    const found = [];
    for (let i = 0; i < this.x.length; i++) {
      const [x, y] = [this.x[i], this.y[i]];
      if (x < box[0] || x > box[1] || y < box[2] || y > box[3] || x !== x) continue;
      let inside = false;
      for (let a = 0, b = xs.length - 1; a < xs.length; b = a++) {
        const crosses = ys[a] > y !== ys[b] > y;
        if (crosses && x < ((xs[b] - xs[a]) * (y - ys[a])) / (ys[b] - ys[a]) + xs[a]) inside = !inside;
      }
      if (inside) found.push(i);
    }
    return found;
  }
}
