// All panels with their captions and the legend as one picture, at twice the size.

const PICTURE_RATIO = 2;
const FADED = 0.22; // samples that are not selected, while others are; as in the style sheet

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
