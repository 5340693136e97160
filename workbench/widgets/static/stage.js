// Where motions play: stick figures side by side, or the first as a ghost behind the others,
// which then share its place.

const GHOST = 0.38;

/** A context of a canvas that is emptied; its pixels are made anew only when its box changes. */
function emptied(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  const fits = canvas.width === Math.round(width * ratio) && canvas.height === Math.round(height * ratio);
  if (!fits) return fitCanvas(canvas, width, height);
  const context = canvas.getContext("2d");
  context.clearRect(0, 0, width, height);
  return context;
}

class Stage extends StickFigures {
  /** Draw motions at one frame: node positions of each, in the order of their names. */
  play(context, figures, width, height, colours, overlaid) {
    if (!overlaid || figures.length < 2) return this.draw(context, figures, width, height, colours);
    const [ghost, ...others] = figures;
    const see = this.camera(ghost, width / 2, width, height);
    this.drawGround(context, see, ghost, colours);
    context.globalAlpha = GHOST;
    const { middle } = colours;
    this.drawBones(context, see, ghost, { left: middle, right: middle, middle });
    context.globalAlpha = 1;
    for (const p of others) this.drawBones(context, see, p, colours);
  }
}
