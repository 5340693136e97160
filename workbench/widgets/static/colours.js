// What colours stand for: classes, time, or a value of each sample.

const STEPS = 64;
const UNKNOWN = { light: "#8f8f8f", dark: "#7d7d7d" };
// From the better to the worse end, in even steps of Oklab, with lightness rising all the way,
// also for colour-blind readers; no colour is closer to the ground than 3:1.
const VALUE_STOPS = {
  light: [
    [26, 45, 127], [65, 50, 130], [97, 53, 132], [128, 56, 132], [156, 63, 127],
    [178, 76, 116], [195, 91, 100], [210, 107, 77], [223, 122, 36],
  ],
  dark: [
    [57, 103, 193], [111, 109, 191], [154, 114, 188], [193, 120, 183], [226, 133, 177],
    [245, 155, 168], [252, 180, 157], [253, 205, 144], [251, 230, 128],
  ],
};

/** The colour at a place between 0 and 1 along a list of colours. */
function mixed(stops, place) {
  const at = place * (stops.length - 1);
  const low = Math.min(stops.length - 2, Math.floor(at));
  const mix = (c) => Math.round(stops[low][c] + (at - low) * (stops[low + 1][c] - stops[low][c]));
  return `rgb(${mix(0)} ${mix(1)} ${mix(2)})`;
}

function ramp(stops) {
  return Array.from({ length: STEPS }, (_, i) => mixed(stops, i / (STEPS - 1)));
}

/** Limits of values that a few extreme ones do not stretch: the 2nd and 98th percentile. */
function robustRange(values) {
  const known = values.filter((value) => Number.isFinite(value)).sort();
  if (!known.length) return null;
  const at = (part) => known[Math.round(part * (known.length - 1))];
  const [low, high] = [at(0.02), at(0.98)];
  return { low, high, below: known[0] < low, above: known.at(-1) > high, unknown: known.length < values.length };
}

/** Index of a value's colour; the last swatch is for unknown ones. */
function valueSwatch(value, { low, high }, best) {
  if (!Number.isFinite(value)) return STEPS;
  const part = high > low ? Math.min(1, Math.max(0, (value - low) / (high - low))) : 0.5;
  return Math.round((best === "low" ? part : 1 - part) * (STEPS - 1));
}

/** The swatches, pairs of colour and shape, and for each panel which of them each sample has. */
function colouring(state, theme) {
  const { n, panels, classes, names, colorBy, values, range, valueBest } = state;
  const shared = new Uint16Array(n);
  const same = (swatches) => ({ swatches, swatchOf: Array(panels).fill(shared) });
  if (colorBy === "class") {
    shared.set(classes);
    return same(names.map((_, i) => [
      theme.palette[i % theme.palette.length],
      SHAPES[Math.floor(i / theme.palette.length) % SHAPES.length],
    ]));
  }
  if (colorBy === "time") {
    for (let i = 0; i < n; i++) shared[i] = (i * (STEPS - 1)) / Math.max(1, n - 1);
    return same(ramp(TIME_STOPS[theme.name]).map((colour) => [colour, "circle"]));
  }
  if (colorBy === "value") {
    const colours = [...ramp(VALUE_STOPS[theme.name]), UNKNOWN[theme.name]];
    const swatchOf = Array.from({ length: panels }, (_, p) =>
      Uint16Array.from(values.subarray(p * n, (p + 1) * n), (v) => valueSwatch(v, range, valueBest)));
    return { swatches: colours.map((colour) => [colour, "circle"]), swatchOf };
  }
  return same([[theme.palette[0], "circle"]]);
}
