// A bar of time to scrub on, with keyframes and the feet's contacts marked. It is a slider to
// screen readers.

const BAR = { side: 10, track: 12, row: 9, top: 8 };

class TimeBar {
  /** `seek(frame, done)` is called while someone scrubs, and with done = true at the end. */
  constructor(seek, signal) {
    Object.assign(this, { seek, frames: 0, frame: 0, keyframes: [], contacts: [] });
    this.canvas = element("canvas", { class: "wb-player-bar", tabindex: "0", role: "slider", "aria-label": "Time", "aria-valuemin": "0" });
    const on = (type, act) => this.canvas.addEventListener(type, act, { signal });
    on("pointerdown", (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      this.scrubbing = true;
      this.seek(this.frameAt(event.offsetX), false);
    });
    on("pointermove", (event) => this.scrubbing && this.seek(this.frameAt(event.offsetX), false));
    for (const type of ["pointerup", "pointercancel"]) {
      on(type, (event) => {
        if (!this.scrubbing) return;
        this.scrubbing = false;
        this.seek(this.frameAt(event.offsetX), true);
      });
    }
  }

  take({ frames, keyframes, contacts }) {
    Object.assign(this, { frames, keyframes, contacts, key: new Set(keyframes) });
    this.canvas.setAttribute("aria-valuemax", String(Math.max(0, frames - 1)));
  }

  get height() {
    return BAR.top + BAR.track + BAR.row * this.contacts.length + 4;
  }

  xOf(frame) {
    return BAR.side + (frame / Math.max(1, this.frames - 1)) * (this.canvas.clientWidth - 2 * BAR.side);
  }

  frameAt(x) {
    const part = (x - BAR.side) / Math.max(1, this.canvas.clientWidth - 2 * BAR.side);
    return Math.max(0, Math.min(this.frames - 1, Math.round(part * (this.frames - 1))));
  }

  /** The keyframe before (-1) or after (1) a frame, or the clip's end where there is none. */
  keyNear(frame, way) {
    const found = way > 0 ? this.keyframes.find((key) => key > frame) : this.keyframes.findLast((key) => key < frame);
    return found ?? (way > 0 ? this.frames - 1 : 0);
  }

  /** Draw what stays, onto a layer that each frame is copied from. */
  drawLayer(theme, brand) {
    const width = this.canvas.clientWidth;
    if (!width) return;
    this.layer ??= document.createElement("canvas");
    const context = fitCanvas(this.layer, width, this.height);
    this.canvas.style.height = `${this.height}px`;
    const [left, right] = [this.xOf(0), this.xOf(this.frames - 1)];
    context.fillStyle = theme.text;
    context.globalAlpha = 0.22;
    context.fillRect(left, BAR.top + BAR.track / 2 - 2, right - left, 4);
    const half = this.frames > 1 ? (this.xOf(1) - this.xOf(0)) / 2 : 2;
    this.contacts.forEach(({ side, spans }, row) => {
      const y = BAR.top + BAR.track + row * BAR.row + 2;
      context.globalAlpha = 0.16;
      context.fillStyle = theme.text;
      context.fillRect(left, y + 2, right - left, 1);
      context.globalAlpha = 1;
      for (const [first, last] of spans) {
        const from = Math.max(left, this.xOf(first) - half);
        fillSide(context, side, theme, from, y, Math.max(2, Math.min(right, this.xOf(last) + half) - from), 6);
      }
    });
    context.globalAlpha = 1;
    context.fillStyle = theme.text;
    for (const key of this.keyframes) {
      const x = this.xOf(key);
      context.beginPath();
      context.moveTo(x, BAR.top + BAR.track / 2 - 5);
      context.lineTo(x + 4, BAR.top + BAR.track / 2);
      context.lineTo(x, BAR.top + BAR.track / 2 + 5);
      context.lineTo(x - 4, BAR.top + BAR.track / 2);
      context.fill();
    }
    this.brand = brand;
  }

  draw(frame, text) {
    this.frame = frame;
    this.canvas.setAttribute("aria-valuenow", String(frame));
    this.canvas.setAttribute("aria-valuetext", text);
    const width = this.canvas.clientWidth;
    if (!width || !this.layer) return;
    const context = emptied(this.canvas, width, this.height);
    context.drawImage(this.layer, 0, 0, width, this.height);
    const x = this.xOf(frame);
    context.fillStyle = this.brand;
    context.fillRect(x - 1, 2, 2, this.height - 4);
    context.beginPath();
    context.arc(x, BAR.top + BAR.track / 2, 5.5, 0, 2 * Math.PI);
    context.fill();
  }
}
