// Error against the number of keyframes. A press picks the number under the mouse, arrow keys
// the next one.

const COUNTS = { left: 48, right: 12, top: 10, bottom: 34, tall: 230 };
const COUNT_DASH = [[], [6, 4], [2, 3]];
const COUNT_HINT = "Press on the curve, or use arrow keys, to choose a number of keyframes.";

class CountCurve {
  constructor(model, root, signal) {
    // Where the mouse points, if it does, and the number that was picked, until its keyframes
    // are there; 0 for none.
    Object.assign(this, { model, root, pointed: 0, picked: 0 });
    this.canvas = element("canvas", { class: "wb-player-counts", tabindex: "0", role: "slider", "aria-label": "Number of keyframes", title: COUNT_HINT });
    this.title = element("div", { class: "wb-title" });
    this.legend = element("div", { class: "wb-sides" });
    this.readout = element("div", { class: "wb-detail" });
    this.message = element("div", { class: "wb-detail", role: "status" });
    root.append(this.title, this.legend, this.canvas, this.readout, this.message, element("p", { class: "wb-hint", text: COUNT_HINT }));
    onTraits(model, ["series", "count", "most", "error", "unit", "message", "waiting"], () => this.read(), signal);
    watchTheme(() => this.draw(), signal);
    const observer = new ResizeObserver(() => this.draw());
    observer.observe(root);
    signal.addEventListener("abort", () => observer.disconnect());
    const on = (type, act) => this.canvas.addEventListener(type, act, { signal });
    on("pointermove", (event) => this.point(this.countAt(event.offsetX)));
    on("pointerleave", () => this.point(0));
    on("click", (event) => this.pick(this.countAt(event.offsetX)));
    on("keydown", (event) => {
      const steps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 };
      if (!(event.key in steps)) return;
      event.preventDefault();
      event.stopPropagation();
      this.point(0);
      this.pick((this.picked || this.count) + steps[event.key]);
    });
    this.read();
  }

  read() {
    this.series = this.model.get("series").filter(({ counts }) => counts.length);
    this.title.textContent = `${this.model.get("unit")}, against the number of keyframes`;
    this.message.textContent = this.model.get("message");
    const counts = this.series.flatMap((s) => s.counts);
    const before = this.waiting;
    for (const name of ["count", "error", "waiting"]) this[name] = this.model.get(name);
    if (this.picked === this.count || (before && !this.waiting)) this.picked = 0;
    this.low = Math.min(2, ...counts);
    this.high = Math.max(3, this.count, ...counts);
    this.top = Math.max(0, this.error ?? 0, ...this.series.flatMap((s) => s.errors)) || 1;
    this.canvas.setAttribute("aria-valuemin", String(this.low));
    this.canvas.setAttribute("aria-valuemax", String(this.model.get("most") || this.high));
    this.show();
  }

  pick(count) {
    const most = this.model.get("most") || Infinity;
    const possible = Math.max(2, Math.min(most, count));
    this.picked = possible === this.count ? 0 : possible;
    this.show();
    this.model.set("picked", possible);
    this.model.save_changes();
  }

  point(count) {
    this.pointed = count;
    this.show();
  }

  show() {
    this.at = this.pointed || this.picked || this.count;
    this.readout.textContent = this.at ? this.describe(this.at) : "";
    this.canvas.setAttribute("aria-valuenow", String(this.at));
    this.canvas.setAttribute("aria-valuetext", this.readout.textContent);
    this.draw();
  }

  describe(count) {
    const own = count === this.count && this.error !== null ? [`chosen ${this.error.toPrecision(3)}`] : [];
    const others = this.series.flatMap(({ name, counts, errors }) => {
      const i = counts.indexOf(count);
      return i < 0 ? [] : [`${name} ${errors[i].toPrecision(3)}`];
    });
    return [`${count} keyframes`, ...own, ...others].join(" · ");
  }

  xOf(count) {
    return COUNTS.left + ((count - this.low) / (this.high - this.low)) * (this.width - COUNTS.left - COUNTS.right);
  }

  yOf(error) {
    return COUNTS.top + (1 - error / this.top) * (COUNTS.tall - COUNTS.top - COUNTS.bottom);
  }

  countAt(x) {
    const part = (x - COUNTS.left) / (this.width - COUNTS.left - COUNTS.right);
    return Math.max(this.low, Math.min(this.high, Math.round(this.low + part * (this.high - this.low))));
  }

  draw() {
    this.width = this.canvas.clientWidth;
    if (!this.width || !this.series) return;
    const context = fitCanvas(this.canvas, this.width, COUNTS.tall);
    const theme = themeOf(this.root);
    this.drawAxes(context, theme);
    this.series.forEach(({ counts, errors }, i) => {
      context.strokeStyle = context.fillStyle = theme.palette[i % theme.palette.length];
      context.setLineDash(COUNT_DASH[i % COUNT_DASH.length]);
      context.lineWidth = 2;
      context.beginPath();
      counts.forEach((count, k) => context[k ? "lineTo" : "moveTo"](this.xOf(count), this.yOf(errors[k])));
      context.stroke();
      context.setLineDash([]);
      counts.forEach((count, k) => this.dot(context, count, errors[k], 2.6));
    });
    context.fillStyle = theme.text;
    if (this.count && this.error !== null) this.dot(context, this.count, this.error, 5.5);
    if (this.at && this.at !== this.count) {
      context.globalAlpha = 0.5;
      context.fillRect(this.xOf(this.at) - 0.5, COUNTS.top, 1, COUNTS.tall - COUNTS.top - COUNTS.bottom);
      context.globalAlpha = 1;
    }
    const swatch = (i) => `background: ${theme.palette[i % theme.palette.length]}`;
    const keys = this.series.map(({ name }, i) => element("span", {}, [element("i", { style: swatch(i) }), name]));
    this.legend.replaceChildren(...keys, ...(this.count ? [element("span", { text: "● chosen" })] : []));
  }

  dot(context, count, error, size) {
    context.beginPath();
    context.arc(this.xOf(count), this.yOf(error), size, 0, 2 * Math.PI);
    context.fill();
  }

  drawAxes(context, theme) {
    context.fillStyle = theme.text;
    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "middle";
    const step = (range, parts) => {
      const power = 10 ** Math.floor(Math.log10(range / parts));
      return [1, 2, 5, 10].map((m) => m * power).find((s) => s >= range / parts);
    };
    const up = step(this.top, 4);
    context.textAlign = "right";
    for (let error = 0; error <= this.top * 1.001; error += up) {
      context.globalAlpha = 0.18;
      context.fillRect(COUNTS.left, this.yOf(error) - 0.5, this.width - COUNTS.left - COUNTS.right, 1);
      context.globalAlpha = 0.9;
      context.fillText(String(Number(error.toPrecision(6))), COUNTS.left - 6, this.yOf(error));
    }
    const across = Math.max(1, step(this.high - this.low, Math.max(3, this.width / 90)));
    context.textAlign = "center";
    const bottom = COUNTS.tall - COUNTS.bottom;
    for (let count = Math.ceil(this.low / across) * across; count <= this.high; count += across) {
      context.fillText(String(count), this.xOf(count), bottom + 11);
    }
    context.fillText("number of keyframes", (COUNTS.left + this.width - COUNTS.right) / 2, bottom + 26);
    context.globalAlpha = 1;
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-player wb-player-count" });
    el.append(root);
    root.counts = new CountCurve(model, root, stop.signal);
    return () => stop.abort();
  },
};
