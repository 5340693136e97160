// Where the samples of one panel are on the screen, on their way there or not.

const REACH = 14; // how far from a sample, in pixels, the mouse still hovers it
const MARGIN = 12;

/** Start and end slowly. */
function eased(part) {
  return part < 0.5 ? 4 * part ** 3 : 1 - 4 * (1 - part) ** 3;
}

class Cloud {
  constructor() {
    this.size = 0;
    this.points = new Float32Array(0);
    this.frame = frameOf(this.points);
    this.x = this.y = new Float32Array(0);
    this.travel = null;
    this.pulled = null;
  }

  /** Go to these positions in this square; by and by if asked, otherwise at once. */
  aim(points, frame, travelling) {
    this.points = points;
    this.frame = frame;
    this.pulled = null;
    const [fromX, fromY] = [this.x, this.y];
    this.measure();
    if (!travelling || fromX.length !== this.x.length) return;
    this.travel = { fromX, fromY, toX: this.x, toY: this.y, start: performance.now(), part: 0 };
    [this.x, this.y] = [fromX.slice(), fromY.slice()];
  }

  resize(size) {
    if (size === this.size) return;
    this.size = size;
    this.measure();
  }

  /** Compute where the positions are in pixels, with equal units on both axes. */
  measure() {
    const { points, frame, size, scale } = this;
    const n = points.length / 2;
    this.x = new Float32Array(n);
    this.y = new Float32Array(n);
    for (let i = 0; i < n; i++) {
      this.x[i] = size / 2 + (points[2 * i] - frame.x) * scale;
      this.y[i] = size / 2 - (points[2 * i + 1] - frame.y) * scale;
    }
    this.travel = null;
  }

  /** Pixels in a unit of the positions. */
  get scale() {
    return (this.size - 2 * MARGIN) / this.frame.extent;
  }

  get travelling() {
    return this.travel !== null && this.travel.part < 1;
  }

  /** Go on travelling. */
  advance(now, duration) {
    const { travel } = this;
    travel.part = duration > 0 ? Math.min(1, Math.max(0, (now - travel.start) / duration)) : 1;
    this.step();
  }

  /** Shift each sample by its weight times a way in pixels, wherever it is travelling. */
  pull(weights, dx, dy) {
    this.pulled = { weights, dx, dy };
    this.step();
  }

  step() {
    const { x, y, pulled } = this;
    const { fromX, fromY, toX, toY, part } = this.travel;
    const done = eased(part);
    for (let i = 0; i < x.length; i++) {
      // A sample that had no position is at its new one at once.
      x[i] = fromX[i] === fromX[i] ? fromX[i] + done * (toX[i] - fromX[i]) : toX[i];
      y[i] = fromY[i] === fromY[i] ? fromY[i] + done * (toY[i] - fromY[i]) : toY[i];
    }
    if (!pulled) return;
    for (let i = 0; i < x.length; i++) {
      x[i] += pulled.weights[i] * pulled.dx;
      y[i] += pulled.weights[i] * pulled.dy;
    }
  }

  /** The sample closest to a pixel, of all or of some; -1 if none is within reach. */
  nearest(x, y, some = null) {
    let [best, reach] = [-1, REACH * REACH];
    const count = some ? some.length : this.x.length;
    for (let at = 0; at < count; at++) {
      const i = some ? some[at] : at;
      const [dx, dy] = [this.x[i] - x, this.y[i] - y];
      const distance = dx * dx + dy * dy;
      if (distance < reach) [best, reach] = [i, distance];
    }
    return best;
  }

  withinBox([x0, y0], [x1, y1]) {
    const [left, right, top, bottom] = [Math.min(x0, x1), Math.max(x0, x1), Math.min(y0, y1), Math.max(y0, y1)];
    const { x, y } = this;
    const found = [];
    for (let i = 0; i < x.length; i++) {
      if (x[i] >= left && x[i] <= right && y[i] >= top && y[i] <= bottom) found.push(i);
    }
    return found;
  }

  /** Samples within a closed polygon, by the even-odd rule. */
  within(polygon) {
    const xs = polygon.map(([x]) => x);
    const ys = polygon.map(([, y]) => y);
    const found = [];
    for (const i of this.withinBox([Math.min(...xs), Math.min(...ys)], [Math.max(...xs), Math.max(...ys)])) {
      const [x, y] = [this.x[i], this.y[i]];
      let inside = false;
      for (let a = 0, b = xs.length - 1; a < xs.length; b = a++) {
        const crosses = ys[a] > y !== ys[b] > y;
        if (crosses && x < ((xs[b] - xs[a]) * (y - ys[a])) / (ys[b] - ys[a]) + xs[a]) inside = !inside;
      }
      if (inside) found.push(i);
    }
    return found;
  }
}
