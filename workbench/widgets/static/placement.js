// Positions of samples as a sum over control points, each with its influence.

/** positions = influence @ controls; influence is n x k and controls k x 2, row by row. */
function placeAll(influence, controls) {
  const k = controls.length / 2;
  const n = influence.length / k;
  const points = new Float32Array(2 * n);
  for (let i = 0; i < n; i++) {
    let [x, y] = [0, 0];
    for (let j = 0, at = i * k; j < k; j++, at++) {
      x += influence[at] * controls[2 * j];
      y += influence[at] * controls[2 * j + 1];
    }
    points[2 * i] = x;
    points[2 * i + 1] = y;
  }
  return points;
}

/** How much one of k control points counts for each sample. */
function influenceOf(influence, control, k) {
  const weights = new Float32Array(influence.length / k);
  for (let i = 0; i < weights.length; i++) weights[i] = influence[i * k + control];
  return weights;
}

/** Positions of the control points among those of all samples. */
function positionsOf(points, controls) {
  return Float32Array.from({ length: 2 * controls.length }, (_, i) => points[2 * controls[i >> 1] + (i & 1)]);
}

/** The square that holds all positions: its middle, its extent, and how much of it they fill. */
function frameOf(points) {
  let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 2) {
    const [x, y] = [points[i], points[i + 1]];
    if (x < left) left = x;
    if (x > right) right = x;
    if (y < bottom) bottom = y;
    if (y > top) top = y;
  }
  const [width, height] = [right - left, top - bottom];
  const extent = Math.max(width, height);
  return { x: (left + right) / 2, y: (bottom + top) / 2, width, height, extent: extent > 0 ? extent : 1 };
}

/** Whether a square holds all positions that another one was made for. */
function holds(frame, other) {
  const reach = (frame.extent / 2) * (1 + 1e-6);
  return Math.abs(other.x - frame.x) + other.width / 2 <= reach
    && Math.abs(other.y - frame.y) + other.height / 2 <= reach;
}
