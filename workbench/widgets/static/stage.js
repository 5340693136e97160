// Where motions play: stick figures on ground that stays where it is, side by side or the
// first as a ghost behind the others, which then share its place.

const GHOST = 0.38;
const ZOOMS = [0.6, 5];

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
  constructor(body) {
    super(body);
    this.zoom = 1;
  }

  zoomBy(factor) {
    this.zoom = Math.min(ZOOMS[1], Math.max(ZOOMS[0], this.zoom * factor));
  }

  resetView() {
    Object.assign(this, { turn: 0.6, tilt: 0.2, zoom: 1 });
  }

  camera(p, middle, width, height) {
    const see = super.camera(p, middle, width * this.zoom, height * this.zoom);
    const lift = (height * (this.zoom - 1)) / 2;
    return (x, y, z) => {
      const at = see(x, y, z);
      at[1] -= lift;
      return at;
    };
  }

  /** Draw tiles that stay where they are in the world, so that travel is seen. */
  drawGround(context, see, p) {
    const tile = this.reach / FIGURE_TILES;
    const end = 2 * FIGURE_TILES * tile;
    const [x, z] = [p[0], p[2]].map((root) => (Math.round(root / tile) - FIGURE_TILES) * tile);
    context.beginPath();
    for (let along = 0; along <= end + tile / 2; along += tile) {
      context.moveTo(...see(x + along, this.floor, z));
      context.lineTo(...see(x + along, this.floor, z + end));
      context.moveTo(...see(x, this.floor, z + along));
      context.lineTo(...see(x + end, this.floor, z + along));
    }
    context.strokeStyle = "rgb(128 128 128 / 0.4)";
    context.lineWidth = 1;
    context.stroke();
  }

  /** Draw motions at one frame: node positions of each, in the order of their names. */
  play(context, figures, width, height, colours, overlaid) {
    const parts = overlaid ? 1 : figures.length;
    const part = width / parts;
    figures.forEach((p, i) => {
      const left = overlaid ? 0 : i * part;
      context.save();
      context.beginPath();
      context.rect(left, 0, part, height);
      context.clip();
      const see = this.camera(overlaid ? figures[0] : p, left + part / 2, part, height);
      if (!overlaid || i === 0) this.drawGround(context, see, p);
      const ghost = overlaid && figures.length > 1 && i === 0;
      context.globalAlpha = ghost ? GHOST : 1;
      const { middle } = colours;
      this.drawBones(context, see, p, ghost ? { left: middle, right: middle, middle } : colours);
      context.restore();
    });
  }
}
