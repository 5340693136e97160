// Trajectories: points of the plane in the order of time, as authoring/trajectories.py has them.

/** The way along the curve from the first point to each. */
function lengthsAlong(points) {
  const lengths = new Float64Array(points.length / 2);
  for (let i = 1; i < lengths.length; i++) {
    const [dx, dy] = [points[2 * i] - points[2 * i - 2], points[2 * i + 1] - points[2 * i - 1]];
    lengths[i] = lengths[i - 1] + Math.sqrt(dx * dx + dy * dy);
  }
  return lengths;
}

/** How much a point at a distance along the curve follows one that is dragged. */
function falloff(distance, radius) {
  return (1 - Math.min(distance / radius, 1) ** 2) ** 2;
}

/** Drag one point to another place and its neighbourhood with it. */
function draggedCurve(points, index, [x, y], radius, lengths = lengthsAlong(points)) {
  const moved = points.slice();
  const [dx, dy] = [x - points[2 * index], y - points[2 * index + 1]];
  for (let i = 0; i < lengths.length; i++) {
    const weight = falloff(Math.abs(lengths[i] - lengths[index]), radius);
    moved[2 * i] += weight * dx;
    moved[2 * i + 1] += weight * dy;
  }
  moved[2 * index] = x;
  moved[2 * index + 1] = y;
  return moved;
}

/** The last point that is not after a time. */
function pointBefore(times, time) {
  let [low, high] = [0, times.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Where the curve is at a time; before its first point and after its last it waits there. */
function placeAt(points, times, time) {
  const i = pointBefore(times, time);
  const last = times.length - 1;
  if (i === last || time <= times[0]) return [points[2 * i], points[2 * i + 1]];
  const part = (time - times[i]) / (times[i + 1] - times[i]);
  return [0, 1].map((k) => points[2 * i + k] + part * (points[2 * i + 2 + k] - points[2 * i + k]));
}

/** The point of a curve nearest to a place, and how far it is. */
function nearestPoint(points, [x, y]) {
  let [index, nearest] = [-1, Infinity];
  for (let i = 0; i < points.length / 2; i++) {
    const distance = (points[2 * i] - x) ** 2 + (points[2 * i + 1] - y) ** 2;
    if (distance < nearest) [index, nearest] = [i, distance];
  }
  return { index, distance: Math.sqrt(nearest) };
}

/** How many frames a trajectory has, its first and, if its time comes, its last included. */
function frameCount(times, frameTime) {
  const duration = times.length > 1 ? times.at(-1) - times[0] : 0;
  return duration > 0 ? Math.floor(duration / frameTime + 1e-6) + 1 : 0;
}

/**
 * Give new times to all points when handles, which are points, get new times: by a monotone
 * cubic (Fritsch & Butland 1984) through the handles, so that no speed changes with a jerk.
 */
function retimed(times, handles, newTimes) {
  const old = handles.map((i) => times[i]);
  const slope = newTimes.slice(1).map((t, i) => (t - newTimes[i]) / (old[i + 1] - old[i]));
  const tangents = newTimes.map((_, i) => {
    if (i === 0 || i === newTimes.length - 1) return slope[Math.max(0, i - 1)];
    return (2 * slope[i - 1] * slope[i]) / (slope[i - 1] + slope[i]);
  });
  let span = 0;
  return Float64Array.from(times, (time, i) => {
    while (span < handles.length - 2 && i > handles[span + 1]) span++;
    const wide = old[span + 1] - old[span];
    const u = (time - old[span]) / wide;
    const [u2, u3] = [u * u, u * u * u];
    return (
      (2 * u3 - 3 * u2 + 1) * newTimes[span] + (u3 - 2 * u2 + u) * wide * tangents[span] +
      (3 * u2 - 2 * u3) * newTimes[span + 1] + (u3 - u2) * wide * tangents[span + 1]
    );
  });
}

/** Places of frames that follow markers: each row of influence times the markers. */
function placedFrames(influence, markers) {
  const m = markers.length / 2;
  const placed = new Float64Array((2 * influence.length) / m);
  for (let i = 0; i < placed.length / 2; i++) {
    let [x, y] = [0, 0];
    for (let j = 0; j < m; j++) {
      const share = influence[i * m + j];
      x += share * markers[2 * j];
      y += share * markers[2 * j + 1];
    }
    placed[2 * i] = x;
    placed[2 * i + 1] = y;
  }
  return placed;
}
