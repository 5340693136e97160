// What is looked at: a time, and how it passes, or a place aside of the trajectory.

const LEAP = 0.25; // seconds that may pass between two pictures before time waits

class PadClock {
  constructor(model) {
    Object.assign(this, { model, scene: null, time: 0, atTime: true, place: [0, 0], pinned: null, playing: false, request: 0 });
  }

  timeOf(frame) {
    return this.scene.start + frame * this.scene.frameTime;
  }

  play(on) {
    on = on && this.scene !== null;
    if (on === this.playing) return;
    this.playing = on;
    if (on) this.pinned = null;
    this.clock.showControls();
    cancelAnimationFrame(this.request);
    if (!on) return this.save("time", this.time);
    if (this.time >= this.scene.start + this.scene.duration - 1e-9) this.time = this.scene.start;
    this.last = null;
    this.request = requestAnimationFrame((now) => this.tick(now));
  }

  pause() {
    this.play(false);
  }

  /** Advance the clock by the time that has passed, and show where it is. */
  tick(now) {
    if (!this.playing) return;
    const passed = this.last === null ? 0 : Math.min(LEAP, (now - this.last) / 1000);
    this.last = now;
    const { start, duration } = this.scene;
    let time = this.time + passed * this.model.get("speed");
    if (time > start + duration && !this.model.get("loop")) {
      this.seek(start + duration);
      return this.pause();
    }
    if (time > start + duration) time = start + ((time - start) % duration);
    this.seek(time);
    this.request = requestAnimationFrame((later) => this.tick(later));
  }

  /** Show a time; with `tell`, it stays and Python hears of it. */
  seek(time, tell = false) {
    if (!this.scene) return;
    const { start, duration } = this.scene;
    this.time = Math.max(start, Math.min(start + duration, time));
    this.atTime = true;
    this.place = this.scene.placeAt(this.time);
    this.showMoment();
    if (tell) this.save("time", this.time);
    const frame = this.scene.frameAt(this.time);
    if (!this.model.get("channel") || frame === this.announced) return;
    this.announcing = true;
    announceHover(this.model.get("channel"), (this.announced = frame));
    this.announcing = false;
  }

  scrub(time, done) {
    this.pause();
    this.pinned = null;
    this.seek(time, done);
  }

  step(frames) {
    this.scrub(this.timeOf(this.scene.frameAt(this.time) + frames), true);
  }

  /** Show the pose at a place of the plane; while playing, the clock's goes before. */
  look(place) {
    if (this.playing) return this.drawTop();
    this.place = place;
    this.atTime = false;
    this.drawMoving();
  }

  /** Keep a place in view until another is, or time goes on; null lets it go. */
  pin(place) {
    this.pinned = place;
    if (place) this.look(place);
    else this.lookAway();
  }

  /** Show the kept place, or else the pose at the time again. */
  lookAway() {
    this.hovered = -1;
    if (!this.scene || this.playing) return;
    if (this.pinned) this.look(this.pinned);
    else this.seek(this.time);
  }
}
