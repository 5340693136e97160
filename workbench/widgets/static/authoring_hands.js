// What the hand does in the plane, by mouse or keys: one class for each mode. A hand that holds
// something tells the pad, which keeps what Python sends until it is let go.

const PAD_CLICK = 4; // a shorter drag, in pixels, is a click
const PAD_NUDGE = 8; // pixels for each press of an arrow key; 1 with Shift
const PAD_ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** What all hands share: nothing is held, and looking at a place shows its pose. */
class Hand {
  constructor(pad) {
    Object.assign(this, { pad, held: false });
  }

  get scene() {
    return this.pad.scene;
  }

  hover(at) {
    this.pad.look(this.pad.plane.toPlace(at));
  }

  press() {}

  move() {}

  release() {}

  /** Put back what is held. */
  abandon() {
    this.held = false;
    this.pad.letGo(true);
  }

  wheel() {
    return false;
  }

  /** Move the place that is looked at by an arrow key, within sight. */
  nudge(event, from = this.pad.place) {
    const [x, y] = this.pad.plane.toPixel(from);
    const way = event.shiftKey ? 1 : PAD_NUDGE;
    const [dx, dy] = PAD_ARROWS[event.key];
    const to = this.pad.plane.toPlace([x + way * dx, y + way * dy]);
    if (this.pad.plane.reveal(to)) this.pad.drawBase();
    return to;
  }

  key(event) {
    if (!(event.key in PAD_ARROWS)) return false;
    this.pad.pin(this.nudge(event));
    return true;
  }
}

class ScrubHand extends Hand {
  hint = "Move the mouse, or use the arrow keys (Shift: by one pixel), to see the pose at any place. A click keeps the place in view, Escape lets it go; a click on the trajectory goes to that time.";

  press(at) {
    this.pad.pause();
    this.hover(at);
  }

  move(at) {
    this.hover(at);
  }

  release(at) {
    const index = this.pad.plane.nearestOn(this.scene.points, at);
    if (index >= 0) this.pad.scrub(this.scene.times[index], true);
    else this.pad.pin(this.pad.plane.toPlace(at));
  }
}

class DrawHand extends Hand {
  hint = "Press and draw: the timing is recorded, and the new trajectory takes the place of this one. By keys, Enter starts and ends, arrow keys draw. Escape cancels.";

  /** The way drawn so far. */
  get pen() {
    return this.held ? this.points : null;
  }

  press(at, event) {
    this.begin(this.pad.plane.toPlace(at), event.timeStamp / 1000);
  }

  move(at, event, steps) {
    if (!this.held) return this.hover(at);
    for (const [place, seconds] of steps) this.record(this.pad.plane.toPlace(place), seconds);
    this.pad.look(this.pad.plane.toPlace(at));
  }

  release(at, event) {
    if (!this.held) return;
    this.record(this.pad.plane.toPlace(at), event.timeStamp / 1000);
    this.end();
  }

  begin(place, seconds) {
    this.pad.pause();
    this.pad.hold();
    Object.assign(this, { held: true, points: [...place], times: [0], began: seconds });
    this.pad.look(place);
  }

  record(place, seconds) {
    const time = seconds - this.began;
    if (!(time > this.times.at(-1))) return; // several moves may come with one time
    this.points.push(...place);
    this.times.push(time);
  }

  end() {
    const { pad, points, times } = this;
    this.held = false;
    if (times.length < 2 || times.at(-1) < 2 * this.scene.frameTime) {
      pad.letGo(true);
      return pad.words.say("Too short to be a trajectory: press, draw and then let go.", true);
    }
    this.scene.draw(Float64Array.from(points), Float64Array.from(times));
    pad.letGo();
    pad.seek(0);
    pad.words.say(`trajectory drawn, ${times.at(-1).toFixed(1)} seconds`);
    pad.tell("draw", { points: times.map((_, i) => [points[2 * i], points[2 * i + 1]]), times });
  }

  key(event) {
    const now = performance.now() / 1000;
    if (event.key === "Enter") {
      if (!this.held) this.begin(this.pad.place, now);
      else {
        this.record(this.pad.place, now);
        this.end();
      }
    } else if (event.key in PAD_ARROWS) {
      const place = this.nudge(event);
      if (this.held) this.record(place, now);
      this.pad.look(place);
    } else return false;
    return true;
  }
}
