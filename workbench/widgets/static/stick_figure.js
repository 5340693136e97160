// Stick figures side by side, all seen by the same camera. Nothing here knows of a model:
// authoring uses it too.

// How bodies look, in Python as well: figures/stick_look.py has the same numbers and says what
// they are.
const STICK_LOOK = {
  "head_radius": 0.062,
  "limb_width": 0.024,
  "trunk": 1.15,
  "least_width": 1.6,
  "open_from": 3.6,
  "open_share": 0.34,
  "dash": [2, 1.7],
  "colors": {
    "light": { "left": "#0072b2", "right": "#d55e00", "middle": "#1b1f24", "ground": "#bfc6ce", "shadow": "#dde1e6" },
    "dark": { "left": "#4da6e0", "right": "#ff8540", "middle": "#f2f2f2", "ground": "#50565d", "shadow": "#33383d" }
  }
};

const FIGURE_TILES = 3; // of the ground, to each side
const TILE_SHARE = 3.6; // of them as far as limbs reach, so that corners stay in the picture
const FIRST_VIEW = { turn: 0.6, tilt: 0.2, zoom: 1 }; // radians, radians, times
const ZOOMS = [0.6, 5];
const LEAST_PIXELS = 0.5; // of a bone that is drawn
const STEEPEST = 1.4; // radians from the horizon

/** Colours of figures in a theme; `paper` is what they are drawn on. */
function stickColours(theme) {
  return { ...STICK_LOOK.colors[theme.name], paper: theme.ground };
}

/** Entries of a legend that tell the sides apart, as they are drawn. */
function sideKey(sides, colours) {
  const swatch = {
    left: colours.left,
    right: `linear-gradient(${colours.right} 29%, ${colours.paper} 29% 71%, ${colours.right} 71%)`,
  };
  return ["left", "right"].filter((side) => sides.includes(side)).map((side) =>
    element("span", {}, [element("i", { class: "wb-side", style: `background: ${swatch[side]}` }), side]));
}

class StickFigures {
  /** `head` is the node at the far end of the head's bone; without one no head is drawn. */
  constructor({ parents, sides, head = -1 }) {
    Object.assign(this, { parents, sides, head, ...FIRST_VIEW });
    this.measure([]);
  }

  /** Take the scale from figures: what stands lowest and highest, and how far limbs reach. */
  measure(figures) {
    let [floor, top, reach] = [Infinity, -Infinity, 0];
    const sizes = [];
    for (const p of figures) {
      const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
      for (let i = 0; i < p.length; i++) {
        low[i % 3] = Math.min(low[i % 3], p[i]);
        high[i % 3] = Math.max(high[i % 3], p[i]);
      }
      for (let i = 0; i < p.length; i += 3) reach = Math.max(reach, Math.hypot(p[i] - p[0], p[i + 2] - p[2]));
      if (p.length) sizes.push(Math.max(...high.map((end, axis) => end - low[axis])));
      [floor, top] = [Math.min(floor, low[1]), Math.max(top, high[1])];
    }
    const tall = top > floor ? top - floor : 1;
    // That of a usual frame: few motions raise their arms or lie down most of the time.
    this.size = sizes.sort((a, b) => a - b)[sizes.length >> 1] || tall;
    // Rebuilt figures may reach further than the one that they are compared with.
    Object.assign(this, { floor: floor < Infinity ? floor : 0, tall, reach: Math.max(reach, 0.45 * tall) });
  }

  turnBy(dx, dy) {
    this.turn += dx;
    this.tilt = Math.min(STEEPEST, Math.max(0, this.tilt + dy));
  }

  zoomBy(factor) {
    this.zoom = Math.min(ZOOMS[1], Math.max(ZOOMS[0], this.zoom * factor));
  }

  resetView() {
    Object.assign(this, FIRST_VIEW);
  }

  /** Look from where other figures are looked at. */
  lookAs({ turn, tilt, zoom }) {
    Object.assign(this, { turn, tilt, zoom });
  }

  /** Draw figures (arrays of node positions) into equal parts of a box. */
  draw(context, figures, width, height, colours) {
    const part = width / figures.length;
    figures.forEach((positions, i) => {
      if (!positions.length) return;
      context.save();
      context.beginPath();
      context.rect(i * part, 0, part, height);
      context.clip();
      const see = this.camera(positions, part * (i + 0.5), part, height);
      this.drawGround(context, see, positions, colours);
      this.drawBones(context, see, positions, colours);
      context.restore();
    });
  }

  /** From world positions to pixels; the camera follows the root, but not upwards. */
  camera(p, middle, width, height) {
    const [sinTurn, cosTurn] = [Math.sin(this.turn), Math.cos(this.turn)];
    const [sinTilt, cosTilt] = [Math.sin(this.tilt), Math.cos(this.tilt)];
    const tall = this.tall * cosTilt + 2 * this.reach * sinTilt;
    const scale = 0.86 * this.zoom * Math.min(width / (2 * this.reach), height / tall);
    const base = height / 2 + (scale * cosTilt * this.tall) / 2;
    const see = (x, y, z) => {
      const [dx, dz] = [x - p[0], z - p[2]];
      const depth = dx * sinTurn + dz * cosTurn;
      return [
        middle + scale * (dx * cosTurn - dz * sinTurn),
        base - scale * ((y - this.floor) * cosTilt - depth * sinTilt),
      ];
    };
    return Object.assign(see, { scale });
  }

  /** Draw tiles that stay where they are in the world, so that travel is seen, and the shadow. */
  drawGround(context, see, p, colours = {}) {
    const dropped = (node) => see(p[3 * node], this.floor, p[3 * node + 2]);
    context.lineCap = "round";
    this.strokeBones(context, dropped, () => true, colours.shadow ?? "rgb(128 128 128 / 0.25)", 1.2 * this.limbWidth(see));
    const tile = this.reach / TILE_SHARE;
    const end = 2 * FIGURE_TILES * tile;
    const [x, z] = [p[0], p[2]].map((root) => (Math.round(root / tile) - FIGURE_TILES) * tile);
    context.beginPath();
    for (let i = 0; i <= 2 * FIGURE_TILES; i++) {
      const along = i * tile;
      context.moveTo(...see(x + along, this.floor, z));
      context.lineTo(...see(x + along, this.floor, z + end));
      context.moveTo(...see(x, this.floor, z + along));
      context.lineTo(...see(x + end, this.floor, z + along));
    }
    context.strokeStyle = colours.ground ?? "rgb(128 128 128 / 0.4)";
    context.lineWidth = 1;
    context.stroke();
  }

  /** Pixels that a limb is wide: of the body's size, but never too thin to be seen. */
  limbWidth(see) {
    return Math.max(STICK_LOOK.least_width, STICK_LOOK.limb_width * this.size * see.scale);
  }

  /** Draw the far limbs, the trunk, the head and the near limbs, so that these are in front. */
  drawBones(context, see, p, colours) {
    const seen = this.parents.map((_, node) => see(p[3 * node], p[3 * node + 1], p[3 * node + 2]));
    const at = (node) => seen[node];
    const width = this.limbWidth(see);
    context.lineCap = "round";
    const limbs = (side) => {
      const isOne = (node) => this.sides[node] === side;
      // Right limbs are open, or dashed where they are too thin for that, so that colour is
      // not all that tells them from left ones.
      const open = side === "right" && width >= STICK_LOOK.open_from && colours.paper;
      if (side === "right" && !open && colours.paper) context.setLineDash(STICK_LOOK.dash.map((part) => part * width));
      this.strokeBones(context, at, isOne, colours[side], width);
      context.setLineDash([]);
      if (open) this.strokeBones(context, at, isOne, colours.paper, STICK_LOOK.open_share * width);
    };
    const near = this.nearness(p, "left") > this.nearness(p, "right") ? "left" : "right";
    limbs(near === "left" ? "right" : "left");
    this.strokeBones(context, at, (node) => !["left", "right"].includes(this.sides[node]), colours.middle, STICK_LOOK.trunk * width);
    this.drawHead(context, at, see, colours.middle);
    limbs(near);
  }

  strokeBones(context, at, isOne, colour, width) {
    context.beginPath();
    for (let node = 0; node < this.parents.length; node++) {
      if (this.parents[node] < 0 || node === this.head || !isOne(node)) continue;
      const [from, to] = [at(this.parents[node]), at(node)];
      // Bones of no length, of which files have many, would cost as much as others.
      if (Math.abs(from[0] - to[0]) + Math.abs(from[1] - to[1]) < LEAST_PIXELS) continue;
      context.moveTo(from[0], from[1]);
      context.lineTo(to[0], to[1]);
    }
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.stroke();
  }

  drawHead(context, at, see, colour) {
    if (!(this.parents[this.head] >= 0)) return;
    const [end, start] = [at(this.head), at(this.parents[this.head])];
    context.beginPath();
    context.arc((start[0] + end[0]) / 2, (start[1] + end[1]) / 2, STICK_LOOK.head_radius * this.size * see.scale, 0, 2 * Math.PI);
    context.fillStyle = colour;
    context.fill();
  }

  /** How near to the viewer a side is, on average. */
  nearness(p, side) {
    const [right, up, away] = [Math.sin(this.turn) * Math.cos(this.tilt), Math.sin(this.tilt), Math.cos(this.turn) * Math.cos(this.tilt)];
    let [sum, count] = [0, 0];
    this.sides.forEach((own, node) => {
      if (own !== side || 3 * node >= p.length) return;
      sum += p[3 * node] * right + p[3 * node + 1] * up + p[3 * node + 2] * away;
      count += 1;
    });
    return count ? sum / count : 0;
  }
}
