// What can be saved: a picture, a table, and a page that stays interactive.

const PICTURE_RATIO = 2;
const FADED = 0.22; // samples that are not selected, while others are; as in the style sheet
const PATIENCE = 60_000; // milliseconds to wait for the page from Python

function download(blob, name) {
  const address = URL.createObjectURL(blob);
  element("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Cut a text so that it fits a width. */
function shortened(context, text, width) {
  if (context.measureText(text).width <= width) return text;
  let end = text.length;
  while (end > 1 && context.measureText(`${text.slice(0, end)}…`).width > width) end -= 1;
  return `${text.slice(0, end)}…`;
}

/** Draw all samples of a panel, the selected ones over the faded others. */
function drawSamples(context, panel, view, marks, x, y) {
  const { chosen, state } = view;
  const layer = new Panel("");
  layer.cloud = panel.cloud;
  layer.fit(panel.cloud.size, marks);
  const paste = (canvas) => context.drawImage(canvas, x, y, panel.cloud.size, panel.cloud.size);
  layer.drawBase(panel.swatchOf, state.controls);
  context.globalAlpha = chosen.length ? FADED : 1;
  paste(layer.base);
  context.globalAlpha = 1;
  layer.drawMarks(chosen, state.isControl);
  paste(layer.marks);
}

/** Draw the legend in lines of a width; give the height that it takes. */
function drawLegend(context, entries, x, y, width, paint) {
  const [line, mark, scale] = [22, 14, 120];
  let [left, top] = [x, y];
  for (const entry of entries) {
    const texts = entry.ramp ? [entry.title, entry.before, entry.after] : [entry.text];
    const wide = texts.reduce((sum, text) => sum + context.measureText(text).width + 8, entry.ramp ? scale : mark);
    if (left > x && left + wide > x + width) [left, top] = [x, top + line];
    const write = (text, bold) => {
      if (!text) return;
      context.font = `${bold ? "600 " : ""}13px system-ui, sans-serif`;
      if (paint) context.fillText(text, left, top + 15);
      left += context.measureText(text).width + 8;
    };
    if (entry.ramp) {
      write(entry.title, true);
      write(entry.before);
      entry.ramp.forEach((colour, i) => {
        if (!paint) return;
        const kept = context.fillStyle;
        context.fillStyle = colour;
        context.fillRect(left + (i * scale) / entry.ramp.length, top + 5, scale / entry.ramp.length + 0.5, 10);
        context.fillStyle = kept;
      });
      left += scale + 8;
      write(entry.after);
    } else {
      if (paint) context.drawImage(drawMark(entry.mark, mark, PICTURE_RATIO), left, top + 3, mark, mark);
      left += mark + 4;
      write(entry.text);
    }
    left += 10;
  }
  return entries.length ? top + line - y : 0;
}

/** Draw all panels with their captions and the legend. */
function drawPicture(view) {
  const { panels, look, columns } = view;
  const [gap, caption] = [16, 42];
  const size = panels[0].cloud.size;
  const [width, step] = [columns * size + (columns + 1) * gap, caption + size + gap];
  const height = gap + Math.ceil(panels.length / columns) * step;
  const entries = legendEntries(view.state, look, PICTURE_RATIO);
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  const legend = drawLegend(context, entries, gap, 0, width - 2 * gap, false);
  canvas.width = width * PICTURE_RATIO;
  canvas.height = (height + legend) * PICTURE_RATIO;
  context.scale(PICTURE_RATIO, PICTURE_RATIO);
  context.fillStyle = look.theme.ground;
  context.fillRect(0, 0, width, height + legend);
  context.fillStyle = look.theme.text;
  const marks = makeMarks(look, PICTURE_RATIO);
  panels.forEach((panel, p) => {
    const [x, y] = [gap + (p % columns) * (size + gap), gap + Math.floor(p / columns) * step];
    const heading = [panel.title.textContent, panel.tag.textContent].filter(Boolean).join(" · ");
    context.font = "600 14px system-ui, sans-serif";
    context.fillText(shortened(context, heading, size), x, y + 14);
    context.font = "12px system-ui, sans-serif";
    context.fillText(shortened(context, panel.detail.textContent, size), x, y + 32);
    context.strokeStyle = "rgb(128 128 128 / 0.6)";
    context.strokeRect(x + 0.5, y + caption + 0.5, size - 1, size - 1);
    drawSamples(context, panel, view, marks, x, y + caption);
    const message = panel.message.textContent;
    if (message) context.fillText(shortened(context, message, size - 24), x + 12, y + caption + size / 2);
  });
  drawLegend(context, entries, gap, height, width - 2 * gap, true);
  return canvas;
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
