// Curves of a motion over time: coloured by saliency, candidates below each, keyframes across
// all, and the feet's contacts at the bottom.

const ROWS = { left: 92, right: 12, top: 16, tall: 46, bar: 5, gap: 7, foot: 14, axis: 28 };
const LEVELS = 8;
const MOST_SALIENT = 3; // times the mean, where colours end
const SALIENCY_STOPS = {
  light: [[176, 190, 204], [92, 152, 205], [30, 92, 158], [8, 22, 48]],
  dark: [[78, 90, 102], [72, 140, 196], [140, 205, 250], [246, 251, 255]],
};
const KEY_SHAPES = { usual: [[0, -5], [4, 0], [0, 5], [-4, 0]], foot: [[-4.5, -4.5], [4.5, -4.5], [0, 5]] };
const CURVES_HINT = "Press or drag, or use arrow keys, to show a frame in the player.";

class TimeCurves {
  constructor(model, root, signal) {
    Object.assign(this, { model, root, frame: 0 });
    this.base = element("canvas", { class: "wb-base" });
    this.over = element("canvas", { tabindex: "0", role: "slider", "aria-label": "Frame on the curves", "aria-valuemin": "0", title: CURVES_HINT });
    this.box = element("div", { class: "wb-player-curves" }, [this.base, this.over]);
    this.message = element("div", { class: "wb-detail" });
    this.readout = element("div", { class: "wb-detail" });
    this.legend = element("div", { class: "wb-sides" });
    root.append(this.message, this.box, this.readout, this.legend);
    onTraits(model, ["rows", "values", "weights", "candidates", "keyframes", "foot_keyframes", "contacts", "frame_time", "message"], () => this.read(), signal);
    onHover(model, (frame) => !this.announcing && frame >= 0 && this.show(frame), signal);
    watchTheme(() => this.draw(), signal);
    const observer = new ResizeObserver(() => this.box.clientWidth !== this.width && this.draw());
    observer.observe(root);
    signal.addEventListener("abort", () => observer.disconnect());
    this.listen(signal);
    this.frame = model.get("frame");
    this.read();
  }

  read() {
    const { model } = this;
    this.rows = model.get("rows");
    this.values = typed(model.get("values"), Float32Array);
    this.weights = typed(model.get("weights"), Float32Array);
    this.candidates = typed(model.get("candidates"), Uint8Array);
    this.keyframes = [...typed(model.get("keyframes"), Int32Array)];
    this.onFeet = new Set(typed(model.get("foot_keyframes"), Int32Array));
    this.contacts = model.get("contacts");
    const frames = this.rows.length ? this.values.length / this.rows.length : 0;
    // Traits of another clip may come one after the other.
    const fits = Number.isInteger(frames) && this.weights.length === this.values.length && this.candidates.length === this.values.length;
    this.frames = fits ? frames : 0;
    this.message.textContent = model.get("message");
    this.box.hidden = this.frames < 2;
    this.over.setAttribute("aria-valuemax", String(Math.max(0, this.frames - 1)));
    this.frame = Math.max(0, Math.min(this.frame, this.frames - 1));
    this.draw();
  }

  listen(signal) {
    const on = (type, act) => this.over.addEventListener(type, act, { signal });
    on("pointerdown", (event) => {
      this.over.setPointerCapture(event.pointerId);
      this.pressed = true;
      this.ask(this.frameAt(event.offsetX));
    });
    on("pointermove", (event) => {
      if (this.pressed) this.ask(this.frameAt(event.offsetX));
      this.tell(this.frameAt(event.offsetX), event.offsetY);
    });
    for (const type of ["pointerup", "pointercancel"]) on(type, () => (this.pressed = false));
    on("pointerleave", () => this.tell(this.frame));
    on("keydown", (event) => {
      const steps = { ArrowLeft: -1, ArrowRight: 1, ArrowDown: -10, ArrowUp: 10, Home: -Infinity, End: Infinity };
      if (!(event.key in steps) || event.shiftKey) return;
      event.preventDefault();
      event.stopPropagation();
      this.ask(Math.max(0, Math.min(this.frame + steps[event.key], this.frames - 1)));
    });
  }

  /** Show a frame here and wherever else the channel is heard. */
  ask(frame) {
    this.show(frame);
    this.announcing = true;
    announceHover(this.model.get("channel"), frame);
    this.announcing = false;
  }

  show(frame) {
    if (frame >= this.frames) return;
    this.frame = frame;
    this.drawOver();
    this.tell(frame);
  }

  tell(frame, y) {
    if (!this.frames) return;
    const row = y === undefined ? -1 : Math.floor((y - ROWS.top) / this.pitch);
    const text = `frame ${frame} · ${(frame * this.model.get("frame_time")).toFixed(2)} s`;
    const named = this.rows[row] ? ` · ${this.rows[row].name}: ${this.describe(row, frame)}` : "";
    this.readout.textContent = `${text}${this.aboutKey(frame)}${named}`;
    this.over.setAttribute("aria-valuenow", String(frame));
    this.over.setAttribute("aria-valuetext", this.readout.textContent);
  }

  aboutKey(frame) {
    if (!this.keyframes.includes(frame)) return "";
    return this.onFeet.has(frame) ? " · keyframe, found on a foot" : " · keyframe";
  }

  describe(row, frame) {
    const i = row * this.frames + frame;
    const { kind, unit } = this.rows[row];
    if (kind !== "curve") return `${this.values[i].toPrecision(3)} ${unit}`;
    return `saliency ${this.weights[i].toFixed(2)} × mean${this.candidates[i] ? ", candidate" : ""}`;
  }

  get pitch() {
    return ROWS.tall + ROWS.bar + ROWS.gap;
  }

  get height() {
    return ROWS.top + this.rows.length * this.pitch + this.contacts.length * ROWS.foot + ROWS.axis;
  }

  xOf(frame) {
    return ROWS.left + (frame / Math.max(1, this.frames - 1)) * (this.width - ROWS.left - ROWS.right);
  }

  frameAt(x) {
    const part = (x - ROWS.left) / (this.width - ROWS.left - ROWS.right);
    return Math.max(0, Math.min(this.frames - 1, Math.round(part * (this.frames - 1))));
  }

  draw() {
    this.width = this.box.clientWidth;
    if (!this.width || !this.frames) return;
    this.box.style.height = `${this.height}px`;
    this.theme = themeOf(this.root);
    this.ramp = Array.from({ length: LEVELS }, (_, i) => mixed(SALIENCY_STOPS[this.theme.name], i / (LEVELS - 1)));
    const context = fitCanvas(this.base, this.width, this.height);
    this.drawKeys(context);
    this.rows.forEach((row, r) => this.drawRow(context, row, r));
    this.drawContacts(context);
    this.drawAxis(context);
    this.showLegend();
    this.over.width = 0; // made anew in the new size
    this.drawOver();
    this.tell(this.frame);
  }

  drawKeys(context) {
    const bottom = this.height - ROWS.axis;
    context.fillStyle = context.strokeStyle = this.theme.text;
    for (const key of this.keyframes) {
      const x = this.xOf(key);
      context.globalAlpha = 0.32;
      context.fillRect(x - 0.5, ROWS.top - 4, 1, bottom - ROWS.top + 4);
      context.globalAlpha = 1;
      context.beginPath();
      KEY_SHAPES[this.onFeet.has(key) ? "foot" : "usual"].forEach(([dx, dy], i) => context[i ? "lineTo" : "moveTo"](x + dx, 7 + dy));
      context.fill();
    }
  }

  drawRow(context, { name, kind, note = "" }, r) {
    const top = ROWS.top + r * this.pitch;
    const values = this.values.subarray(r * this.frames, (r + 1) * this.frames);
    let [low, high] = [kind === "curve" ? Infinity : 0, -Infinity];
    for (const v of values) [low, high] = [Math.min(low, v), Math.max(high, v)];
    const y = (v) => top + 2 + (1 - (v - low) / (high - low || 1)) * (ROWS.tall - 4);
    this.drawLabel(context, name, kind === "curve" ? note : `max ${Number(high.toPrecision(2))}`, top);
    if (kind === "curve") this.drawSalient(context, values, r, y);
    else this.drawAmount(context, values, y, top + ROWS.tall);
    context.fillStyle = this.theme.palette[2];
    const half = (this.xOf(1) - this.xOf(0)) / 2;
    for (let f = 0; f < this.frames; f++) {
      if (!this.candidates[r * this.frames + f]) continue;
      const first = f;
      while (f + 1 < this.frames && this.candidates[r * this.frames + f + 1]) f++;
      context.fillRect(this.xOf(first) - half, top + ROWS.tall + 1, this.xOf(f) - this.xOf(first) + 2 * half, ROWS.bar - 1);
    }
  }

  drawLabel(context, name, detail, top) {
    context.fillStyle = this.theme.text;
    context.textAlign = "left";
    context.textBaseline = "middle";
    context.font = "12px system-ui, sans-serif";
    context.fillText(name, 4, top + ROWS.tall / 2 - (detail ? 7 : 0), ROWS.left - 12);
    if (!detail) return;
    context.globalAlpha = 0.75;
    context.font = "11px system-ui, sans-serif";
    context.fillText(detail, 4, top + ROWS.tall / 2 + 8, ROWS.left - 12);
    context.globalAlpha = 1;
  }

  /** Draw a curve in as many strokes as there are colours, not as there are frames. */
  drawSalient(context, values, r, y) {
    const level = (f) => {
      const weight = this.weights[r * this.frames + f];
      return Math.max(0, Math.min(LEVELS - 1, Math.floor((weight / MOST_SALIENT) * LEVELS)));
    };
    context.lineCap = "round";
    for (let shade = 0; shade < LEVELS; shade++) {
      context.beginPath();
      for (let f = 1; f < this.frames; f++) {
        if (level(f) !== shade) continue;
        context.moveTo(this.xOf(f - 1), y(values[f - 1]));
        context.lineTo(this.xOf(f), y(values[f]));
      }
      context.strokeStyle = this.ramp[shade];
      context.lineWidth = 1.6 + (1.6 * shade) / LEVELS;
      context.stroke();
    }
  }

  drawAmount(context, values, y, bottom) {
    context.beginPath();
    values.forEach((v, f) => context[f ? "lineTo" : "moveTo"](this.xOf(f), y(v)));
    context.strokeStyle = this.theme.palette[3];
    context.lineWidth = 1.6;
    context.stroke();
    context.lineTo(this.xOf(this.frames - 1), bottom);
    context.lineTo(this.xOf(0), bottom);
    context.globalAlpha = 0.16;
    context.fillStyle = this.theme.palette[3];
    context.fill();
    context.globalAlpha = 1;
  }

  drawContacts(context) {
    const top = ROWS.top + this.rows.length * this.pitch;
    const half = (this.xOf(1) - this.xOf(0)) / 2;
    context.font = "11px system-ui, sans-serif";
    this.contacts.forEach(({ name, side, spans }, row) => {
      const y = top + row * ROWS.foot;
      context.fillStyle = this.theme.text;
      context.fillText(name, 4, y + 4, ROWS.left - 12);
      for (const [first, last] of spans) fillSide(context, side, this.theme, this.xOf(first) - half, y + 1, this.xOf(last) - this.xOf(first) + 2 * half, 6);
    });
  }

  drawAxis(context) {
    const y = this.height - ROWS.axis + 6;
    const seconds = (this.frames - 1) * this.model.get("frame_time");
    const rough = seconds / Math.max(2, Math.min(8, (this.width - ROWS.left) / 80));
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough);
    context.fillStyle = this.theme.text;
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "center";
    for (let i = 0; i * step <= seconds * 1.0001; i++) {
      const x = this.xOf((i * step) / this.model.get("frame_time"));
      context.globalAlpha = 0.5;
      context.fillRect(x - 0.5, y - 4, 1, 4);
      context.globalAlpha = 0.9;
      context.fillText(`${Number((i * step).toPrecision(6))} s`, Math.min(x, this.width - 16), y + 10);
    }
    context.globalAlpha = 1;
  }

  drawOver() {
    if (!this.width || !this.frames) return;
    const ratio = window.devicePixelRatio || 1;
    const fits = this.over.width === Math.round(this.width * ratio);
    const context = fits ? this.over.getContext("2d") : fitCanvas(this.over, this.width, this.height);
    context.clearRect(0, 0, this.width, this.height);
    context.fillStyle = getComputedStyle(this.root).getPropertyValue("--wb-brand") || this.theme.text;
    context.fillRect(this.xOf(this.frame) - 1, 2, 2, this.height - ROWS.axis);
  }

  showLegend() {
    const mark = (style, text) => element("span", {}, [element("i", { style }), text]);
    const some = this.candidates.some(Boolean);
    const parts = this.rows.some(({ kind }) => kind === "curve")
      ? [mark(`background: linear-gradient(to right, ${this.ramp.join(", ")}); width: 60px; height: 8px`, `saliency, 0 to ${MOST_SALIENT} × its mean`)]
      : [];
    if (some) parts.push(mark(`background: ${this.theme.palette[2]}`, "candidate: above the mean"));
    if (this.keyframes.length) parts.push(element("span", { text: "◆ keyframe" }));
    if (this.onFeet.size) parts.push(element("span", { text: "▼ keyframe found on a foot" }));
    if (this.contacts.length) parts.push(element("span", { text: "▬ foot on the ground" }));
    this.legend.replaceChildren(...parts);
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-player wb-player-time" });
    el.append(root);
    root.curves = new TimeCurves(model, root, stop.signal);
    return () => stop.abort();
  },
};
