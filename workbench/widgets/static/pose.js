// The pose view: a stick figure of the hovered frame, seen from slightly above and aside.

class Pose {
  constructor(model, root, signal) {
    Object.assign(this, { model, root });
    this.canvas = element("canvas", {
      tabindex: "0",
      role: "application", // lets the arrow keys through where a picture would not
      "aria-label": `Stick figure. ${ORBIT_HINT}`,
    });
    this.caption = element("div", { class: "wb-detail" });
    this.sides = element("div", { class: "wb-sides" });
    const under = element("div", { class: "wb-bar wb-pose-bar" }, [this.sides, orbitButtons(() => this.figures, () => this.draw(), signal)]);
    root.append(this.caption, this.canvas, under, element("p", { class: "wb-hint", text: ORBIT_HINT }));
    this.read();
    onTraits(model, ["positions", "parents", "sides", "head", "frame_time"], () => this.read(), signal);
    onTraits(model, ["frame"], () => this.show(model.get("frame")), signal);
    onHover(model, (frame) => frame >= 0 && this.show(frame), signal);
    watchTheme(() => this.draw(), signal);
    const observer = new ResizeObserver(() => this.draw());
    observer.observe(root);
    signal.addEventListener("abort", () => observer.disconnect());
    orbitByMouse(this.canvas, () => this.figures, () => this.draw(), signal);
    this.canvas.addEventListener("keydown", (event) => orbitByKey(event, this.figures) && this.draw(), { signal });
  }

  read() {
    const { model } = this;
    this.positions = typed(model.get("positions"), Float32Array);
    const [parents, sides, head] = ["parents", "sides", "head"].map((name) => model.get(name));
    this.nodes = parents.length;
    this.frames = this.nodes ? Math.floor(this.positions.length / 3 / this.nodes) : 0;
    this.frame = Math.min(Math.max(0, model.get("frame")), Math.max(0, this.frames - 1));
    const before = this.figures;
    this.figures = new StickFigures({ parents, sides, head });
    if (before) this.figures.lookAs(before);
    // From the whole clip, so that the scale does not change from frame to frame.
    this.figures.measure(Array.from({ length: this.frames }, (_, frame) => this.pose(frame)));
    this.draw();
  }

  /** Node positions of a frame. */
  pose(frame) {
    return this.positions.subarray(3 * this.nodes * frame, 3 * this.nodes * (frame + 1));
  }

  show(frame) {
    this.frame = Math.min(Math.max(0, frame), Math.max(0, this.frames - 1));
    this.draw();
  }

  draw() {
    const width = this.canvas.clientWidth || this.root.clientWidth;
    if (!width) return;
    const height = Math.round(Math.min(width * 1.1, 420));
    this.canvas.style.height = `${height}px`;
    const colours = stickColours(themeOf(this.root));
    const context = fitCanvas(this.canvas, width, height);
    this.sides.replaceChildren(...sideKey(this.model.get("sides"), colours));
    if (!this.frames) return;
    const seconds = (this.frame * this.model.get("frame_time")).toFixed(2);
    const text = `frame ${this.frame} of ${this.frames} · ${seconds} s`;
    this.caption.textContent = text;
    this.canvas.setAttribute("aria-label", `Stick figure, ${text}. ${ORBIT_HINT}`);
    this.figures.draw(context, [this.pose(this.frame)], width, height, colours);
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-pose" });
    el.append(root);
    root.pose = new Pose(model, root, stop.signal);
    return () => stop.abort();
  },
};
