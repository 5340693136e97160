// Which events of mouse and keyboard mean what on the pad.

const PAD_HINT = "Space plays, comma and full stop step. Wheel, + or − zooms the focused plane, Shift and drag moves it.";

const TEXT_FIELDS = "input[type=number], input[type=text]"; // they undo what is typed there

class PadInput {
  constructor(pad, signal) {
    Object.assign(this, { pad, signal });
    const { plot } = pad.plane;
    const on = (type, act, options = {}) => plot.addEventListener(type, act, { signal, ...options });
    on("pointerdown", (event) => this.press(event));
    on("pointermove", (event) => this.move(event));
    on("pointerup", (event) => this.release(event));
    on("pointercancel", () => this.abandon());
    on("pointerleave", () => {
      const { hand } = pad;
      if (hand.held || this.pressed) return;
      hand.index = -1;
      pad.lookAway();
    });
    on("dblclick", (event) => pad.mode === "markers" && pad.addMarker(pad.plane.toPlace(this.at(event))));
    on("wheel", (event) => this.wheel(event), { passive: false });
    pad.root.addEventListener("keydown", (event) => this.key(event), { signal });
  }

  at({ clientX, clientY }) {
    const box = this.pad.plane.base.getBoundingClientRect();
    return [clientX - box.left, clientY - box.top];
  }

  press(event) {
    const { pad } = this;
    if (!pad.scene || this.pressed) return;
    pad.pose.finish();
    pad.words.say("");
    if (event.button > 1) return;
    pad.plane.plot.setPointerCapture(event.pointerId);
    const pans = event.button === 1 || event.shiftKey;
    if (pans) event.preventDefault(); // the browser's own scrolling
    this.pressed = { pans, last: this.at(event) };
    if (!pans) pad.hand.press(this.at(event), event);
    pad.drawTop();
  }

  move(event) {
    const { pad, pressed } = this;
    if (!pad.scene) return;
    const at = this.at(event);
    if (!pressed) return pad.hand.hover(at);
    if (pressed.pans) {
      pad.plane.pan(at[0] - pressed.last[0], at[1] - pressed.last[1]);
      pressed.last = at;
      pad.drawBase();
      return pad.drawTop();
    }
    const coalesced = event.getCoalescedEvents?.() ?? [];
    const steps = (coalesced.length ? coalesced : [event]).map((step) => [this.at(step), step.timeStamp / 1000]);
    pad.hand.move(at, event, steps);
  }

  release(event) {
    const { pad, pressed } = this;
    this.pressed = null;
    if (pressed && !pressed.pans) pad.hand.release(this.at(event), event);
    if (pad.scene) pad.drawTop();
  }

  /** Put back what is held, wherever. */
  abandon() {
    const { pad } = this;
    this.pressed = null;
    if (pad.clock.curve.held) pad.clock.curve.abandon();
    else if (pad.pose.start) pad.pose.abandon();
    else {
      const { held } = pad.hand;
      pad.hand.abandon();
      if (held) pad.words.say("put back");
    }
  }

  wheel(event) {
    const { pad } = this;
    // Only where the person is at work here: elsewhere the wheel scrolls the page.
    if (!pad.scene || (document.activeElement !== pad.plane.plot && !event.ctrlKey)) return;
    event.preventDefault();
    if (!event.ctrlKey && !event.shiftKey && pad.hand.wheel(event.deltaY)) return;
    pad.zoom(1.0015 ** -(event.deltaY || event.deltaX), this.at(event));
  }

  key(event) {
    const { pad } = this;
    const typing = event.target.closest("select, input");
    if (event.ctrlKey || event.metaKey) return event.target.closest(TEXT_FIELDS) ? undefined : this.history(event);
    if (event.altKey || !pad.scene) return;
    // JupyterLab would take it as a command to its cells, even one that means nothing here.
    if (event.key.length === 1) event.stopPropagation();
    const isButton = event.target.closest("button");
    const puttingBack = event.key === "Escape" && pad.holding;
    const itsOwn = typing || (isButton && [" ", "Enter"].includes(event.key));
    if (itsOwn && !puttingBack) return event.stopPropagation();
    if (!this.act(event)) return;
    event.stopPropagation();
    event.preventDefault();
  }

  history(event) {
    const { pad } = this;
    const way = { z: event.shiftKey ? "redo" : "undo", y: "redo" }[event.key.toLowerCase()];
    if (!way || !pad.model.get("editable")) return;
    event.stopPropagation();
    event.preventDefault();
    if (pad.pose.start && way === "undo") pad.pose.abandon();
    else if (!pad.holding && pad.model.get(`${way}_label`)) pad.tell(way);
  }

  /** Do what a key says; tell whether it says something. */
  act(event) {
    const { pad } = this;
    if (event.key === "Escape" && (pad.holding || this.pressed)) return this.abandon() ?? true;
    if (event.key === "Escape" && pad.pinned) return pad.pin(null) ?? true;
    if (event.target === pad.plane.plot && (pad.hand.key(event) || this.look(event))) return true;
    if (event.target === pad.clock.curve.canvas && pad.clock.curve.key(event)) return true;
    if (event.target === pad.clock.bar.canvas && this.seek(event)) return true;
    const acts = { " ": () => pad.play(!pad.playing), ",": () => pad.step(-1), ".": () => pad.step(1), f: () => pad.showAll() };
    if (pad.model.get("editable")) {
      for (const [mode, [, key]] of Object.entries(PAD_MODES)) acts[key] = () => pad.change("mode", mode);
      acts.a = () => pad.addMarker(pad.place);
      acts.Delete = acts.Backspace = () => pad.removeMarker();
    }
    const act = acts[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    act?.();
    return Boolean(act);
  }

  look({ key }) {
    const factor = { "+": 1.25, "-": 0.8 }[key];
    if (factor) this.pad.zoom(factor, this.pad.plane.toPixel(this.pad.place));
    return Boolean(factor);
  }

  seek({ key }) {
    const { pad } = this;
    const frame = pad.scene.frameAt(pad.time);
    const to = {
      ArrowLeft: frame - 1, ArrowRight: frame + 1, ArrowDown: frame - 10, ArrowUp: frame + 10, Home: 0, End: pad.scene.frames - 1,
      PageUp: pad.clock.bar.keyNear(frame, -1), PageDown: pad.clock.bar.keyNear(frame, 1),
    }[key];
    if (to !== undefined) pad.scrub(pad.timeOf(to), true);
    return to !== undefined;
  }
}
