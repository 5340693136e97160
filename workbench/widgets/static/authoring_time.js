// The pad's time: playing, a bar to scrub on, and the time curve below it in the same scale.

class PadTime {
  constructor(pad, signal) {
    this.pad = pad;
    const button = (text, label, act) => {
      const node = element("button", { type: "button", text, "aria-label": label, title: label });
      node.addEventListener("click", act, { signal });
      return node;
    };
    this.toggle = button("Play", "Play (space)", () => pad.play(!pad.playing));
    this.toggle.classList.add("wb-player-toggle");
    const step = element("span", { class: "wb-group" }, [
      button("◂", "Frame before (,)", () => pad.step(-1)),
      button("▸", "Frame after (.)", () => pad.step(1)),
    ]);
    this.looping = button("Loop", "Loop", () => pad.change("loop", !pad.model.get("loop")));
    this.ghost = button("Ghost", "Draw the original behind the pose", () => pad.change("show_ghost", !pad.model.get("show_ghost")));
    this.speed = element("select", { "aria-label": "Speed" }, [[0.25, "¼ ×"], [0.5, "½ ×"], [1, "1 ×"], [2, "2 ×"]].map(([value, text]) => element("option", { value: String(value), text })));
    this.speed.addEventListener("change", () => pad.change("speed", Number(this.speed.value)), { signal });
    this.readout = element("span", { class: "wb-hover" });
    this.bar = new TimeBar((frame, done) => pad.scrub(pad.timeOf(frame), done), signal);
    this.curve = new TimeCurve(pad, signal);
    const controls = element("div", { class: "wb-bar wb-player-controls" }, [this.toggle, step, this.speed, this.looping, this.ghost, this.readout]);
    this.node = element("div", { class: "wb-pad-time" }, [controls, this.bar.canvas, this.curve.canvas]);
  }

  read(scene) {
    const last = scene.times.length - 1;
    const keys = scene.follows ? scene.markerFrames.filter((frame) => frame >= 0 && frame <= last).map((frame) => scene.frameAt(scene.times[frame])) : [];
    this.bar.take({ frames: scene.frames, keyframes: keys.sort((a, b) => a - b), contacts: [] });
    this.curve.read(scene);
  }

  showControls() {
    const { model, playing } = this.pad;
    this.toggle.textContent = playing ? "Pause" : "Play";
    this.toggle.setAttribute("aria-label", playing ? "Pause" : "Play");
    this.curve.showControls(model.get("editable"));
    this.looping.setAttribute("aria-pressed", String(model.get("loop")));
    this.ghost.setAttribute("aria-pressed", String(model.get("show_ghost")));
    this.speed.value = String(model.get("speed"));
  }

  redraw() {
    const { left, wide } = this.curve.span;
    Object.assign(this.bar.canvas.style, { marginLeft: `${left - BAR.side}px`, width: `${wide + 2 * BAR.side}px` });
    this.bar.drawLayer(this.pad.theme, this.pad.theme.brand);
    this.curve.drawLayer();
    this.draw();
  }

  draw() {
    const { pad } = this;
    const { scene } = pad;
    const frame = scene.frameAt(pad.time);
    const text = `${(pad.time - scene.start).toFixed(2)} s of ${scene.duration.toFixed(2)} s · frame ${frame}`;
    this.readout.textContent = text;
    this.bar.draw(frame, text);
    this.curve.draw();
  }
}
