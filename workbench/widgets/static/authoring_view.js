// Which part of the plane is seen: equal units on both axes, zoomed and moved.

const PAD_MARGIN = 34; // pixels around what is there, when all of it is shown

class PlaneView {
  constructor() {
    // `own` is whether a person has chosen what is seen.
    Object.assign(this, { width: 0, height: 0, view: null, own: false });
  }

  /** Show all of a scene. */
  fit(scene) {
    const { low, high } = boxOf(Float64Array.from([...scene.points, ...scene.embedding, ...scene.markers]));
    this.view = { x: (low[0] + high[0]) / 2, y: (low[1] + high[1]) / 2, wide: high[0] - low[0], tall: high[1] - low[1], zoom: 1 };
    this.own = false;
  }

  /** Whether all of a scene is in sight. */
  holds(scene) {
    const inside = (points) => {
      for (let i = 0; i < points.length; i += 2) {
        const [x, y] = this.toPixel([points[i], points[i + 1]]);
        if (!(x >= 0 && y >= 0 && x <= this.width && y <= this.height)) return false;
      }
      return true;
    };
    return inside(scene.points) && inside(scene.markers);
  }

  /** Pixels in a unit of the plane. */
  get scale() {
    const { wide, tall, zoom } = this.view;
    const room = [this.width, this.height].map((size) => Math.max(20, size - 2 * PAD_MARGIN));
    return zoom * Math.min(room[0] / (wide || tall || 1), room[1] / (tall || wide || 1));
  }

  toPixel([x, y]) {
    const { scale, view } = this;
    return [this.width / 2 + (x - view.x) * scale, this.height / 2 - (y - view.y) * scale];
  }

  toPlace([px, py]) {
    const { scale, view } = this;
    return [view.x + (px - this.width / 2) / scale, view.y - (py - this.height / 2) / scale];
  }

  /** Zoom so that the place under a pixel stays there. */
  zoomAt(factor, pixel = [this.width / 2, this.height / 2]) {
    this.own = true;
    const [x, y] = this.toPlace(pixel);
    this.view.zoom = Math.min(40, Math.max(0.25, this.view.zoom * factor));
    const [nx, ny] = this.toPlace(pixel);
    this.view.x += x - nx;
    this.view.y += y - ny;
  }

  pan(dx, dy) {
    this.own = true;
    this.view.x -= dx / this.scale;
    this.view.y += dy / this.scale;
  }

  /** Bring a place into sight, for those who move it by keys. */
  reveal(place) {
    const [x, y] = this.toPixel(place);
    const [kx, ky] = [Math.max(12, Math.min(this.width - 12, x)), Math.max(12, Math.min(this.height - 12, y))];
    if (kx === x && ky === y) return false;
    this.pan(kx - x, ky - y);
    return true;
  }

  nearestMarker(scene, [px, py], reach = 14) {
    let [best, nearest] = [-1, reach];
    for (let j = 0; j < scene.count; j++) {
      const [x, y] = this.toPixel(scene.marker(j));
      const distance = Math.hypot(x - px, y - py);
      if (distance <= nearest) [best, nearest] = [j, distance];
    }
    return best;
  }

  /** The point of a curve within reach of a pixel, -1 if none is. */
  nearestOn(points, pixel, reach = 14) {
    if (!points.length) return -1;
    const { index, distance } = nearestPoint(points, this.toPlace(pixel));
    return distance * this.scale <= reach ? index : -1;
  }
}
