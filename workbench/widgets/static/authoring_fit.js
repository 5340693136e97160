// Fitting radial functions in the browser, as Python's RBF does it, for markers that are dragged.

// On weights that linear polynomials do not see, these signs make the kernels positive definite.
const KERNEL_SIGNS = { linear: -1, "thin-plate": 1, cubic: 1, gaussian: 1, multiquadric: -1 };
const KERNELS_WITH_WIDTH = ["gaussian", "multiquadric"];
const COINCIDING = 1e-12; // of the extent: no weights could tell such places apart
const UNDETERMINED = 1e-10; // of the largest singular value

/**
 * A radial function through values at places of the plane: `points` holds x and y of each,
 * `values` a row of outputs for each. Places that coincide share the mean of their values.
 * Throws if places are so close that no weights can be found.
 */
class FittedRadial {
  constructor({ kernel, epsilon, points, values }) {
    const places = mergedPlaces(points, values);
    this.merged = places.merged;
    this.outputs = values.length / (points.length / 2);
    const { nodes, middle, size } = scaledPlaces(places.points);
    Object.assign(this, { middle, size, scaled: [0, 0] });
    const width = KERNELS_WITH_WIDTH.includes(kernel) ? (epsilon || usualEpsilon(nodes) / size) * size : 1;
    const coefficients = this.solve(kernel, width, nodes, places.values);
    this.radial = new RadialFunction({ kernel, epsilon: width, centers: nodes, coefficients });
  }

  /** Evaluate at a place; the values are overwritten by the next call. */
  at([x, y]) {
    this.scaled[0] = (x - this.middle[0]) / this.size;
    this.scaled[1] = (y - this.middle[1]) / this.size;
    return this.radial.at(this.scaled);
  }

  /** Solve S w + P b = y with P'w = 0, S the kernel matrix with its sign. */
  solve(kernel, width, nodes, values) {
    const { outputs } = this;
    const n = nodes.length / 2;
    const sign = KERNEL_SIGNS[kernel];
    const matrix = new Float64Array(n * n);
    for (let i = 0; i < n; i++) {
      for (let j = 0; j < n; j++) {
        const r2 = (nodes[2 * i] - nodes[2 * j]) ** 2 + (nodes[2 * i + 1] - nodes[2 * j + 1]) ** 2;
        matrix[i * n + j] = sign * RADIAL_KERNELS[kernel](r2, width);
      }
    }
    // Relative to the first row, so that equal values stay equal everywhere.
    const wanted = new Float64Array(n * outputs);
    for (let i = 0; i < wanted.length; i++) wanted[i] = values[i] - values[i % outputs];
    const seen = polynomialsAt(nodes);
    const factor = choleskyOf(definite(matrix, seen.left, n), n);
    const weights = wanted.slice();
    hidden(weights, seen.left, outputs);
    solveRows(factor, weights, n, outputs);
    const rest = residual(matrix, weights, wanted, n, outputs);
    hidden(rest, seen.left, outputs);
    solveRows(factor, rest, n, outputs);
    for (let i = 0; i < weights.length; i++) weights[i] += rest[i];
    hidden(weights, seen.left, outputs);
    const coefficients = new Float64Array((n + 3) * outputs);
    for (let i = 0; i < weights.length; i++) coefficients[i] = sign * weights[i];
    const left = residual(matrix, weights, wanted, n, outputs);
    seen.left.forEach((column, k) => {
      const share = shareOf(left, column, outputs);
      for (let row = 0; row < 3; row++) {
        const factorOfRow = seen.right[k][row] / seen.singular[k];
        for (let o = 0; o < outputs; o++) coefficients[(n + row) * outputs + o] += factorOfRow * share[o];
      }
    });
    for (let o = 0; o < outputs; o++) coefficients[n * outputs + o] += values[o];
    return coefficients;
  }
}

/** Replace points at one place by one with their mean values, as backprojection/places.py. */
function mergedPlaces(points, values) {
  const n = points.length / 2;
  const outputs = values.length / n;
  const { low, extent } = boxOf(points);
  const groups = new Map();
  for (let i = 0; i < n; i++) {
    const key = [0, 1].map((k) => Math.round((points[2 * i + k] - low[k]) / (COINCIDING * extent))).join();
    groups.set(key, [...(groups.get(key) ?? []), i]);
  }
  const found = [...groups.values()];
  const merged = found.filter((group) => group.length > 1);
  if (!merged.length) return { points, values, merged };
  const means = new Float64Array(found.length * outputs);
  found.forEach((group, g) => {
    for (const i of group) for (let o = 0; o < outputs; o++) means[g * outputs + o] += values[i * outputs + o] / group.length;
  });
  return { points: Float64Array.from(found.flatMap(([i]) => [points[2 * i], points[2 * i + 1]])), values: means, merged };
}

function boxOf(points) {
  const [low, high] = [[Infinity, Infinity], [-Infinity, -Infinity]];
  for (let i = 0; i < points.length; i++) {
    low[i % 2] = Math.min(low[i % 2], points[i]);
    high[i % 2] = Math.max(high[i % 2], points[i]);
  }
  return { low, high, extent: Math.max(high[0] - low[0], high[1] - low[1]) || 1 };
}

/** Centre and scale places, so that the polynomial is as well conditioned as can be. */
function scaledPlaces(points) {
  const n = points.length / 2;
  const middle = [0, 0];
  points.forEach((v, i) => (middle[i % 2] += v / n));
  let size = 0;
  points.forEach((v, i) => (size = Math.max(size, Math.abs(v - middle[i % 2]))));
  size ||= 1;
  return { nodes: points.map((v, i) => (v - middle[i % 2]) / size), middle, size };
}

/** Hardy's width: by the mean distance from each place to its nearest. */
function usualEpsilon(nodes) {
  const n = nodes.length / 2;
  if (n < 2) return 1;
  let sum = 0;
  for (let i = 0; i < n; i++) {
    let gap = Infinity;
    for (let j = 0; j < n; j++) if (j !== i) gap = Math.min(gap, Math.hypot(nodes[2 * i] - nodes[2 * j], nodes[2 * i + 1] - nodes[2 * j + 1]));
    sum += gap;
  }
  return n / (0.815 * sum);
}

/** Singular values and vectors of 1, x, y at the places, by one-sided Jacobi turns. */
function polynomialsAt(nodes) {
  const n = nodes.length / 2;
  const columns = [new Float64Array(n).fill(1), nodes.filter((_, i) => i % 2 === 0), nodes.filter((_, i) => i % 2 === 1)];
  const right = [0, 1, 2].map((k) => Float64Array.from([0, 1, 2], (row) => Number(row === k)));
  for (let round = 0; round < 30; round++) {
    let turned = false;
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      const [alpha, beta, gamma] = [dot(columns[p], columns[p]), dot(columns[q], columns[q]), dot(columns[p], columns[q])];
      if (Math.abs(gamma) <= 1e-15 * Math.sqrt(alpha * beta)) continue;
      const zeta = (beta - alpha) / (2 * gamma);
      const t = (zeta < 0 ? -1 : 1) / (Math.abs(zeta) + Math.hypot(1, zeta));
      const c = 1 / Math.hypot(1, t);
      for (const pair of [columns, right]) turnColumns(pair[p], pair[q], c, c * t);
      turned = true;
    }
    if (!turned) break;
  }
  const norms = columns.map((column) => Math.sqrt(dot(column, column)));
  const kept = [0, 1, 2].filter((k) => norms[k] > UNDETERMINED * Math.max(...norms));
  return {
    left: kept.map((k) => columns[k].map((v) => v / norms[k])),
    singular: kept.map((k) => norms[k]),
    right: kept.map((k) => right[k]),
  };
}

function turnColumns(first, second, c, s) {
  for (let i = 0; i < first.length; i++) {
    [first[i], second[i]] = [c * first[i] - s * second[i], s * first[i] + c * second[i]];
  }
}

function dot(a, b) {
  let sum = 0;
  for (let i = 0; i < a.length; i++) sum += a[i] * b[i];
  return sum;
}

/** A row of outputs: the sum of rows, each times its entry of a column. */
function shareOf(rows, column, outputs) {
  const share = new Float64Array(outputs);
  for (let i = 0; i < column.length; i++) for (let o = 0; o < outputs; o++) share[o] += column[i] * rows[i * outputs + o];
  return share;
}

/** Take from rows what polynomials see of them. */
function hidden(rows, left, outputs) {
  for (const column of left) {
    const share = shareOf(rows, column, outputs);
    for (let i = 0; i < column.length; i++) for (let o = 0; o < outputs; o++) rows[i * outputs + o] -= column[i] * share[o];
  }
}

/** The matrix among weights that polynomials do not see, and a multiple of one for the rest. */
function definite(matrix, left, n) {
  const result = matrix.slice();
  hidden(result, left, n);
  const turned = new Float64Array(n * n);
  for (let i = 0; i < n; i++) for (let j = 0; j < n; j++) turned[j * n + i] = result[i * n + j];
  hidden(turned, left, n);
  let largest = 0;
  for (const v of matrix) largest = Math.max(largest, Math.abs(v));
  for (const column of left) {
    for (let i = 0; i < n; i++) for (let j = 0; j < n; j++) turned[i * n + j] += (largest || 1) * column[i] * column[j];
  }
  return turned;
}

function choleskyOf(matrix, n) {
  const factor = matrix.slice();
  for (let i = 0; i < n; i++) {
    for (let j = 0; j <= i; j++) {
      let sum = factor[i * n + j];
      for (let k = 0; k < j; k++) sum -= factor[i * n + k] * factor[j * n + k];
      if (i > j) factor[i * n + j] = sum / factor[j * n + j];
      else if (sum > 0) factor[i * n + i] = Math.sqrt(sum);
      else throw new Error("markers are too close to each other");
    }
  }
  return factor;
}

/** Solve for all outputs at once, in place. */
function solveRows(factor, rows, n, outputs) {
  const take = (i, j, amount) => {
    const [to, from] = [i * outputs, j * outputs];
    for (let o = 0; o < outputs; o++) rows[to + o] -= amount * rows[from + o];
  };
  const divide = (i) => {
    const by = factor[i * n + i];
    for (let o = i * outputs; o < (i + 1) * outputs; o++) rows[o] /= by;
  };
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < i; j++) take(i, j, factor[i * n + j]);
    divide(i);
  }
  for (let i = n - 1; i >= 0; i--) {
    for (let j = i + 1; j < n; j++) take(i, j, factor[j * n + i]);
    divide(i);
  }
}

function residual(matrix, weights, wanted, n, outputs) {
  const rest = wanted.slice();
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n; j++) {
      const entry = matrix[i * n + j];
      const [to, from] = [i * outputs, j * outputs];
      for (let o = 0; o < outputs; o++) rest[to + o] -= entry * weights[from + o];
    }
  }
  return rest;
}
