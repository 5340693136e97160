// The time curve: how far along the trajectory is at which second, with handles that retime.

const CURVE_TALL = 150;
const CURVE_EDGE = { left: 48, right: 14, top: 10, bottom: 32 };
const CURVE_ROOM = 1.12; // of the duration, so that the end can be moved out
const HANDLES = 8; // parts of a trajectory without markers of its own
const HANDLE_REACH = 12;
const CURVE_HINT = "Time curve. Press or drag to go to a time; arrow keys lead from key pose to key pose.";
const RETIMING_HINT = "Time curve. Drag a handle to change when the trajectory is there; Shift moves all that is later as well. Arrow keys lead from handle to handle, Enter picks one up and drops it, Escape puts it back.";

class TimeCurve {
  constructor(pad, signal) {
    Object.assign(this, { pad, handle: 0, held: false, handles: [] });
    this.canvas = element("canvas", { class: "wb-pad-curve", tabindex: "0", role: "application" });
    const on = (type, act) => this.canvas.addEventListener(type, act, { signal });
    on("pointerdown", (event) => this.press(event));
    on("pointermove", (event) => this.move(event));
    for (const type of ["pointerup", "pointercancel"]) on(type, () => this.release());
    for (const type of ["focus", "blur"]) on(type, () => this.redraw());
  }

  showControls(editable) {
    this.canvas.title = editable ? RETIMING_HINT : CURVE_HINT;
    this.canvas.setAttribute("aria-label", this.canvas.title);
  }

  /** Take the handles of a scene: its key poses, or even parts of the way. */
  read(scene) {
    const lengths = lengthsAlong(scene.points);
    const last = lengths.length - 1;
    this.along = lengths[last] > 0 ? lengths.map((v) => v / lengths[last]) : lengths.map((_, i) => i / last);
    const even = Array.from({ length: HANDLES - 1 }, (_, i) => this.along.findIndex((v) => v >= (i + 1) / HANDLES));
    const inner = (scene.follows ? scene.markerFrames.filter((frame) => frame > 0 && frame < last) : even).sort((a, b) => a - b);
    const gap = 0.03 * scene.duration;
    const apart = [0];
    for (const i of inner) {
      if (scene.times[i] - scene.times[apart.at(-1)] > gap && scene.times[last] - scene.times[i] > gap) apart.push(i);
    }
    this.handles = [...apart, last];
    this.handle = Math.min(this.handle, this.handles.length - 1);
    this.longest = CURVE_ROOM * scene.duration;
  }

  get width() {
    return this.canvas.clientWidth;
  }

  /** Where the trajectory's time begins, and how wide it is, in pixels. */
  get span() {
    const { left, right } = CURVE_EDGE;
    return { left, wide: (this.width - left - right) / CURVE_ROOM };
  }

  pixel(time, along) {
    const { left, right, top, bottom } = CURVE_EDGE;
    const x = left + ((time - this.pad.scene.start) / this.longest) * (this.width - left - right);
    return [x, top + (1 - along) * (CURVE_TALL - top - bottom)];
  }

  timeAt(x) {
    const { left, right } = CURVE_EDGE;
    return this.pad.scene.start + ((x - left) / Math.max(1, this.width - left - right)) * this.longest;
  }

  // What a person does.

  press(event) {
    const { pad } = this;
    this.canvas.setPointerCapture(event.pointerId);
    let [best, nearest] = [-1, HANDLE_REACH];
    if (pad.model.get("editable")) {
      this.handles.forEach((i, h) => {
        const [x, y] = this.pixel(pad.scene.times[i], this.along[i]);
        const distance = Math.hypot(x - event.offsetX, y - event.offsetY);
        if (h > 0 && distance <= nearest) [best, nearest] = [h, distance];
      });
    }
    this.dragging = best < 0 ? "time" : "handle";
    if (best < 0) return this.move(event);
    this.handle = best;
    this.lift();
    this.redraw();
  }

  move(event) {
    if (this.dragging === "time") this.pad.scrub(this.timeAt(event.offsetX), false);
    if (this.dragging === "handle" && this.held) this.put(this.timeAt(event.offsetX), event.shiftKey);
  }

  release() {
    if (this.dragging === "time") this.pad.scrub(this.pad.time, true);
    if (this.dragging === "handle" && this.held) this.drop();
    this.dragging = null;
  }

  lift() {
    this.held = true;
    this.pad.hold();
    this.before = this.pad.scene.times;
    this.to = null;
  }

  /** Give the held handle another time, between those of its neighbours. */
  put(time, withLater) {
    const { before, handles, handle, pad } = this;
    const old = handles.map((i) => before[i]);
    const gap = 0.5 * pad.scene.frameTime;
    const latest = withLater || handle === handles.length - 1 ? pad.scene.start + this.longest * 4 : old[handle + 1] - gap;
    this.to = Math.max(old[handle - 1] + gap, Math.min(latest, time));
    const shift = this.to - old[handle];
    pad.scene.takeTimes(retimed(before, handles, old.map((t, h) => (h === handle || (withLater && h > handle) ? t + shift : t))));
    pad.drawBase();
    pad.showTime();
  }

  drop() {
    const { pad, before, to, handle } = this;
    this.held = false;
    const same = to === null || to === before[this.handles[handle]];
    pad.letGo(same);
    if (!same) {
      pad.words.say("timing changed");
      pad.tell("retime", { times: [...pad.scene.times] });
    }
  }

  abandon() {
    this.held = false;
    this.dragging = null;
    this.pad.letGo(true);
  }

  key(event) {
    const { pad } = this;
    const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (event.key === "Enter" && pad.model.get("editable") && this.handle > 0) {
      if (this.held) this.drop();
      else this.lift();
    } else if (way && this.held) {
      const now = this.to ?? this.before[this.handles[this.handle]];
      this.put(now + way * (event.shiftKey ? 10 : 1) * pad.scene.frameTime, false);
    } else if (way) {
      this.handle = Math.max(0, Math.min(this.handles.length - 1, this.handle + way));
      pad.scrub(pad.scene.times[this.handles[this.handle]], true);
    } else return false;
    const i = this.handles[this.handle];
    pad.words.say(`handle ${this.handle + 1} of ${this.handles.length}, ${Math.round(100 * this.along[i])} percent at ${(pad.scene.times[i] - pad.scene.start).toFixed(2)} seconds`);
    this.redraw();
    return true;
  }

  // Pictures.

  /** Draw the curve onto a layer that each frame is copied from. */
  drawLayer() {
    const { pad, width } = this;
    if (!width || !pad.scene || !pad.theme) return;
    const { scene, theme } = pad;
    this.layer ??= document.createElement("canvas");
    const context = emptied(this.layer, width, CURVE_TALL);
    this.drawAxes(context, scene, theme);
    context.lineJoin = context.lineCap = "round";
    context.lineWidth = 2.4;
    strokeByTime(context, scene, ramp(TIME_STOPS[theme.name]), (from, to) => {
      context.beginPath();
      for (let i = from; i <= to; i++) context[i > from ? "lineTo" : "moveTo"](...this.pixel(scene.times[i], this.along[i]));
    });
    if (pad.model.get("editable")) this.handles.forEach((i, h) => this.drawHandle(context, scene.times[i], this.along[i], h));
  }

  draw() {
    const { width } = this;
    if (!width || !this.layer) return;
    const context = emptied(this.canvas, width, CURVE_TALL);
    context.drawImage(this.layer, 0, 0, width, CURVE_TALL);
    this.drawNow(context);
  }

  redraw() {
    this.drawLayer();
    this.draw();
  }

  drawAxes(context, scene, theme) {
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = context.strokeStyle = theme.text;
    context.lineWidth = 1;
    context.textBaseline = "middle";
    context.textAlign = "right";
    const line = (from, to) => {
      context.globalAlpha = 0.18;
      context.beginPath();
      context.moveTo(...from);
      context.lineTo(...to);
      context.stroke();
      context.globalAlpha = 0.9;
    };
    const end = scene.start + this.longest;
    for (const share of [0, 0.5, 1]) {
      line(this.pixel(scene.start, share), this.pixel(end, share));
      context.fillText(`${100 * share} %`, CURVE_EDGE.left - 7, this.pixel(scene.start, share)[1]);
    }
    context.textAlign = "center";
    const step = roundStep(this.longest, Math.max(2, Math.min(10, this.width / 90)));
    for (let t = 0; t <= this.longest; t += step) {
      const [x, y] = this.pixel(scene.start + t, 0);
      line([x, y], this.pixel(scene.start + t, 1));
      context.fillText(`${Number(t.toPrecision(6))} s`, x, y + 12);
    }
    context.textAlign = "left";
    context.fillText("along the trajectory, against time", CURVE_EDGE.left, CURVE_TALL - 6);
    context.globalAlpha = 1;
  }

  drawHandle(context, time, along, h) {
    const { theme } = this.pad;
    const [x, y] = this.pixel(time, along);
    const marked = h === this.handle && document.activeElement === this.canvas;
    const disc = (r, colour) => {
      context.beginPath();
      context.arc(x, y, r, 0, 2 * Math.PI);
      context.fillStyle = colour;
      context.fill();
    };
    if (marked || (this.held && h === this.handle)) disc(8.5, theme.brand);
    disc(5.5, theme.text);
    disc(3.8, h === 0 ? theme.text : theme.ground);
  }

  drawNow(context) {
    const { pad } = this;
    const [x, top] = this.pixel(pad.time, 1);
    context.fillStyle = pad.theme.brand;
    context.fillRect(x - 1, top - 4, 2, this.pixel(pad.time, 0)[1] - top + 8);
  }
}
