// A sample beside what is rebuilt of it at the place that the plane speaks of.

const FIGURES_TALL = 320;

class Reconstruction {
  constructor(model, root, signal) {
    Object.assign(this, { model, root, signal, place: null });
    this.caption = element("div", { class: "wb-title", text: "Reconstruction" });
    this.detail = element("div", { class: "wb-detail wb-rec-detail", role: "status", "aria-live": "off" });
    this.body = element("div", { class: "wb-rec-body" });
    this.note = element("p", { class: "wb-hint" });
    root.append(this.caption, this.detail, this.body, this.note);
    this.read();
    const traits = ["original", "columns", "low", "high", "parents", "sides", "head", "offsets", "root", "weights"];
    onTraits(model, [...traits, "kernel", "epsilon", "centers", "coefficients", "note"], () => this.read(), signal);
    onTraits(model, ["rebuilt", "rebuilt_at"], () => this.show(), signal);
    onPlace(model, (place) => {
      this.place = place;
      this.show();
    }, signal);
    watchTheme(() => this.show(), signal);
    const observer = new ResizeObserver(() => this.show());
    observer.observe(root);
    signal.addEventListener("abort", () => observer.disconnect());
  }

  read() {
    const numbers = (name) => typed(this.model.get(name), Float64Array);
    this.original = numbers("original");
    this.note.textContent = this.model.get("note");
    const kernel = this.model.get("kernel");
    this.radial = kernel
      ? new RadialFunction({ kernel, epsilon: this.model.get("epsilon"), centers: numbers("centers"), coefficients: numbers("coefficients") })
      : null;
    const parents = this.model.get("parents");
    this.poses = parents.length > 0;
    if (this.poses) this.readBody(parents, numbers);
    else {
      this.rows = new ValueRows(this.model.get("columns"), numbers("low"), numbers("high"));
      this.body.replaceChildren(this.rows.table);
    }
    this.show();
  }

  readBody(parents, numbers) {
    this.weights = numbers("weights");
    this.rootPlace = numbers("root");
    const skeleton = { parents, offsets: numbers("offsets"), joints: this.weights.length };
    if (skeleton.offsets.length !== 3 * parents.length || this.original.length !== 9 * skeleton.joints) {
      this.own = null; // traits of another body are still to come
      return;
    }
    this.kinematics = new Kinematics(skeleton);
    this.own = this.kinematics.place(this.original, this.rootPlace).slice();
    const before = this.figures;
    this.figures = new StickFigures({ parents, sides: this.model.get("sides"), head: this.model.get("head") });
    if (before) this.figures.lookAs(before);
    this.figures.measure([this.own]);
    if (!this.canvas) this.makeCanvas();
    const names = ["original", "rebuilt"].map((text) => element("span", { text }));
    this.body.replaceChildren(element("div", { class: "wb-rec-names" }, names), this.canvas, this.under);
  }

  makeCanvas() {
    this.canvas = element("canvas", { tabindex: "0", role: "application", "aria-label": `Stick figures of the original and the rebuilt pose. ${ORBIT_HINT}`, title: ORBIT_HINT });
    const [figures, redraw] = [() => this.figures, () => this.show()];
    orbitByMouse(this.canvas, figures, redraw, this.signal);
    this.canvas.addEventListener("keydown", (event) => orbitByKey(event, this.figures) && redraw(), { signal: this.signal });
    this.sides = element("div", { class: "wb-sides" });
    this.under = element("div", { class: "wb-bar" }, [this.sides, orbitButtons(figures, redraw, this.signal)]);
  }

  /** What is rebuilt, and where: in the browser if it can, else what Python sent last. */
  rebuild() {
    if (this.radial && this.place) {
      const values = this.radial.at(this.place);
      return { values: this.poses ? nearestRotations(values) : values, at: this.place };
    }
    const values = typed(this.model.get("rebuilt"), Float64Array);
    const at = this.model.get("rebuilt_at");
    return !this.radial && values.length && at.length === 2 ? { values, at } : null;
  }

  show() {
    const found = this.rebuild();
    const fits = found && found.values.length === this.original.length;
    if (this.poses) {
      if (this.own) this.drawFigures(fits ? found.values : null);
    } else this.rows.show(this.original, fits ? found.values : null);
    this.shown = fits ? found.values : null; // also for those who check the numbers
    if (!fits) return void (this.detail.textContent = "");
    const error = this.poses ? poseError(this.original, found.values, this.weights) : vectorError(this.original, found.values);
    const place = found.at.map((v) => v.toFixed(3)).join(", ");
    this.detail.textContent = `error ${brief(error)} at ${place}`;
  }

  drawFigures(rotations) {
    const width = this.body.clientWidth;
    if (!width) return;
    const height = Math.min(FIGURES_TALL, width);
    this.canvas.style.height = `${height}px`;
    const context = fitCanvas(this.canvas, width, height);
    const colours = stickColours(themeOf(this.root));
    this.sides.replaceChildren(...sideKey(this.model.get("sides"), colours));
    const figures = [this.own, ...(rotations ? [this.kinematics.place(rotations, this.rootPlace)] : [])];
    this.figures.draw(context, figures.length > 1 ? figures : [this.own, new Float64Array(0)], width, height, colours);
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-rec" });
    el.append(root);
    root.reconstruction = new Reconstruction(model, root, stop.signal);
    return () => stop.abort();
  },
};
