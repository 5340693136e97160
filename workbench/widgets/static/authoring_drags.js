// Dragging markers and the trajectory itself, by mouse or keys.

const PAD_REACH = 18; // how far from the curve, in pixels, it can be taken hold of
const SHORTEST_RADIUS = 0.005; // of the trajectory's length
const SETTLING = 250; // milliseconds until frames are where markers put them

class MarkerHand extends Hand {
  hint =
    "Drag a marker: the frames follow. Double-click, or A, adds one; a click keeps a place in view for it; Delete removes the selected one. Arrow keys lead from marker to marker; Enter picks one up and drops it, Escape puts it back.";

  hover(at) {
    const marker = this.pad.plane.nearestMarker(this.scene, at);
    this.pad.hovered = marker;
    this.pad.look(marker >= 0 ? this.scene.marker(marker) : this.pad.plane.toPlace(at));
  }

  press(at) {
    const marker = this.pad.plane.nearestMarker(this.scene, at);
    this.pressed = { at, marker };
    this.pad.select(marker);
    if (marker >= 0) this.pad.hold(); // another scene may have it elsewhere
  }

  move([x, y]) {
    const { at, marker } = this.pressed ?? {};
    if (!(marker >= 0)) return this.hover([x, y]);
    if (!this.held && Math.hypot(x - at[0], y - at[1]) < PAD_CLICK) return;
    if (!this.held) this.lift(marker);
    const [px, py] = this.pad.plane.toPixel(this.from);
    this.put(this.pad.plane.toPlace([px + x - at[0], py + y - at[1]]));
  }

  release(at) {
    const { marker } = this.pressed ?? {};
    this.pressed = null;
    if (this.held) this.drop();
    else if (marker >= 0) this.pad.letGo(true);
    else if (marker < 0) this.pad.pin(this.pad.plane.toPlace(at));
  }

  abandon() {
    this.pressed = null;
    super.abandon();
  }

  lift(marker) {
    this.held = true;
    this.pad.hold();
    Object.assign(this, { marker, from: this.scene.marker(marker), shifts: this.scene.shifts(), since: performance.now() });
    this.pad.words.say(`${this.scene.nameOf(marker)}, picked up`);
  }

  put(place) {
    this.to = place;
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const part = calm ? 1 : Math.min(1, (performance.now() - this.since) / SETTLING);
    this.scene.moveMarker(this.marker, place, this.shifts, part);
    this.pad.look(place);
    this.pad.drawBase();
  }

  drop() {
    const { marker, to, from } = this;
    this.held = false;
    if (!to || (to[0] === from[0] && to[1] === from[1])) return this.pad.letGo(true);
    this.scene.moveMarker(marker, to, this.shifts, 1);
    this.to = null;
    this.pad.letGo();
    this.pad.words.say(`${this.scene.nameOf(marker)}, dropped`);
    this.pad.tell("move", { marker, to });
  }

  key(event) {
    const { pad, scene } = this;
    const way = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (event.key === "Enter") {
      if (this.held) this.drop();
      else if (pad.selected >= 0) {
        this.lift(pad.selected);
        this.to = this.from;
      }
    } else if (this.held && way) this.put(this.nudge(event, this.to));
    else if (way) {
      pad.select((pad.selected + (pad.selected < 0 && way < 0 ? 0 : way) + scene.count) % scene.count);
      if (pad.plane.reveal(scene.marker(pad.selected))) pad.drawBase();
      pad.look(scene.marker(pad.selected));
      pad.words.say(scene.nameOf(pad.selected));
    } else return false;
    return true;
  }
}

/** A radius between the shortest and the longest that make sense, and back to its part. */
function radiusAt(scene, part) {
  return longestRadius(scene) * SHORTEST_RADIUS ** (1 - part);
}

function partOfRadius(scene, radius) {
  return 1 - Math.log(radius / longestRadius(scene)) / Math.log(SHORTEST_RADIUS);
}

/** The nearest radius that makes sense on a trajectory. */
function sensibleRadius(scene, radius) {
  return Math.max(radiusAt(scene, 0), Math.min(radiusAt(scene, 1), radius));
}

function longestRadius(scene) {
  return lengthsAlong(scene.points).at(-1) || 1;
}

class DeformHand extends Hand {
  hint =
    "Drag the trajectory; the wheel, [ and ] or the slider say how far along it the drag is felt. Arrow keys lead along it (Shift: point by point); Enter picks it up and drops it, Escape puts it back.";

  index = -1;

  get stretch() {
    const { index, pad, scene, lengths } = this;
    if (index < 0 || index >= scene.times.length) return null;
    return { index, radius: pad.radius, lengths: this.held ? lengths : lengthsAlong(scene.points) };
  }

  hover(at) {
    this.index = this.pad.plane.nearestOn(this.scene.points, at, PAD_REACH);
    this.pad.look(this.pad.plane.toPlace(at));
  }

  press(at) {
    this.index = this.pad.plane.nearestOn(this.scene.points, at, PAD_REACH);
    this.pressed = this.index >= 0 ? at : null;
    if (this.pressed) this.pad.hold();
  }

  move([x, y]) {
    if (!this.pressed) return this.hover([x, y]);
    const [dx, dy] = [x - this.pressed[0], y - this.pressed[1]];
    if (!this.held && Math.hypot(dx, dy) < PAD_CLICK) return;
    if (!this.held) this.lift();
    const [px, py] = this.pad.plane.toPixel(this.from);
    this.put(this.pad.plane.toPlace([px + dx, py + dy]));
  }

  release() {
    if (this.held) this.drop();
    else if (this.pressed) this.pad.letGo(true);
    this.pressed = null;
  }

  abandon() {
    this.pressed = null;
    super.abandon();
  }

  lift() {
    this.held = true;
    this.pad.hold();
    const { points } = this.scene;
    Object.assign(this, { before: points, lengths: lengthsAlong(points), from: [points[2 * this.index], points[2 * this.index + 1]] });
    this.to = this.from;
  }

  put(place) {
    this.to = place;
    this.scene.draw(draggedCurve(this.before, this.index, place, this.pad.radius, this.lengths), this.scene.times);
    this.pad.look(place);
    this.pad.drawBase();
  }

  drop() {
    const { index, to, from, pad } = this;
    const { radius } = pad; // before it is fitted to the new curve
    this.held = false;
    if (to[0] === from[0] && to[1] === from[1]) return pad.letGo(true);
    pad.letGo();
    pad.words.say("trajectory deformed");
    pad.model.set("radius", radius); // goes with the edit
    pad.tell("deform", { index, to, radius });
  }

  wheel(delta) {
    this.reach(1.002 ** -delta);
    return true;
  }

  reach(factor) {
    this.pad.setRadius(this.pad.radius * factor);
    if (this.held) this.put(this.to);
  }

  key(event) {
    const { pad, scene } = this;
    const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (event.key === "[" || event.key === "]") this.reach(event.key === "]" ? 1.15 : 1 / 1.15);
    else if (event.key === "Enter") {
      if (this.held) this.drop();
      else if (this.index >= 0) this.lift();
    } else if (this.held && way) this.put(this.nudge(event, this.to));
    else if (way) {
      const leap = event.shiftKey ? 1 : Math.max(1, Math.round(scene.times.length / 100));
      this.index = Math.max(0, Math.min(scene.times.length - 1, this.index + way * leap));
      const place = [scene.points[2 * this.index], scene.points[2 * this.index + 1]];
      if (pad.plane.reveal(place)) pad.drawBase();
      pad.look(place);
    } else return false;
    return true;
  }
}
