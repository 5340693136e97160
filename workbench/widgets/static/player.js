// The motion player. One clock for all motions, so that they cannot come apart; the frame is
// drawn from positions that are in the page already.

const SPEEDS_OF_PLAY = [[0.25, "¼ ×"], [0.5, "½ ×"], [1, "1 ×"], [2, "2 ×"]];
const LONGEST_LEAP = 0.25; // seconds that may pass between two pictures before time waits
const STAGE_TALLEST = 420;
const PLAYER_HINT =
  "Space plays, arrow keys step, Page keys go from key to key. Drag, or use Shift and arrow keys, to turn; wheel, + or − to zoom.";

class Player {
  constructor(model, root, signal) {
    Object.assign(this, { model, root, signal, time: 0, frame: -1, playing: false, request: 0 });
    this.names = element("div", { class: "wb-player-names" });
    this.canvas = element("canvas", { class: "wb-player-stage", tabindex: "0", role: "application", title: PLAYER_HINT });
    this.message = element("div", { class: "wb-player-message wb-detail", text: "no motion yet" });
    this.bar = new TimeBar((frame, done) => this.scrub(frame, done), signal);
    this.readout = element("span", { class: "wb-hover wb-player-readout" });
    this.makeControls();
    this.sides = element("div", { class: "wb-sides" });
    const stage = element("div", { class: "wb-player-box" }, [this.canvas, this.message]);
    root.append(this.names, stage, this.bar.canvas, this.controls, this.sides, element("p", { class: "wb-hint", text: PLAYER_HINT }));
    this.read();
    onTraits(model, ["positions", "parents", "sides", "head", "motions", "frame_time", "keyframes", "contacts", "description"], () => this.read(), signal);
    onTraits(model, ["frame"], () => model.get("frame") !== this.frame && this.seek(model.get("frame")), signal);
    onTraits(model, ["speed", "loop", "overlaid"], () => this.showControls(), signal);
    onHover(model, (frame) => !this.announcing && frame >= 0 && this.seek(frame), signal);
    watchTheme(() => this.redraw(), signal);
    const observer = new ResizeObserver(() => this.redraw());
    observer.observe(root);
    signal.addEventListener("abort", () => {
      observer.disconnect();
      cancelAnimationFrame(this.request);
    });
    this.listen();
    if (model.get("autoplay") && !matchMedia("(prefers-reduced-motion: reduce)").matches) this.play(true);
  }

  makeControls() {
    const button = (text, label, act) => {
      const node = element("button", { type: "button", text, "aria-label": label, title: label });
      node.addEventListener("click", act, { signal: this.signal });
      return node;
    };
    this.toggle = button("Play", "Play", () => this.play(!this.playing));
    this.toggle.classList.add("wb-player-toggle");
    const before = button("◂ Key", "Keyframe before", () => this.step(this.bar.keyNear(this.frame, -1)));
    const after = button("Key ▸", "Keyframe after", () => this.step(this.bar.keyNear(this.frame, 1)));
    this.keys = element("span", { class: "wb-group" }, [before, after]);
    this.looping = button("Loop", "Loop", () => this.change("loop", !this.model.get("loop")));
    this.overlay = button("Overlay", "Draw the motions over each other", () => this.change("overlaid", !this.model.get("overlaid")));
    this.speed = element("select", { "aria-label": "Speed" }, SPEEDS_OF_PLAY.map(([value, text]) => element("option", { value: String(value), text })));
    this.speed.addEventListener("change", () => this.change("speed", Number(this.speed.value)), { signal: this.signal });
    const zoom = orbitButtons(() => this.stage, () => this.draw(), this.signal);
    this.controls = element("div", { class: "wb-bar wb-player-controls" }, [this.toggle, this.keys, this.speed, this.looping, this.overlay, zoom, this.readout]);
  }

  read() {
    const { model } = this;
    const parents = model.get("parents");
    const positions = typed(model.get("positions"), Float32Array);
    const motions = Math.max(1, model.get("motions").length);
    const frames = parents.length ? positions.length / (3 * parents.length * motions) : 0;
    // Traits of another motion may come one after the other; what does not fit is not drawn.
    this.frames = Number.isInteger(frames) ? frames : 0;
    this.nodes = parents.length;
    this.motions = motions;
    const same = this.positions && positions.length === this.positions.length && positions.every((v, i) => v === this.positions[i]);
    this.positions = positions;
    if (!same || !this.stage) this.measure(parents);
    this.stage.parents = parents;
    this.stage.sides = model.get("sides");
    this.stage.head = model.get("head");
    this.bar.take({
      frames: this.frames,
      keyframes: [...typed(model.get("keyframes"), Int32Array)].filter((key) => key < this.frames),
      contacts: model.get("contacts"),
    });
    this.message.hidden = this.frames > 0;
    this.time = Math.max(0, Math.min(this.frame < 0 ? model.get("frame") : this.frame, this.frames - 1));
    this.frame = Math.floor(this.time);
    if (!this.frames) this.play(false);
    this.showControls();
  }

  /** Take the scale from all frames of all motions, so that it does not change while playing. */
  measure(parents) {
    const before = this.stage;
    this.stage = new Stage({ parents, sides: [] });
    if (before) this.stage.lookAs(before);
    this.stage.measure(Array.from({ length: this.motions * this.frames }, (_, i) => this.block(i)));
  }

  /** Positions of the i-th frame, counted through all motions. */
  block(i) {
    return this.positions.subarray(3 * this.nodes * i, 3 * this.nodes * (i + 1));
  }

  change(name, value) {
    this.model.set(name, value);
    this.model.save_changes();
    this.showControls();
  }

  showControls() {
    const { model } = this;
    this.looping.setAttribute("aria-pressed", String(model.get("loop")));
    this.overlay.setAttribute("aria-pressed", String(model.get("overlaid")));
    this.overlay.hidden = this.motions < 2;
    this.keys.hidden = !this.bar.keyframes.length;
    this.toggle.disabled = this.frames < 2;
    this.speed.value = String(model.get("speed"));
    const overlaid = model.get("overlaid");
    const named = model.get("motions").map((name, i) => element("span", { text: overlaid && i === 0 && this.motions > 1 ? `${name} (faint)` : name }));
    this.names.replaceChildren(...named);
    this.names.classList.toggle("wb-player-together", overlaid);
    this.redraw();
  }

  // Time.

  play(on) {
    on = on && this.frames > 1;
    if (on === this.playing) return;
    this.playing = on;
    this.toggle.textContent = on ? "Pause" : "Play";
    this.toggle.setAttribute("aria-label", on ? "Pause" : "Play");
    cancelAnimationFrame(this.request);
    if (!on) return this.tell();
    if (this.frame >= this.frames - 1) this.time = 0;
    this.last = null;
    this.request = requestAnimationFrame((now) => this.tick(now));
  }

  /** Advance the clock by the time that has passed, and show where it is. */
  tick(now) {
    if (!this.playing) return;
    const passed = this.last === null ? 0 : Math.min(LONGEST_LEAP, (now - this.last) / 1000);
    this.last = now;
    this.time += (passed * this.model.get("speed")) / this.model.get("frame_time");
    if (this.time >= this.frames) {
      this.change("ends", this.model.get("ends") + 1);
      if (!this.model.get("loop")) {
        this.show(this.frames - 1);
        return this.play(false);
      }
      this.time %= this.frames;
    }
    this.show(Math.floor(this.time));
    this.request = requestAnimationFrame((later) => this.tick(later));
  }

  /** Go to a frame that someone asks for, here or elsewhere, without telling Python. */
  seek(frame) {
    this.time = Math.max(0, Math.min(frame, this.frames - 1));
    this.show(Math.floor(this.time));
  }

  step(frame) {
    this.play(false);
    this.seek(frame);
    this.tell();
  }

  scrub(frame, done) {
    if (done) return this.step(frame);
    this.play(false);
    this.seek(frame);
  }

  /** Tell Python which frame is shown, now that it stays. */
  tell() {
    if (this.frames && this.model.get("frame") !== this.frame) {
      this.model.set("frame", this.frame);
      this.model.save_changes();
    }
  }

  show(frame) {
    if (frame === this.frame) return;
    this.frame = frame;
    this.draw();
    if (!this.model.get("channel")) return;
    this.announcing = true;
    announceHover(this.model.get("channel"), frame);
    this.announcing = false;
  }

  // What a person does.

  listen() {
    orbitByMouse(this.canvas, () => this.stage, () => this.draw(), this.signal);
    this.root.addEventListener("keydown", (event) => this.key(event), { signal: this.signal });
  }

  key(event) {
    if (event.target.closest("select") || event.ctrlKey || event.metaKey || event.altKey) return;
    const isButton = event.target.closest("button");
    const steps = {
      ArrowLeft: () => this.step(this.frame - 1),
      ArrowRight: () => this.step(this.frame + 1),
      ArrowDown: () => this.step(this.frame - 10),
      ArrowUp: () => this.step(this.frame + 10),
      PageUp: () => this.step(this.bar.keyNear(this.frame, -1)),
      PageDown: () => this.step(this.bar.keyNear(this.frame, 1)),
      Home: () => this.step(0),
      End: () => this.step(this.frames - 1),
      " ": () => this.play(!this.playing),
    };
    const act = event.shiftKey && event.key in TURNS ? undefined : steps[event.key];
    if (!act) return void (orbitByKey(event, this.stage) && this.draw());
    // JupyterLab would take the key as a command to its cells.
    event.stopPropagation();
    if (isButton && event.key === " ") return; // the button's own
    event.preventDefault();
    if (this.frames) act();
  }

  // Pictures.

  redraw() {
    const theme = themeOf(this.root);
    this.colours = stickColours(theme);
    this.bar.drawLayer(theme, getComputedStyle(this.root).getPropertyValue("--wb-brand") || theme.palette[0]);
    const marks = this.bar.keyframes.length ? [element("span", { text: "◆ keyframe" })] : [];
    if (this.bar.contacts.length) marks.push(element("span", { text: "▬ foot on the ground" }));
    this.sides.replaceChildren(...sideKey(this.model.get("sides"), this.colours), ...marks);
    this.draw();
  }

  draw() {
    const width = this.canvas.clientWidth;
    if (!width || !this.frames || !this.colours) return;
    const height = Math.round(Math.min(STAGE_TALLEST, width * (this.model.get("overlaid") || this.motions === 1 ? 0.75 : 0.6)));
    if (this.tall !== height) this.canvas.style.height = `${(this.tall = height)}px`;
    const context = emptied(this.canvas, width, height);
    const figures = Array.from({ length: this.motions }, (_, m) => this.block(m * this.frames + this.frame));
    this.stage.play(context, figures, width, height, this.colours, this.model.get("overlaid"));
    const seconds = (this.frame * this.model.get("frame_time")).toFixed(2);
    const text = `frame ${this.frame} of ${this.frames} · ${seconds} s${this.bar.key.has(this.frame) ? " · keyframe" : ""}`;
    this.readout.textContent = text;
    this.bar.draw(this.frame, text);
    // Spoken while someone steps, not sixty times a second.
    if (!this.playing) this.canvas.setAttribute("aria-label", `Stick figures of ${this.model.get("description")}, ${text}. ${PLAYER_HINT}`);
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-player" });
    el.append(root);
    root.player = new Player(model, root, stop.signal);
    return () => stop.abort();
  },
};
