// The widget's traits, read at once into one plain object whose arrays fit each other.

const PLACES = ["points", "raw_points", "control_points", "influence"];
const LOOKS = [
  "classes", "class_names", "color_by", "values", "value_name", "value_best", "movable", "sample_word",
  "transition", "offers_html",
];

/** Read the traits; what does not fit the points, or not yet, is left out. */
function readState(model) {
  const specs = model.get("panels");
  const panels = specs.length;
  const points = typed(model.get("points"), Float32Array);
  const n = panels ? Math.floor(points.length / 2 / panels) : 0;
  const floats = (name, length) => {
    const values = typed(model.get(name), Float32Array);
    return values.length === length ? values : null;
  };
  const controls = [...typed(model.get("control_points"), Int32Array)].filter((i) => i < n);
  const k = controls.length;
  const isControl = new Uint8Array(n);
  for (const i of controls) isControl[i] = 1;
  const influence = k > 0 ? floats("influence", n * k) : null;
  const state = {
    views: Object.fromEntries(PLACES.map((name) => [name, model.get(name)])), // to see what is new
    specs, panels, points, n, controls, isControl, influence,
    raw: n > 0 ? floats("raw_points", 2 * panels * n) : null,
    canMove: Boolean(model.get("movable") && influence),
    classes: typed(model.get("classes"), Int32Array),
    names: model.get("class_names") ?? [],
    values: n > 0 ? floats("values", panels * n) : null,
    valueName: model.get("value_name") || "value",
    valueBest: model.get("value_best"),
    word: model.get("sample_word") || "sample",
    duration: model.get("transition") ?? 0,
    colorBy: model.get("color_by"),
    offersHtml: Boolean(model.get("offers_html")),
  };
  state.range = state.values && state.colorBy === "value" ? robustRange(state.values) : null;
  if (state.colorBy === "class" && state.classes.length !== n) state.colorBy = "none";
  if (state.colorBy === "value" && !state.range) state.colorBy = "none";
  return state;
}

/** Read where the control points were moved to: null if the trait has nothing that fits. */
function readMoved(model, { panels, controls }) {
  const moved = typed(model.get("moved"), Float32Array);
  return moved.length && moved.length === 2 * panels * controls.length ? moved : null;
}

/** Part of an array of all panels that belongs to one. */
function ofPanel(array, panel, panels) {
  const length = array.length / panels;
  return array.subarray(panel * length, (panel + 1) * length);
}

/** Whether a panel has any position in an array of positions. */
function anyKnown(points) {
  return points.some((value) => value === value);
}

function sameNumbers(a, b) {
  return a.length === b.length && a.every((value, i) => Object.is(value, b[i]));
}
