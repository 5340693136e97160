// The legend: what colours and marks mean, for the page and for the picture.

const LEGEND_RADIUS = 4;
const LEGEND_SIZE = 14;

/** A number in a few digits. */
function brief(value, digits = 3) {
  return Number(value.toPrecision(digits)).toString();
}

/** How many digits tell values in a range apart: a hundredth of it should be seen. */
function digitsFor({ low, high }) {
  const largest = Math.max(Math.abs(low), Math.abs(high));
  if (!(high > low)) return 3;
  return Math.min(7, Math.max(3, Math.ceil(Math.log10(largest / (high - low))) + 2));
}

/**
 * What the legend shows, from left to right: {mark, text, group} for a swatch, {ramp, title,
 * before, after} for a range of colours. It serves the page and the picture.
 */
function legendEntries(state, look, ratio) {
  const { names, colorBy, word, range, valueName, valueBest, controls } = state;
  const { theme, swatches } = look;
  const dot = (swatch) => makeDot(...swatch, LEGEND_RADIUS, ratio);
  const entries = [];
  if (colorBy === "class") {
    names.forEach((name, group) => entries.push({ mark: dot(swatches[group]), text: name, group }));
  } else if (colorBy === "time") {
    entries.push({ ramp: ramp(TIME_STOPS[theme.name]), title: "", before: `first ${word}`, after: "last" });
  } else if (colorBy === "value") {
    const colours = ramp(VALUE_STOPS[theme.name]);
    const digits = digitsFor(range);
    const low = `${range.below ? "≤ " : ""}${brief(range.low, digits)}`;
    const high = `${range.above ? "≥ " : ""}${brief(range.high, digits)}`;
    const [first, last] = valueBest === "low" ? ["better", "worse"] : ["worse", "better"];
    entries.push({
      ramp: valueBest === "low" ? colours : colours.reverse(),
      title: valueName,
      before: `${first} ${low}`,
      after: `${high} ${last}`,
    });
    if (range.unknown) entries.push({ mark: dot(swatches[STEPS]), text: "unknown" });
  }
  if (controls.length) {
    entries.push({ mark: makeCross(theme, ratio), text: `control point (${controls.length})` });
  }
  return entries;
}

/** Show the legend in the page; a click on a class chooses its samples. */
function showLegend(place, entries, choose) {
  const key = ({ mark, text, group }) => {
    const parts = [drawMark(mark, LEGEND_SIZE, screenRatio()), text];
    if (group === undefined) return element("span", { class: "wb-mark" }, parts);
    const button = element("button", { type: "button", title: `Select all of class ${text}` }, parts);
    button.addEventListener("click", ({ shiftKey }) => choose(group, shiftKey));
    return button;
  };
  const range = ({ ramp: colours, title, before, after }) => {
    const bar = element("i", { style: `background: linear-gradient(to right, ${colours.join(", ")})` });
    const name = title ? [element("b", { text: title })] : [];
    return element("span", { class: "wb-ramp" }, [...name, before, bar, after]);
  };
  place.replaceChildren(...entries.map((entry) => (entry.ramp ? range(entry) : key(entry))));
}
