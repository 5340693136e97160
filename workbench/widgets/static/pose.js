// The pose view: a stick figure of the hovered frame, seen from slightly above and aside.
// The camera follows the root along the ground but not upwards, so that a jump is seen.

const TILT = 0.2; // radians
const FIRST_TURN = 0.6;
const TURN_PER_PIXEL = 0.01;
const TILES = 4; // ground tiles to each side of the figure
const POSE_HINT = "Drag, or use the arrow keys, to turn the view.";

class Pose {
  constructor(model, root, signal) {
    this.model = model;
    this.turn = FIRST_TURN;
    this.tilt = TILT;
    this.root = root;
    this.canvas = element("canvas", {
      tabindex: "0",
      role: "application", // lets the arrow keys through where a picture would not
      "aria-label": `Stick figure. ${POSE_HINT}`,
    });
    this.caption = element("div", { class: "wb-detail" });
    this.sides = element("div", { class: "wb-sides" });
    root.append(this.caption, this.canvas, this.sides, element("p", { class: "wb-hint", text: POSE_HINT }));
    this.read();
    onTraits(model, ["positions", "parents", "sides", "frame_time"], () => this.read(), signal);
    onTraits(model, ["frame"], () => this.show(model.get("frame")), signal);
    onHover(model, (frame) => frame >= 0 && this.show(frame), signal);
    watchTheme(() => this.draw(), signal);
    const observer = new ResizeObserver(() => this.draw());
    observer.observe(root);
    signal.addEventListener("abort", () => observer.disconnect());
    this.listen(signal);
  }

  read() {
    const { model } = this;
    this.positions = typed(model.get("positions"), Float32Array);
    this.parents = model.get("parents");
    this.nodes = this.parents.length;
    this.frames = this.nodes ? Math.floor(this.positions.length / 3 / this.nodes) : 0;
    this.frame = Math.min(Math.max(0, model.get("frame")), Math.max(0, this.frames - 1));
    this.measure();
    this.draw();
  }

  /** Measure the clip once, so that the scale does not change from frame to frame. */
  measure() {
    let [floor, top, reach] = [Infinity, -Infinity, 0];
    const p = this.positions;
    for (let frame = 0; frame < this.frames; frame++) {
      const root = 3 * frame * this.nodes;
      for (let i = root; i < root + 3 * this.nodes; i += 3) {
        floor = Math.min(floor, p[i + 1]);
        top = Math.max(top, p[i + 1]);
        reach = Math.max(reach, Math.hypot(p[i] - p[root], p[i + 2] - p[root + 2]));
      }
    }
    Object.assign(this, { floor, top, reach });
  }

  show(frame) {
    this.frame = Math.min(Math.max(0, frame), Math.max(0, this.frames - 1));
    this.draw();
  }

  listen(signal) {
    const on = (type, act) => this.canvas.addEventListener(type, act, { signal });
    let from = null;
    const turn = (dx, dy) => {
      this.turn += dx;
      this.tilt = Math.min(1.4, Math.max(0, this.tilt + dy));
      this.draw();
    };
    on("pointerdown", (event) => (from = [event.clientX, event.clientY]));
    on("pointermove", (event) => {
      if (!from || !event.buttons) return;
      turn((event.clientX - from[0]) * TURN_PER_PIXEL, (event.clientY - from[1]) * TURN_PER_PIXEL);
      from = [event.clientX, event.clientY];
    });
    on("pointerup", () => (from = null));
    on("keydown", (event) => {
      const steps = { ArrowLeft: [-0.15, 0], ArrowRight: [0.15, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
      if (!(event.key in steps)) return;
      turn(...steps[event.key]);
      event.preventDefault();
      event.stopPropagation();
    });
  }

  /** Make the projection of this frame: world position to canvas pixels. */
  camera(width, height) {
    const p = this.positions;
    const root = 3 * this.frame * this.nodes;
    const [sinTurn, cosTurn] = [Math.sin(this.turn), Math.cos(this.turn)];
    const [sinTilt, cosTilt] = [Math.sin(this.tilt), Math.cos(this.tilt)];
    const tall = (this.top - this.floor) * cosTilt + 2 * this.reach * sinTilt || 1;
    const scale = 0.92 * Math.min(width / (2 * this.reach || 1), height / tall);
    const base = height / 2 + (scale * cosTilt * (this.top - this.floor)) / 2;
    return (x, y, z) => {
      const [dx, dz] = [x - p[root], z - p[root + 2]];
      const depth = dx * sinTurn + dz * cosTurn;
      return [
        width / 2 + scale * (dx * cosTurn - dz * sinTurn),
        base - scale * ((y - this.floor) * cosTilt - depth * sinTilt),
      ];
    };
  }

  draw() {
    const width = this.canvas.clientWidth || this.root.clientWidth;
    if (!width) return;
    const height = Math.round(Math.min(width * 1.1, 420));
    this.canvas.style.height = `${height}px`;
    const theme = themeOf(this.root);
    const context = fitCanvas(this.canvas, width, height);
    this.legend(theme);
    if (!this.frames) return;
    const seconds = (this.frame * this.model.get("frame_time")).toFixed(2);
    const text = `frame ${this.frame} of ${this.frames} · ${seconds} s`;
    this.caption.textContent = text;
    this.canvas.setAttribute("aria-label", `Stick figure, ${text}. ${POSE_HINT}`);
    const see = this.camera(width, height);
    this.drawGround(context, see);
    this.drawBones(context, see, theme);
  }

  /** Draw tiles that stay where they are in the world, so that travel is seen. */
  drawGround(context, see) {
    const root = 3 * this.frame * this.nodes;
    const tile = (this.top - this.floor || 1) / 4;
    const corner = [0, 2].map((axis) => (Math.round(this.positions[root + axis] / tile) - TILES) * tile);
    const end = 2 * TILES * tile;
    context.beginPath();
    for (let i = 0; i <= 2 * TILES; i++) {
      const along = i * tile;
      context.moveTo(...see(corner[0] + along, this.floor, corner[1]));
      context.lineTo(...see(corner[0] + along, this.floor, corner[1] + end));
      context.moveTo(...see(corner[0], this.floor, corner[1] + along));
      context.lineTo(...see(corner[0] + end, this.floor, corner[1] + along));
    }
    context.strokeStyle = "rgb(128 128 128 / 0.45)";
    context.lineWidth = 1;
    context.stroke();
  }

  drawBones(context, see, theme) {
    const p = this.positions;
    const first = 3 * this.frame * this.nodes;
    const at = (node) => see(p[first + 3 * node], p[first + 3 * node + 1], p[first + 3 * node + 2]);
    const sides = this.model.get("sides");
    context.lineCap = "round";
    context.lineWidth = 4;
    for (const side of ["middle", "left", "right"]) {
      context.beginPath();
      for (let node = 0; node < this.nodes; node++) {
        const parent = this.parents[node];
        if (parent < 0 || (sides[node] ?? "middle") !== side) continue;
        context.moveTo(...at(parent));
        context.lineTo(...at(node));
      }
      context.strokeStyle = this.colour(side, theme);
      context.stroke();
    }
  }

  colour(side, theme) {
    return { left: theme.palette[0], right: theme.palette[1], middle: theme.text }[side];
  }

  legend(theme) {
    const key = (side) => {
      const mark = element("i", { style: `background: ${this.colour(side, theme)}` });
      return element("span", {}, [mark, side]);
    };
    const present = new Set(this.model.get("sides"));
    this.sides.replaceChildren(...["left", "right"].filter((side) => present.has(side)).map(key));
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-pose" });
    el.append(root);
    new Pose(model, root, stop.signal);
    return () => stop.abort();
  },
};
