// Moving control points, by mouse or keyboard: the other samples follow by their influences.

const NUDGE = 8; // pixels for each press of an arrow key; 1 with Shift

class Mover {
  constructor(view) {
    this.view = view;
    this.controls = []; // of each panel: positions of its control points, or null if not moved
    this.placed = []; // of each panel: positions of all samples that follow from them, or null
    this.isNew = []; // of each panel: whether its caption is from before it was moved, or moved back
    this.pressed = null;
    this.grip = null;
  }

  get panel() {
    return this.pressed?.panel ?? null;
  }

  /** The held control point, if it is in this panel, as the index of its sample; else -1. */
  heldIn(panel) {
    return this.grip?.panel === panel ? this.grip.sample : -1;
  }

  get anyMoved() {
    return this.controls.some(Boolean);
  }

  /** Take over positions of control points, as the trait has them; give whether they are new. */
  read(moved, { panels, influence }) {
    const positions = Array.from({ length: panels }, (_, p) => {
      const ours = moved && influence ? ofPanel(moved, p, panels) : null;
      return ours && anyKnown(ours) ? ours : null;
    });
    const same = (a, b) => (a && b ? sameNumbers(a, b) : !a && !b);
    const fresh = positions.some((ours, p) => !same(ours, this.controls[p]));
    if (fresh) this.grip = this.pressed = null;
    this.isNew = positions.map((ours, p) => this.isNew[p] && same(ours, this.controls[p]));
    this.controls = positions;
    this.placed = positions.map((ours) => ours && placeAll(influence, ours));
    return fresh;
  }

  // By mouse.

  press(panel, at) {
    if (this.grip) this.drop();
    const sample = panel.cloud.nearest(...at, this.view.state.controls);
    this.pressed = { panel, at, sample };
  }

  move([x, y]) {
    const { panel, at, sample } = this.pressed;
    if (sample < 0) return;
    const [dx, dy] = [x - at[0], y - at[1]];
    if (!this.grip && Math.hypot(dx, dy) >= CLICK) this.lift(panel, sample);
    if (this.grip) this.shift(dx, dy);
  }

  release() {
    this.pressed = null;
    if (this.grip) this.drop();
  }

  abandon() {
    this.pressed = null;
    if (this.grip) this.putBack();
  }

  // By keyboard.

  key({ key, shiftKey }, panel) {
    const { controls } = this.view.state;
    const at = controls.indexOf(this.view.hovered);
    const arrows = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    if (key === "Enter" || key === " ") {
      if (this.grip) this.drop();
      else if (at >= 0) this.lift(panel, controls[at]);
    } else if (this.grip && key in arrows) {
      this.nudge(...arrows[key].map((way) => way * (shiftKey ? 1 : NUDGE)));
    } else if (!this.grip && ARROWS.includes(key)) {
      this.view.hover(controls[stepped(key, at, controls.length)], panel, true);
    } else return false;
    return true;
  }

  /** Move the held control point, but not out of sight: there is no hand to tell where it is. */
  nudge(dx, dy) {
    const { panel: { cloud }, sample } = this.grip;
    const kept = (at, way) => Math.max(EDGE, Math.min(cloud.size - EDGE, at + way)) - at;
    this.shift(this.grip.dx + kept(cloud.x[sample], dx), this.grip.dy + kept(cloud.y[sample], dy));
  }

  // What both do.

  /** Take hold of a control point. The samples go where the control points put them. */
  lift(panel, sample) {
    const { view } = this;
    const { state } = view;
    const { cloud } = panel;
    const start = this.controls[view.panels.indexOf(panel)] ?? positionsOf(cloud.points, state.controls);
    if (start.some(Number.isNaN)) return;
    const control = state.controls.indexOf(sample);
    const weights = influenceOf(state.influence, control, state.controls.length);
    this.grip = { panel, sample, control, start, weights, dx: 0, dy: 0, points: cloud.points, frame: cloud.frame };
    cloud.aim(placeAll(state.influence, start), cloud.frame, true);
    view.travel();
    view.hover(sample, panel);
    view.say(`${view.name(sample, panel)}, picked up`);
  }

  shift(dx, dy) {
    Object.assign(this.grip, { dx, dy });
    this.grip.panel.cloud.pull(this.grip.weights, dx, dy);
    this.view.drawPanel(this.grip.panel);
  }

  drop() {
    const { view } = this;
    const { panel, sample, control, start, dx, dy } = this.grip;
    const { cloud } = panel;
    this.grip = null;
    const positions = start.slice();
    positions[2 * control] += dx / cloud.scale;
    positions[2 * control + 1] -= dy / cloud.scale;
    const p = view.panels.indexOf(panel);
    this.isNew[p] = true;
    this.controls[p] = positions;
    this.placed[p] = placeAll(view.state.influence, positions);
    const frame = frameOf(this.placed[p]);
    const kept = holds(cloud.frame, frame);
    cloud.aim(this.placed[p], kept ? cloud.frame : frame, !kept || cloud.travelling);
    view.say(`${view.name(sample, panel)}, dropped`);
    this.tell();
  }

  putBack() {
    const { panel, sample, points, frame } = this.grip;
    this.grip = null;
    panel.cloud.aim(points, frame, true);
    this.view.travel();
    this.view.say(`${this.view.name(sample, panel)}, put back`);
  }

  reset() {
    this.isNew = this.controls.map((ours, p) => Boolean(ours) !== Boolean(this.isNew[p]));
    this.controls.fill(null);
    this.placed.fill(null);
    this.view.say("control points are back");
    this.tell();
  }

  /** Show and send what was moved. */
  tell() {
    const { state } = this.view;
    const values = new Float32Array(this.anyMoved ? 2 * state.panels * state.controls.length : 0).fill(NaN);
    this.controls.forEach((positions, p) => positions && ofPanel(values, p, state.panels).set(positions));
    this.view.showMoved();
    this.view.model.set("moved", new DataView(values.buffer));
    this.view.model.save_changes();
  }
}
