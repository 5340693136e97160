// Going by and by from what was shown to what Python sends, so that nothing jumps.

const GLIDE = 220; // milliseconds
const GLIDING = ["markers", "embedding", "points"];

class PadGlide {
  constructor(pad) {
    Object.assign(this, { pad, goal: null, request: 0 });
  }

  /** Go from one scene's places to those of the scene that is shown now, if both have as many. */
  start(from, scene) {
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches || this.pad.playing;
    const alike = GLIDING.every((name) => from[name].length === scene[name].length);
    if (still || !alike || GLIDING.every((name) => from[name].every((v, i) => v === scene[name][i]))) return;
    const pick = (of) => Object.fromEntries(GLIDING.map((name) => [name, of[name]]));
    Object.assign(this, { scene, from: pick(from), goal: pick(scene), began: performance.now() });
    this.show(0);
    this.request = requestAnimationFrame((now) => this.tick(now));
  }

  tick(now) {
    const part = Math.min(1, Math.max(0, (now - this.began) / GLIDE));
    if (part >= 1) return this.stop();
    this.show(part * part * (3 - 2 * part));
    this.draw();
    this.request = requestAnimationFrame((later) => this.tick(later));
  }

  show(part) {
    for (const name of GLIDING) {
      this.scene[name] = this.goal[name].map((v, i) => this.from[name][i] + part * (v - this.from[name][i]));
    }
    this.scene.fitted = undefined;
  }

  draw() {
    const { pad } = this;
    if (pad.atTime) pad.place = pad.scene.placeAt(pad.time);
    pad.drawBase();
    pad.drawMoving();
  }

  /** Be there at once. */
  stop() {
    cancelAnimationFrame(this.request);
    if (!this.goal) return;
    Object.assign(this.scene, this.goal, { fitted: undefined });
    this.goal = null;
    if (this.scene === this.pad.scene) this.draw();
  }
}
