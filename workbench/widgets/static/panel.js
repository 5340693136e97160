// One scatter panel. It has three canvases, so that a mouse move costs little whatever the
// number of samples: the base holds all samples and is redrawn when data, colours or size
// change, the marks hold the selected samples, the top what follows the mouse.

const TIME_STEPS = 64;
const REACH = 14; // how far from a sample, in pixels, the mouse still hovers it
const MARGIN = 12;

/**
 * Draw a mark into a small canvas once, and keep its pixels to be stamped many times.
 * A crisp mark has no soft rim, which takes a third of the time to stamp.
 */
function makeSprite(radius, draw, crisp = false) {
  const ratio = window.devicePixelRatio || 1;
  const half = Math.ceil((radius + 1) * ratio);
  const size = 2 * half;
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.translate(half, half);
  context.scale(ratio, ratio);
  draw(context);
  const { data } = context.getImageData(0, 0, size, size);
  if (crisp) for (let i = 3; i < data.length; i += 4) data[i] = data[i] < 110 ? 0 : 255;
  const colours = new Uint32Array(data.buffer);
  const filled = Array.from(colours.keys()).filter((i) => data[4 * i + 3]);
  const solid = filled.filter((i) => data[4 * i + 3] === 255);
  const places = [...solid, ...filled.filter((i) => data[4 * i + 3] < 255)];
  return {
    dx: places.map((i) => (i % size) - half),
    dy: places.map((i) => Math.floor(i / size) - half),
    colours: Uint32Array.from(places, (i) => colours[i]),
    solid: solid.length,
  };
}

function makeDot(colour, shape, radius, crisp) {
  // Corners of the shapes reach further out than the radius.
  return makeSprite(1.3 * radius, (context) => {
    context.fillStyle = colour;
    tracePath(context, shape, radius);
    context.fill();
  }, crisp);
}

function makeCross(theme) {
  return makeSprite(6, (context) => {
    context.beginPath();
    for (const slope of [1, -1]) {
      context.moveTo(-4, -4 * slope);
      context.lineTo(4, 4 * slope);
    }
    context.lineCap = "round";
    for (const [colour, width] of [[theme.ground, 4], [theme.text, 1.6]]) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.stroke();
    }
  });
}

/**
 * Pixels to stamp sprites on. The canvas could do this itself, but takes ten microseconds for
 * each stamp where this takes a fraction of one. Marks must lie within the image.
 */
class Raster {
  constructor(context) {
    const { width, height } = context.canvas;
    this.image = context.createImageData(width, height);
    this.bytes = this.image.data;
    this.pixels = new Uint32Array(this.bytes.buffer);
  }

  /** Prepare a sprite for this image's width. */
  fit({ dx, dy, colours, solid }) {
    return { offsets: Int32Array.from(dx, (x, i) => dy[i] * this.image.width + x), colours, solid };
  }

  /** Index of the pixel at a position in CSS pixels. */
  place(x, y) {
    const ratio = window.devicePixelRatio || 1;
    return Math.round(y * ratio) * this.image.width + Math.round(x * ratio);
  }

  stamp({ offsets, colours, solid }, place) {
    const { pixels } = this;
    for (let i = 0; i < solid; i++) pixels[place + offsets[i]] = colours[i];
    for (let i = solid; i < offsets.length; i++) this.blend(place + offsets[i], colours[i]);
  }

  blend(place, colour) {
    const at = 4 * place;
    const under = this.bytes[at + 3];
    if (under === 0) {
      this.pixels[place] = colour;
      return;
    }
    const alpha = colour >>> 24;
    const rest = (under * (255 - alpha)) / 255;
    const total = alpha + rest;
    for (let c = 0; c < 3; c++) {
      const over = (colour >>> (8 * c)) & 255;
      this.bytes[at + c] = (over * alpha + this.bytes[at + c] * rest) / total;
    }
    this.bytes[at + 3] = total;
  }
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
  if (colorBy === "class") {
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
    this.marks = element("canvas", { class: "wb-marks", "aria-hidden": "true" });
    this.top = element("canvas", { class: "wb-top", "aria-hidden": "true" });
    this.message = element("div", { class: "wb-message" });
    this.plot = element(
      "div",
      { class: "wb-plot", tabindex: "0", role: "application", "aria-describedby": label },
      [this.base, this.marks, this.top, this.message],
    );
    this.title = element("div", { class: "wb-title" });
    this.detail = element("div", { class: "wb-detail" });
    const caption = element("figcaption", {}, [this.title, this.detail]);
    this.figure = element("figure", { class: "wb-panel" }, [caption, this.plot]);
  }

  describe(spec, n, word) {
    this.title.textContent = spec.title ?? "";
    this.detail.textContent = this.detail.title = spec.detail ?? "";
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

  /** Stamp samples, and crosses over those that are control points. */
  stampAll(context, { swatchOf }, samples, crossed) {
    const { raster, places, dots, cross } = this;
    raster.pixels.fill(0);
    for (const i of samples) if (places[i] >= 0) raster.stamp(dots[swatchOf[i]], places[i]);
    for (const i of crossed) if (places[i] >= 0) raster.stamp(cross, places[i]);
    context.putImageData(raster.image, 0, 0);
  }

  drawBase(look, controls) {
    const context = fitCanvas(this.base, this.size, this.size);
    fitCanvas(this.marks, this.size, this.size);
    fitCanvas(this.top, this.size, this.size);
    const raster = new Raster(context);
    this.raster = raster;
    this.dots = look.dots.map((sprite) => raster.fit(sprite));
    this.cross = raster.fit(look.cross);
    // A sample without a position has no pixel.
    this.places = Int32Array.from(this.x, (x, i) => (x === x ? raster.place(x, this.y[i]) : -1));
    this.stampAll(context, look, this.x.keys(), controls);
  }

  drawMarks(look, chosen, isControl) {
    const context = this.marks.getContext("2d");
    if (chosen.length) this.stampAll(context, look, chosen, chosen.filter((i) => isControl[i]));
    else context.clearRect(0, 0, this.size, this.size);
  }

  drawTop(look, hovered, outline) {
    const context = this.top.getContext("2d");
    context.clearRect(0, 0, this.size, this.size);
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

  withinBox([x0, y0], [x1, y1]) {
    const [left, right, top, bottom] = [Math.min(x0, x1), Math.max(x0, x1), Math.min(y0, y1), Math.max(y0, y1)];
    const { x, y } = this;
    const found = [];
    for (let i = 0; i < x.length; i++) {
      if (x[i] >= left && x[i] <= right && y[i] >= top && y[i] <= bottom) found.push(i);
    }
    return found;
  }

  /** Samples within a closed polygon, by the even-odd rule. */
  within(polygon) {
    const xs = polygon.map(([x]) => x);
    const ys = polygon.map(([, y]) => y);
    const found = [];
    for (const i of this.withinBox([Math.min(...xs), Math.min(...ys)], [Math.max(...xs), Math.max(...ys)])) {
      const [x, y] = [this.x[i], this.y[i]];
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
