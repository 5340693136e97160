// Stick figures side by side, all seen by the same camera. Nothing here knows of a model:
// authoring uses it too.

const FIGURE_TILES = 3;

class StickFigures {
  constructor({ parents, sides }) {
    Object.assign(this, { parents, sides, turn: 0.6, tilt: 0.2 });
    this.measure([]);
  }

  /** Take the scale from figures: what stands lowest and highest, and how far limbs reach. */
  measure(figures) {
    let [floor, top, reach] = [Infinity, -Infinity, 0];
    for (const p of figures) {
      for (let i = 0; i < p.length; i += 3) {
        floor = Math.min(floor, p[i + 1]);
        top = Math.max(top, p[i + 1]);
        reach = Math.max(reach, Math.hypot(p[i] - p[0], p[i + 2] - p[2]));
      }
    }
    const tall = top > floor ? top - floor : 1;
    // Rebuilt figures may reach further than the one that they are compared with.
    Object.assign(this, { floor: floor < Infinity ? floor : 0, tall, reach: Math.max(reach, 0.45 * tall) });
  }

  turnBy(dx, dy) {
    this.turn += dx;
    this.tilt = Math.min(1.4, Math.max(0, this.tilt + dy));
  }

  /** Draw figures (arrays of node positions) into equal parts of a box. */
  draw(context, figures, width, height, colours) {
    const part = width / figures.length;
    figures.forEach((positions, i) => {
      const see = this.camera(positions, part * (i + 0.5), part, height);
      this.drawGround(context, see, positions);
      this.drawBones(context, see, positions, colours);
    });
  }

  camera(p, middle, width, height) {
    const [sinTurn, cosTurn] = [Math.sin(this.turn), Math.cos(this.turn)];
    const [sinTilt, cosTilt] = [Math.sin(this.tilt), Math.cos(this.tilt)];
    const tall = this.tall * cosTilt + 2 * this.reach * sinTilt;
    const scale = 0.86 * Math.min(width / (2 * this.reach), height / tall);
    const base = height / 2 + (scale * cosTilt * this.tall) / 2;
    return (x, y, z) => {
      const [dx, dz] = [x - p[0], z - p[2]];
      const depth = dx * sinTurn + dz * cosTurn;
      return [
        middle + scale * (dx * cosTurn - dz * sinTurn),
        base - scale * ((y - this.floor) * cosTilt - depth * sinTilt),
      ];
    };
  }

  drawGround(context, see, p) {
    const tile = this.reach / FIGURE_TILES;
    const end = FIGURE_TILES * tile;
    context.beginPath();
    for (let i = -FIGURE_TILES; i <= FIGURE_TILES; i++) {
      const [x, z] = [p[0] + i * tile, p[2] + i * tile];
      context.moveTo(...see(x, this.floor, p[2] - end));
      context.lineTo(...see(x, this.floor, p[2] + end));
      context.moveTo(...see(p[0] - end, this.floor, z));
      context.lineTo(...see(p[0] + end, this.floor, z));
    }
    context.strokeStyle = "rgb(128 128 128 / 0.4)";
    context.lineWidth = 1;
    context.stroke();
  }

  drawBones(context, see, p, colours) {
    const at = (node) => see(p[3 * node], p[3 * node + 1], p[3 * node + 2]);
    context.lineCap = "round";
    context.lineWidth = 3.5;
    for (const side of ["middle", "left", "right"]) {
      context.beginPath();
      for (let node = 0; node < this.parents.length; node++) {
        const parent = this.parents[node];
        if (parent < 0 || (this.sides[node] ?? "middle") !== side) continue;
        context.moveTo(...at(parent));
        context.lineTo(...at(node));
      }
      context.strokeStyle = colours[side];
      context.stroke();
    }
  }
}
