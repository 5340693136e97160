// What can be saved: a picture, a table, and a page that stays interactive.

const PATIENCE = 60_000; // milliseconds to wait for the page from Python

function download(blob, name) {
  const address = URL.createObjectURL(blob);
  element("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

function savePicture(view) {
  drawPicture(view).toBlob((blob) => download(blob, "projections.png"), "image/png");
  view.say("picture saved");
}

/** A field of a CSV file. */
function field(value) {
  if (typeof value !== "number") return /[",\r\n]/.test(value) ? `"${value.replaceAll('"', '""')}"` : value;
  // Nine digits give back the same number of single precision.
  return Number.isFinite(value) ? String(Number(value.toPrecision(9))) : "";
}

/** Titles of the panels, each different. */
function distinctTitles(panels) {
  const seen = new Map();
  return panels.map((panel, p) => {
    const title = panel.title.textContent || `panel ${p + 1}`;
    seen.set(title, (seen.get(title) ?? 0) + 1);
    return seen.get(title) > 1 ? `${title} (${seen.get(title)})` : title;
  });
}

/** What is shown, as a table with a line for each sample. */
function tableOf(view) {
  const { panels, state, chosen } = view;
  const { n, word, names, classes, isControl, values, valueName } = state;
  const selected = new Uint8Array(n);
  for (const i of chosen) selected[i] = 1;
  const columns = [[word, (i) => i]];
  if (classes.length === n && names.length) columns.push(["class", (i) => names[classes[i]] ?? ""]);
  columns.push(["selected", (i) => selected[i]], ["control_point", (i) => isControl[i]]);
  distinctTitles(panels).forEach((title, p) => {
    const { points } = panels[p].cloud;
    columns.push([`${title} x`, (i) => points[2 * i]], [`${title} y`, (i) => points[2 * i + 1]]);
    if (values) columns.push([`${title} ${valueName}`, (i) => values[p * n + i]]);
  });
  const lines = [columns.map(([name]) => field(name)).join(",")];
  for (let i = 0; i < n; i++) lines.push(columns.map(([, of]) => field(of(i))).join(","));
  return `${lines.join("\n")}\n`;
}

function saveTable(view) {
  download(new Blob([tableOf(view)], { type: "text/csv" }), "projections.csv");
  view.say("table saved");
}

/** Ask Python for the page, and save it when it comes. */
function savePage(view, signal) {
  const { model } = view;
  const end = (text) => {
    clearTimeout(waiting);
    model.off("msg:custom", receive);
    view.note(text);
  };
  const receive = ({ kind, name, text }, buffers) => {
    if (kind === "failure") end(`The page cannot be made: ${text}`);
    if (kind !== "html") return;
    download(new Blob(buffers, { type: "text/html" }), name);
    end("");
    view.say("page saved");
  };
  const waiting = setTimeout(() => end("The page did not come: Python is busy or has stopped. Try again."), PATIENCE);
  signal.addEventListener("abort", () => end(""));
  model.on("msg:custom", receive);
  view.note("The page is being made …");
  model.send({ want: "html" });
}
