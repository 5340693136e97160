// Errors over a grid as colours and contours. Dark is low, as deep water is on a map; the
// colours rise evenly in lightness, so that they stay in order for colour-blind readers too.

const DEPTHS = [
  [68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142], [33, 145, 140],
  [34, 168, 132], [68, 191, 112], [122, 209, 81], [189, 223, 38], [253, 231, 37],
];
const CONTOURS = 9;
const SHADES = 256;

/** Colours of all depths, three bytes each. */
const SHADE_TABLE = (() => {
  const table = new Uint8Array(3 * SHADES);
  for (let i = 0; i < SHADES; i++) {
    const at = (i / (SHADES - 1)) * (DEPTHS.length - 1);
    const low = Math.min(DEPTHS.length - 2, Math.floor(at));
    for (let c = 0; c < 3; c++) {
      table[3 * i + c] = Math.round(DEPTHS[low][c] + (at - low) * (DEPTHS[low + 1][c] - DEPTHS[low][c]));
    }
  }
  return table;
})();

/** What the colours range over: from the lowest error to that which 98.5 % are below. */
function errorRange(errors) {
  const sorted = Float32Array.from(errors).sort();
  const [low, top] = [sorted[0], sorted[sorted.length - 1]];
  const high = sorted[Math.floor(0.985 * (sorted.length - 1))];
  return { low, high: high > low ? high : top, cut: high < top };
}

/** Round numbers between two: at most as many as asked for. */
function roundLevels(low, high, count) {
  const raw = (high - low) / count;
  if (!(raw > 0)) return [];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= raw);
  const levels = [];
  for (let i = Math.ceil(low / step); i * step < high; i++) levels.push(i * step);
  return levels.filter((level) => level > low);
}

/** How far up the colours an error is, 0 to 1: by the root, because the valleys matter. */
function depthOf(error, { low, high }) {
  return Math.sqrt(Math.max(0, Math.min(1, (error - low) / (high - low || 1))));
}

/** Levels of contours: about evenly spaced in colour, in two digits. */
function contourLevels({ low, high }) {
  const levels = Array.from({ length: CONTOURS }, (_, i) => {
    const level = low + ((i + 1) / (CONTOURS + 1)) ** 2 * (high - low);
    return Number(level.toPrecision(3));
  });
  return [...new Set(levels)];
}

/** Fill a canvas of a given size with the colours of a grid that spans it, rows from below. */
function paintHeatMap(context, errors, columns, range) {
  const { width, height } = context.canvas;
  const rows = errors.length / columns;
  const image = context.createImageData(width, height);
  for (let py = 0, at = 0; py < height; py++) {
    const v = (1 - (py + 0.5) / height) * (rows - 1);
    const row = Math.max(0, Math.min(rows - 2, Math.floor(v)));
    const fy = v - row;
    for (let px = 0; px < width; px++, at += 4) {
      const u = ((px + 0.5) / width) * (columns - 1);
      const column = Math.max(0, Math.min(columns - 2, Math.floor(u)));
      const fx = u - column;
      const i = row * columns + column;
      const below = errors[i] + fx * (errors[i + 1] - errors[i]);
      const above = errors[i + columns] + fx * (errors[i + columns + 1] - errors[i + columns]);
      const s = 3 * Math.round((SHADES - 1) * depthOf(below + fy * (above - below), range));
      image.data[at] = SHADE_TABLE[s];
      image.data[at + 1] = SHADE_TABLE[s + 1];
      image.data[at + 2] = SHADE_TABLE[s + 2];
      image.data[at + 3] = 255;
    }
  }
  context.putImageData(image, 0, 0);
}

/** Trace the lines of equal error, as segments in grid coordinates (marching squares). */
function contourSegments(errors, columns, level) {
  const rows = errors.length / columns;
  const segments = [];
  for (let row = 0; row < rows - 1; row++) {
    for (let column = 0; column < columns - 1; column++) {
      const i = row * columns + column;
      const corners = [errors[i], errors[i + 1], errors[i + columns + 1], errors[i + columns]];
      const crossings = [];
      for (let side = 0; side < 4; side++) {
        const [a, b] = [corners[side], corners[(side + 1) % 4]];
        if (a < level === b < level) continue;
        const part = (level - a) / (b - a);
        crossings.push([
          [column + part, row], [column + 1, row + part], [column + 1 - part, row + 1], [column, row + 1 - part],
        ][side]);
      }
      for (let k = 0; k + 1 < crossings.length; k += 2) segments.push([crossings[k], crossings[k + 1]]);
    }
  }
  return segments;
}

/** Index of the lowest error. */
function lowestOf(errors) {
  let best = 0;
  for (let i = 1; i < errors.length; i++) if (errors[i] < errors[best]) best = i;
  return best;
}

/** A legend of the colours: numbers at round levels along a ramp. */
function heatLegend(range, name) {
  const stops = DEPTHS.map((c) => `rgb(${c.join(" ")})`).join(", ");
  const ramp = element("i", { class: "wb-land-ramp", style: `background: linear-gradient(to right, ${stops})` });
  const ticks = roundLevels(range.low, range.high, 5).map((level) => [level, depthOf(level, range)]);
  const inner = ticks.filter(([, part]) => part > 0.14 && part < 0.85);
  const labels = [[range.low, 0, ""], ...inner.map(([l, p]) => [l, p, ""]), [range.high, 1, range.cut ? "≥ " : ""]];
  const row = element("div", { class: "wb-land-ticks" }, labels.map(([level, part, before]) =>
    element("span", { text: before + brief(level), style: `left: ${(100 * part).toFixed(2)}%` })));
  const scale = element("div", { class: "wb-land-scale", role: "img",
    "aria-label": `${name}: dark is ${brief(range.low)}, bright ${range.cut ? "at least " : ""}${brief(range.high)}` }, [ramp, row]);
  return [element("span", { text: name }), scale];
}
