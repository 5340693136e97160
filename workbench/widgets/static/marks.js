// Dots and crosses, drawn once each and then stamped as pixels.

const EDGE = 8; // marks nearer than this to the edge of a raster are left out

/** Pixels of the screen in a CSS pixel. */
function screenRatio() {
  return window.devicePixelRatio || 1;
}

/**
 * Draw a mark into a small canvas once, and keep its pixels to be stamped many times.
 * A crisp mark has no soft rim, which takes a third of the time to stamp.
 */
function makeSprite(radius, ratio, draw, crisp = false) {
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

function makeDot(colour, shape, radius, ratio, crisp) {
  // Corners of the shapes reach further out than the radius.
  return makeSprite(1.3 * radius, ratio, (context) => {
    context.fillStyle = colour;
    tracePath(context, shape, radius);
    context.fill();
  }, crisp);
}

function makeCross(theme, ratio) {
  return makeSprite(6, ratio, (context) => {
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

/** The marks of all panels at one resolution. */
function makeMarks({ theme, swatches, radius, crisp }, ratio) {
  return {
    ratio,
    dots: swatches.map(([colour, shape]) => makeDot(colour, shape, radius, ratio, crisp)),
    cross: makeCross(theme, ratio),
  };
}

/**
 * A square of pixels to stamp sprites on. The canvas could do this itself, but takes ten
 * microseconds for each stamp where this takes a fraction of one.
 */
class Raster {
  constructor(size, ratio) {
    this.size = size;
    this.ratio = ratio;
    this.width = Math.max(1, Math.round(size * ratio));
    this.image = new ImageData(this.width, this.width);
    this.bytes = this.image.data;
    this.pixels = new Uint32Array(this.bytes.buffer);
  }

  /** Prepare a sprite for this image's width. */
  fit({ dx, dy, colours, solid }) {
    return { offsets: Int32Array.from(dx, (x, i) => dy[i] * this.width + x), colours, solid };
  }

  clear() {
    this.pixels.fill(0);
  }

  /** Index of the pixel at a position in CSS pixels; -1 if it is none or too near the edge. */
  place(x, y) {
    const { size, ratio, width } = this;
    const within = x >= EDGE && y >= EDGE && x <= size - EDGE && y <= size - EDGE;
    return within ? Math.round(y * ratio) * width + Math.round(x * ratio) : -1;
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

/** Show a mark by itself as it is in the panels, for the legend. */
function drawMark(sprite, size, ratio) {
  const raster = new Raster(size, ratio);
  const middle = Math.round((size / 2) * ratio);
  raster.stamp(raster.fit(sprite), middle * raster.width + middle);
  const canvas = element("canvas", { "aria-hidden": "true", width: raster.width, height: raster.width });
  canvas.style.width = canvas.style.height = `${size}px`;
  canvas.getContext("2d").putImageData(raster.image, 0, 0);
  return canvas;
}
