// One scatter panel. It has three canvases, so that a mouse move costs little whatever the
// number of samples: the base holds all samples and is redrawn when data, colours or size
// change, the marks hold the selected samples, the top what follows the mouse.

class Panel {
  constructor(label) {
    this.base = element("canvas", { class: "wb-base", "aria-hidden": "true" });
    this.marks = element("canvas", { class: "wb-marks", "aria-hidden": "true" });
    this.top = element("canvas", { class: "wb-top", "aria-hidden": "true" });
    this.message = element("div", { class: "wb-message" });
    this.plot = element(
      "div",
      { class: "wb-plot", tabindex: "0", role: "application", "aria-describedby": label },
      [this.base, this.marks, this.top, this.message],
    );
    this.title = element("span", { class: "wb-title" });
    this.tag = element("span", { class: "wb-tag" });
    this.detail = element("div", { class: "wb-detail" });
    const heading = element("div", {}, [this.title, " ", this.tag]);
    const caption = element("figcaption", {}, [heading, this.detail]);
    this.figure = element("figure", { class: "wb-panel" }, [caption, this.plot]);
    this.cloud = new Cloud();
  }

  /** Show what a panel is called, what is shown of it ("moved", say) and its values. */
  describe(spec, { n, word }, tag, detail) {
    this.title.textContent = spec.title ?? "";
    this.tag.textContent = tag;
    this.detail.textContent = this.detail.title = detail;
    this.message.textContent = spec.message ?? "";
    this.figure.classList.toggle("wb-busy", spec.state === "busy");
    this.figure.classList.toggle("wb-failed", spec.state === "failed");
    this.plot.setAttribute("aria-busy", String(spec.state === "busy"));
    const parts = ["Scatter panel", spec.title, tag, detail, `${n} ${word}s`, spec.message];
    this.plot.setAttribute("aria-label", parts.filter(Boolean).join(", "));
  }

  /** Prepare canvases and marks for a size in pixels. */
  fit(size, marks) {
    this.cloud.resize(size);
    this.raster = new Raster(size, marks.ratio);
    for (const canvas of [this.base, this.marks, this.top]) {
      canvas.width = canvas.height = this.raster.width;
      canvas.getContext("2d").setTransform(marks.ratio, 0, 0, marks.ratio, 0, 0);
    }
    this.dots = marks.dots.map((sprite) => this.raster.fit(sprite));
    this.cross = this.raster.fit(marks.cross);
    this.places = new Int32Array(0);
    this.filled = new Set(); // which of the canvases above the base have something on them
  }

  drawBase(swatchOf, controls) {
    const { raster } = this;
    const { x, y } = this.cloud;
    if (this.places.length !== x.length) this.places = new Int32Array(x.length);
    for (let i = 0; i < x.length; i++) this.places[i] = raster.place(x[i], y[i]);
    this.swatchOf = swatchOf;
    raster.clear();
    for (let i = 0; i < x.length; i++) this.stampDot(i);
    for (const i of controls) this.stampCross(i);
    this.base.getContext("2d").putImageData(raster.image, 0, 0);
  }

  drawMarks(chosen, isControl) {
    if (!chosen.length) return this.clear(this.marks);
    this.raster.clear();
    for (const i of chosen) this.stampDot(i);
    for (const i of chosen) if (isControl[i]) this.stampCross(i);
    this.marks.getContext("2d").putImageData(this.raster.image, 0, 0);
    this.filled.add(this.marks);
  }

  /** Clear a canvas, if there is something on it: the browser pays for each canvas touched. */
  clear(canvas) {
    if (!this.filled.delete(canvas)) return;
    canvas.getContext("2d").clearRect(0, 0, this.cloud.size, this.cloud.size);
  }

  stampDot(i) {
    if (this.places[i] >= 0) this.raster.stamp(this.dots[this.swatchOf[i]], this.places[i]);
  }

  stampCross(i) {
    if (this.places[i] >= 0) this.raster.stamp(this.cross, this.places[i]);
  }

  /** Draw what follows the mouse; a held control point has a second ring. */
  drawTop({ theme, radius }, hovered, held, outline) {
    this.clear(this.top);
    if (!outline && hovered < 0 && held < 0) return;
    this.filled.add(this.top);
    const context = this.top.getContext("2d");
    if (outline) this.drawOutline(context, outline, theme);
    this.drawRing(context, hovered, radius + 4, theme);
    this.drawRing(context, held, radius + 9, theme);
  }

  drawRing(context, sample, radius, theme) {
    const [x, y] = [this.cloud.x[sample], this.cloud.y[sample]];
    if (!Number.isFinite(x)) return; // no such sample, or one without a position
    for (const [colour, width] of [[theme.ground, 5], [theme.text, 2]]) {
      context.beginPath();
      context.arc(x, y, radius, 0, 2 * Math.PI);
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.stroke();
    }
  }

  drawOutline(context, outline, theme) {
    context.beginPath();
    outline.forEach(([x, y], i) => context[i ? "lineTo" : "moveTo"](x, y));
    context.closePath();
    context.fillStyle = "rgb(128 128 128 / 0.15)";
    context.fill();
    context.strokeStyle = theme.text;
    context.lineWidth = 1;
    context.setLineDash([4, 3]);
    context.stroke();
    context.setLineDash([]);
  }
}
