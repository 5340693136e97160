// The pad's pose: the figure at the place that is looked at, the original as a ghost, and the
// joints of the selected marker, to be picked and turned.

const POSE_TALL = [260, 460];
const JOINT_REACH = 14; // pixels from a joint within which a click picks it
const KEYS_REST = 700; // milliseconds without a key after which a turn is done
const AXES = ["x", "y", "z"];
const PLACES_OF_TURNED = [
  ["", "changes this marker"],
  ["here", "makes a new marker here"],
  ["best", "makes one at the best place"],
];

class PadPose {
  constructor(pad, signal) {
    Object.assign(this, { pad, signal, joint: -1, angles: [0, 0, 0] });
    this.canvas = element("canvas", { class: "wb-pad-stage", tabindex: "0", role: "application", title: ORBIT_HINT });
    this.caption = element("div", { class: "wb-detail wb-pad-caption" });
    this.stage = new Stage({ parents: [], sides: [] });
    const redraw = () => this.draw();
    orbitByMouse(this.canvas, () => this.stage, redraw, signal);
    this.canvas.addEventListener("keydown", (event) => orbitByKey(event, this.stage) && redraw(), { signal });
    this.sides = element("span", { class: "wb-sides" });
    const under = element("div", { class: "wb-bar" }, [orbitButtons(() => this.stage, redraw, signal), this.sides]);
    this.makeTurning();
    this.node = element("div", { class: "wb-pad-pose" }, [element("div", { class: "wb-pad-box" }, [this.canvas, this.caption]), under, this.turning]);
    this.pickByMouse();
  }

  // Joints.

  makeTurning() {
    const on = (node, type, act) => node.addEventListener(type, act, { signal: this.signal });
    this.joints = element("select", { "aria-label": "Joint" });
    on(this.joints, "change", () => this.pick(Number(this.joints.value)));
    this.places = element("select", { "aria-label": "What turning changes" }, PLACES_OF_TURNED.map(([value, text]) => element("option", { value, text })));
    this.turns = AXES.map((axis, i) => {
      const slider = element("input", { type: "range", min: "-180", max: "180", step: "1", value: "0", "aria-label": `Turn about ${axis}, degrees` });
      const field = element("input", { type: "number", min: "-180", max: "180", step: "1", value: "0", "aria-label": `Degrees about ${axis}` });
      on(slider, "input", () => this.turn(i, Number(slider.value)));
      on(field, "input", () => Number.isFinite(field.valueAsNumber) && this.turn(i, field.valueAsNumber, field));
      for (const node of [slider, field]) {
        on(node, "keydown", ({ key }) => (this.byKeys = key !== "Enter"));
        on(node, "pointerdown", () => (this.byKeys = false));
        on(node, "change", () => this.finishSoon());
        on(node, "blur", () => this.finish());
      }
      return { slider, field, node: element("label", { class: "wb-pad-turn" }, [element("span", { text: axis }), slider, field]) };
    });
    this.places.title = "A new marker goes to the place that was looked at, or to where the optimizer puts it";
    this.title = element("span", { class: "wb-title" });
    this.turning = element("div", { class: "wb-pad-turning", hidden: "" }, [
      element("div", { class: "wb-bar" }, [this.title, this.joints, this.places]),
      element("div", { class: "wb-pad-turns" }, this.turns.map(({ node }) => node)),
    ]);
  }

  pickByMouse() {
    let from = null;
    this.canvas.addEventListener("pointerdown", ({ offsetX, offsetY }) => (from = [offsetX, offsetY]), { signal: this.signal });
    this.canvas.addEventListener("pointerup", ({ offsetX, offsetY }) => {
      if (!from || Math.hypot(offsetX - from[0], offsetY - from[1]) >= PAD_CLICK || this.joints.disabled) return;
      let [best, nearest] = [-1, JOINT_REACH];
      for (let joint = 0; joint < this.pad.scene.body.joints; joint++) {
        const [x, y] = this.jointPixel(joint);
        const distance = Math.hypot(x - offsetX, y - offsetY);
        if (distance < nearest) [best, nearest] = [joint, distance];
      }
      if (best >= 0) this.pick(best);
    }, { signal: this.signal });
  }

  jointPixel(joint) {
    const p = this.shown;
    return p && this.see ? this.see(p[3 * joint], p[3 * joint + 1], p[3 * joint + 2]) : [NaN, NaN];
  }

  pick(joint) {
    this.finish();
    this.joint = joint;
    this.joints.value = String(joint);
    this.setAngles([0, 0, 0]);
    this.draw();
  }

  setAngles(angles, but = null) {
    this.angles = angles;
    this.turns.forEach(({ slider, field }, i) => {
      slider.value = String(angles[i]);
      if (field !== but) field.value = String(angles[i]);
    });
  }

  /** Show the pose with the joint turned; a marker that is to change takes it at once. */
  turn(axis, degrees, field = null) {
    const { pad } = this;
    if (this.joint < 0 || pad.selected < 0) return;
    if (!this.start) {
      pad.hold();
      this.start = { marker: pad.selected, scene: pad.scene };
    }
    this.setAngles(this.angles.map((v, i) => (i === axis ? degrees : v)), field);
    const { marker, scene } = this.start;
    this.start.pose ??= scene.poses.slice(marker * 9 * scene.body.joints, (marker + 1) * 9 * scene.body.joints);
    scene.takePose(marker, this.start.pose);
    const pose = scene.turned(marker, this.joint, this.angles);
    if (this.places.value) this.preview = { rotations: pose, root: scene.markerRoots.subarray(3 * marker, 3 * marker + 3) };
    else {
      scene.takePose(marker, pose);
      pad.place = scene.marker(marker);
      pad.atTime = false;
      pad.drawTop();
    }
    this.draw();
  }

  /** Keys change a number step by step: what they do is one edit, after the last of them. */
  finishSoon() {
    clearTimeout(this.finishing);
    if (!this.byKeys) return this.finish();
    this.finishing = setTimeout(() => this.finish(), KEYS_REST);
  }

  /** Tell Python what was turned, now that the hand has let go. */
  finish() {
    clearTimeout(this.finishing);
    if (!this.start) return;
    const { pad, joint, angles } = this;
    const { marker } = this.start;
    const place = { "": null, here: pad.pinned ?? pad.place, best: "best" }[this.places.value];
    const none = angles.every((v) => v === 0);
    this.start = this.preview = null;
    if (place === pad.pinned) pad.pinned = null;
    pad.letGo(none);
    this.setAngles([0, 0, 0]);
    this.places.value = "";
    if (!none) pad.tell("turn", { marker, joint, angles, place });
  }

  /** Put the joint back that is being turned. */
  abandon() {
    clearTimeout(this.finishing);
    if (!this.start) return;
    this.start = this.preview = null;
    this.setAngles([0, 0, 0]);
    this.pad.letGo(true);
  }

  // What is shown.

  read(scene, model) {
    const { parents } = scene.body;
    const before = this.stage;
    this.stage = new Stage({ parents, sides: model.get("sides"), head: model.get("head") });
    this.stage.lookAs(before);
    const width = 3 * scene.nodes;
    const clip = Array.from({ length: scene.ghost.length / width }, (_, i) => scene.ghost.subarray(i * width, (i + 1) * width));
    if (clip.length) this.stage.measure(clip);
    else this.stage.measure(Array.from({ length: scene.count }, (_, j) => scene.positions(scene.poseAt(scene.marker(j)) ?? { rotations: scene.poses, root: [0, 0, 0] }).slice()));
    this.joints.replaceChildren(element("option", { value: "-1", text: "turn a joint" }),
      ...model.get("joint_names").map((name, i) => element("option", { value: String(i), text: name })));
    if (this.joint >= scene.body.joints) this.joint = -1;
    this.joints.value = String(this.joint);
    this.setAngles([0, 0, 0]);
  }

  showSelected(editable) {
    const { pad } = this;
    const none = pad.selected < 0;
    this.turning.hidden = !editable;
    this.turning.classList.toggle("wb-pad-idle", none);
    this.title.textContent = none ? "No marker selected" : pad.scene.nameOf(pad.selected);
    this.joints.disabled = this.places.disabled = none;
    for (const { slider, field } of this.turns) slider.disabled = field.disabled = none || this.joint < 0;
  }

  resize() {
    const width = this.canvas.clientWidth;
    const beside = this.node.offsetTop < this.pad.plane.plot.offsetTop + 10;
    const tall = beside ? this.pad.plane.plot.offsetHeight : Math.round(Math.min(POSE_TALL[1], Math.max(POSE_TALL[0], 0.6 * width)));
    this.canvas.style.height = `${tall}px`;
    Object.assign(this, { width, height: this.canvas.clientHeight });
    this.colours = stickColours(this.pad.theme);
    this.sides.replaceChildren(...sideKey(this.pad.model.get("sides"), this.colours));
  }

  draw() {
    const { pad, width } = this;
    if (!width || !pad.scene) return;
    const { scene } = pad;
    const context = emptied(this.canvas, width, this.height);
    const pose = this.preview ?? scene.poseAt(pad.place);
    this.showSelected(pad.model.get("editable"));
    if (!pose) return;
    const root = (pad.atTime && scene.rootAt(pad.time)) || pose.root;
    const p = (this.shown = scene.positions({ rotations: pose.rotations, root }));
    const figures = [p];
    const original = pad.model.get("show_ghost") ? this.original() : null;
    if (original) figures.unshift(this.beside(original, p));
    this.describe(original !== null);
    this.see = this.stage.camera(figures[0], width / 2, width, this.height);
    this.stage.play(context, figures, width, this.height, this.colours, true);
    if (!this.joints.disabled && this.joint >= 0) this.drawRing(context);
  }

  /** Say what is shown; to a screen reader only while nothing plays. */
  describe(withGhost) {
    const { pad } = this;
    const { scene, selected, hovered } = pad;
    const marker = hovered >= 0 ? hovered : this.start ? selected : -1;
    const what = pad.atTime ? `pose at ${(pad.time - scene.start).toFixed(2)} s` : marker >= 0 ? `pose of ${scene.nameOf(marker)}` : "pose at the place looked at";
    this.caption.textContent = withGhost ? `${what} · original in grey` : what;
    if (!pad.playing) this.canvas.setAttribute("aria-label", `Stick figure, ${this.caption.textContent}. ${ORBIT_HINT}`);
  }

  /** The original's positions: at the same time, or in the frame nearest to the place. */
  original() {
    const { scene, plane, atTime, time, place } = this.pad;
    if (atTime) return scene.ghostAt(time);
    const frame = plane.nearestOn(scene.embedding, plane.toPixel(place));
    return frame >= 0 ? scene.ghostAt(scene.start + frame * scene.frameTime) : null;
  }

  /** The original where the figure stands, because poses are compared and not ways. */
  beside(original, p) {
    this.moved = this.moved?.length === original.length ? this.moved : new Float64Array(original.length);
    const [dx, dz] = [p[0] - original[0], p[2] - original[2]];
    for (let i = 0; i < original.length; i += 3) {
      this.moved[i] = original[i] + dx;
      this.moved[i + 1] = original[i + 1];
      this.moved[i + 2] = original[i + 2] + dz;
    }
    return this.moved;
  }

  drawRing(context) {
    const [x, y] = this.jointPixel(this.joint);
    for (const [colour, width] of [[this.pad.theme.ground, 5], [this.pad.theme.brand, 2.5]]) {
      context.beginPath();
      context.arc(x, y, 9, 0, 2 * Math.PI);
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.stroke();
    }
  }
}
