// The authoring pad: plane, pose and time of spatial keyframes. It joins the parts, keeps the
// clock, and tells Python of an edit when its gesture has ended.

const FEWEST_MARKERS = 3;
const SCENE_TRAITS = [
  "parents", "sides", "head", "offsets", "joint_names", "frame_time", "kernel", "epsilon", "markers", "marker_poses", "marker_roots",
  "marker_frames", "marker_names", "influence", "embedding", "points", "times", "follows", "ghost", "roots", "revision", "answered",
];

class AuthoringPad extends PadClock {
  constructor(model, root, signal) {
    super(model);
    Object.assign(this, { root, signal, hovered: -1, selected: -1, holding: false, radius: 0 });
    this.post = new PadPost(this);
    const hintId = `wb-hint-${Math.random().toString(36).slice(2)}`;
    this.tools = new PadTools(this, signal);
    this.plane = new PadPlane(hintId);
    this.pose = new PadPose(this, signal);
    this.clock = new PadTime(this, signal);
    this.glide = new PadGlide(this);
    this.hands = { scrub: new ScrubHand(this), markers: new MarkerHand(this), deform: new DeformHand(this), draw: new DrawHand(this) };
    this.words = new PadWords(this, hintId);
    const under = element("div", { class: "wb-bar wb-pad-under" }, [this.words.readout, this.tools.radius]);
    const left = element("div", { class: "wb-pad-left" }, [this.plane.plot, under, this.words.legend]);
    const views = element("div", { class: "wb-pad-views" }, [left, this.pose.node]);
    this.parts = [this.tools.node, views, this.clock.node];
    root.append(this.tools.node, views, this.words.message, this.clock.node, this.words.hint, this.words.live);
    this.input = new PadInput(this, signal);
    this.arrive();
    onTraits(model, SCENE_TRAITS, () => this.arrive(), signal);
    onTraits(model, ["selected"], () => this.takeSelected(), signal);
    onTraits(model, ["mode", "undo_label", "redo_label", "editable", "message", "loop", "speed", "show_ghost"], () => this.showControls(), signal);
    onTraits(model, ["radius"], () => model.get("radius") > 0 && this.setRadius(model.get("radius")), signal);
    onTraits(model, ["time"], () => model.get("time") !== this.time && this.seek(model.get("time")), signal);
    onHover(model, (frame) => !this.announcing && frame >= 0 && this.scene && this.scrub(this.timeOf(frame), false), signal);
    watchTheme(() => this.redraw(), signal);
    const observer = new ResizeObserver(() => this.plane.plot.clientWidth !== this.plane.width && this.redraw());
    observer.observe(root);
    signal.addEventListener("abort", () => {
      observer.disconnect();
      cancelAnimationFrame(this.request);
      cancelAnimationFrame(this.glide.request);
      clearTimeout(this.post.patience);
      clearTimeout(this.pose.finishing);
    });
  }

  // What comes from Python, and what goes there.

  /** Take the traits over, unless the hand is at work or Python has still to answer. */
  arrive() {
    this.post.takeAnswer();
    if (!this.holding && this.post.answered >= this.post.pending) this.read();
  }

  read() {
    const scene = new AuthoredScene(this.model);
    // Traits of another clip may come one after the other; what does not fit is not drawn.
    if (!scene.fits) return this.showControls();
    this.post.show();
    this.glide.stop();
    const before = this.scene;
    const first = !before;
    const newBody = first || ["parents", "ghost", "sides", "head"].some((name) => this.model.get(name) !== this.seen[name]);
    this.seen = Object.fromEntries(["parents", "ghost", "sides", "head"].map((name) => [name, this.model.get(name)]));
    this.scene = scene;
    if (newBody) this.pinned = null;
    const radius = newBody ? this.model.get("radius") || radiusAt(scene, 0.45) : this.radius;
    this.radius = sensibleRadius(scene, radius);
    if (this.atTime) this.time = first ? this.model.get("time") : this.time;
    this.time = Math.max(scene.start, Math.min(scene.start + scene.duration, this.time));
    if (this.atTime) this.place = scene.placeAt(this.time);
    if (newBody) this.pose.read(scene, this.model);
    else scene.lastGood = before.lastGood;
    this.selected = Math.min(this.model.get("selected"), scene.count - 1);
    this.plane.resize();
    if (!this.plane.view || newBody || (!this.plane.own && !this.plane.holds(scene))) this.plane.fit(scene);
    this.clock.read(scene);
    if (!newBody) this.glide.start(before, scene);
    this.showControls();
  }

  /** Tell Python of an edit. */
  tell(kind, details = {}) {
    this.post.tell(kind, details);
  }

  save(name, value) {
    this.model.set(name, value);
    this.model.save_changes();
  }

  change(name, value) {
    if (this.holding) this.input.abandon();
    this.hovered = -1;
    this.save(name, value);
    this.showControls();
  }

  /** Keep what Python sends until the hand lets go. */
  hold() {
    this.glide.stop();
    this.holding = true;
    this.post.base = this.post.shown;
  }

  /** Let go; with `putBack` everything is as Python has it, else as the hand has left it. */
  letGo(putBack = false) {
    this.holding = false;
    if (putBack) {
      this.post.base = null;
      return this.arrive();
    }
    this.radius = sensibleRadius(this.scene, this.radius);
    this.clock.read(this.scene);
    this.redraw();
  }

  // What a person asks for.

  get mode() {
    return this.model.get("editable") && this.model.get("mode") in this.hands ? this.model.get("mode") : "scrub";
  }

  get hand() {
    return this.hands[this.mode];
  }

  select(marker) {
    this.pose.finish();
    if (marker === this.selected) return;
    this.selected = marker;
    this.save("selected", marker);
    this.showSelected();
  }

  takeSelected() {
    if (!this.scene || this.holding) return;
    this.selected = Math.min(this.model.get("selected"), this.scene.count - 1);
    this.showSelected();
  }

  showSelected() {
    this.pose.setAngles([0, 0, 0]);
    this.tools.show();
    this.drawBase();
    this.drawTop();
    this.pose.draw();
  }

  addMarker(place) {
    this.glide.stop();
    const { scene, plane } = this;
    if (!scene || this.holding) return;
    const frame = plane.nearestOn(scene.embedding, plane.toPixel(place));
    const at = frame >= 0 ? [scene.embedding[2 * frame], scene.embedding[2 * frame + 1]] : [...place];
    const pose = scene.poseAt(at);
    const taken = frame >= 0 ? scene.markerFrames.includes(frame) : plane.nearestMarker(scene, plane.toPixel(at), 1) >= 0;
    if (taken || !pose) return this.words.say(pose ? "There is a marker already: look at another place first." : scene.problem, true);
    const [rotations, root] = [[...pose.rotations], [...pose.root]];
    scene.addMarker(at, frame >= 0 ? frame : null, rotations, root);
    this.selected = scene.count - 1;
    this.pin(null);
    this.look(at);
    this.showSelected();
    this.words.say("marker added");
    this.tell("add", { at, frame: frame >= 0 ? frame : null, rotations, root });
  }

  removeMarker() {
    this.glide.stop();
    const { scene, selected } = this;
    if (!scene || selected < 0 || this.holding) return;
    if (scene.count <= FEWEST_MARKERS) return this.words.say(`At least ${FEWEST_MARKERS} markers must stay.`, true);
    this.words.say(`${scene.nameOf(selected)} deleted`);
    scene.removeMarker(selected);
    this.selected = -1;
    this.showSelected();
    this.tell("remove", { marker: selected });
  }

  setRadius(radius) {
    if (!this.scene) return;
    this.radius = sensibleRadius(this.scene, radius);
    this.tools.show();
    this.drawTop();
  }

  zoom(factor, pixel) {
    if (!this.scene) return;
    this.plane.zoomAt(factor, pixel);
    this.drawBase();
    this.drawTop();
  }

  showAll() {
    if (!this.scene) return;
    this.plane.fit(this.scene);
    this.drawBase();
    this.drawTop();
  }

  // Pictures.

  showControls() {
    this.plane.plot.dataset.mode = this.mode;
    this.clock.showControls();
    this.redraw();
  }

  redraw() {
    const brand = getComputedStyle(this.root).getPropertyValue("--wb-brand").trim();
    this.theme = { ...themeOf(this.root), brand };
    this.tools.show();
    const { plot } = this.plane;
    plot.style.height = `${Math.round(Math.min(PAD_TALL[1], Math.max(PAD_TALL[0], 0.8 * plot.clientWidth)))}px`;
    this.plane.resize();
    this.pose.resize();
    this.words.describe();
    for (const part of this.parts) part.inert = !this.scene;
    if (!this.scene) return;
    this.drawBase();
    this.drawMoving();
    this.clock.redraw();
  }

  drawBase() {
    if (this.scene && this.plane.width) this.plane.drawBase(this.scene, this);
  }

  /** What follows the mouse and the clock: the marks on the plane and the pose. */
  drawMoving() {
    this.drawTop();
    this.pose.draw();
    this.words.locate();
  }

  /** Show what the time is, here and on the bar. */
  showMoment() {
    this.drawMoving();
    this.clock.draw();
  }

  drawTop() {
    if (!this.scene || !this.plane.width) return;
    const { hand, hovered, selected, theme } = this;
    this.plane.drawTop(this.scene, {
      place: this.atTime ? null : this.place,
      pinned: this.pinned,
      now: this.scene.placeAt(this.time),
      hovered, selected, theme,
      stretch: hand.stretch,
      pen: hand.pen,
    });
  }

  /** Show time and handles again, after times have changed. */
  showTime() {
    this.clock.curve.drawLayer();
    this.seek(this.time);
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-pad" });
    el.append(root);
    root.pad = new AuthoringPad(model, root, stop.signal);
    return () => stop.abort();
  },
};
