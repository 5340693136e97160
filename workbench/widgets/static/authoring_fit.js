// Fitting radial functions in the browser, as Python's RBF does it, for markers that are dragged.

// On weights that linear polynomials do not see, these signs make the kernels positive definite.
const KERNEL_SIGNS = { linear: -1, "thin-plate": 1, cubic: 1, gaussian: 1, multiquadric: -1 };
const KERNELS_WITH_WIDTH = ["gaussian", "multiquadric"];
const COINCIDING = 1e-12; // of the extent: no weights could tell such places apart
const UNDETERMINED = 1e-10; // of the largest singular value

/**
 * A radial function through values at places of the plane: `points` holds x and y of each,
 * `values` a row of outputs for each. Places that coincide share the mean of their values.
 * It is kept as what each place counts for at a point: to fit is to factorise one small
 * matrix, whatever the number of outputs. Where places are so close that rounding leaves the
 * matrix without a Cholesky factor, weights are those of least squares and smallest norm.
 */
class FittedRadial {
  constructor({ kernel, epsilon, points, values }) {
    const places = mergedPlaces(points, values);
    const { nodes, middle, size } = scaledPlaces(places.points);
    const n = nodes.length / 2;
    const outputs = values.length / (points.length / 2);
    Object.assign(this, { n, nodes, middle, size, merged: places.merged, rows: places.values, result: new Float64Array(outputs) });
    this.width = KERNELS_WITH_WIDTH.includes(kernel) ? (epsilon ? epsilon * size : usualEpsilon(nodes)) : 1;
    if (!(kernel in KERNEL_SIGNS)) throw new Error(`there is no kernel ${kernel}`);
    this.phi = RADIAL_KERNELS[kernel];
    this.sign = KERNEL_SIGNS[kernel];
    this.matrix = new Float64Array(n * n);
    for (let j = 0; j < n; j++) this.matrix.set(this.basis(nodes[2 * j], nodes[2 * j + 1]), j * n);
    this.seen = polynomialsAt(nodes);
    const system = definite(this.matrix, this.seen.left, n);
    this.factor = choleskyOf(system, n);
    this.inverse = this.factor ? null : pseudoInverse(system, this.seen.left, n);
  }

  /** The kernel, with its sign, between a place and all nodes. */
  basis(x, y) {
    const { n, nodes, phi, sign, width } = this;
    const row = new Float64Array(n);
    for (let j = 0; j < n; j++) row[j] = sign * phi((x - nodes[2 * j]) ** 2 + (y - nodes[2 * j + 1]) ** 2, width);
    return row;
  }

  /**
   * What each node's value counts for at a place. With S the kernel matrix and P the linear
   * polynomials, f = Σ w φ + P b with S w + P b = y and P'w = 0 is linear in y; so u = q + z,
   * where q continues the polynomials and z, which they do not see, solves S z = φ − S q.
   */
  shares(x, y) {
    const { n, matrix, seen, factor, inverse } = this;
    const q = new Float64Array(n);
    seen.left.forEach((column, k) => {
      const along = (seen.right[k][0] + seen.right[k][1] * x + seen.right[k][2] * y) / seen.singular[k];
      for (let i = 0; i < n; i++) q[i] += along * column[i];
    });
    const wanted = residual(matrix, q, this.basis(x, y));
    const start = hidden(wanted.slice(), seen.left);
    const z = factor ? solved(factor, start) : applied(inverse, start);
    if (factor) {
      const rest = solved(factor, hidden(residual(matrix, z, wanted), seen.left));
      for (let i = 0; i < n; i++) z[i] += rest[i];
    }
    hidden(z, seen.left);
    for (let i = 0; i < n; i++) q[i] += z[i];
    return q;
  }

  /** Evaluate at a place; the values are overwritten by the next call. */
  at([x, y]) {
    const { n, rows, result } = this;
    const outputs = result.length;
    const shares = this.shares((x - this.middle[0]) / this.size, (y - this.middle[1]) / this.size);
    // Relative to the first row, so that equal values stay equal everywhere.
    for (let o = 0; o < outputs; o++) result[o] = rows[o];
    for (let i = 1; i < n; i++) {
      const share = shares[i];
      const row = i * outputs;
      for (let o = 0; o < outputs; o++) result[o] += share * (rows[row + o] - rows[o]);
    }
    return result;
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

/** Take from weights what polynomials see of them, in place. */
function hidden(weights, left) {
  for (const column of left) {
    const share = dot(weights, column);
    for (let i = 0; i < weights.length; i++) weights[i] -= share * column[i];
  }
  return weights;
}

/** The matrix among weights that polynomials do not see, and a multiple of one for the rest. */
function definite(matrix, left, n) {
  const result = matrix.slice();
  let largest = 0;
  for (const v of matrix) largest = Math.max(largest, Math.abs(v));
  for (let round = 0; round < 2; round++) {
    for (let i = 0; i < n; i++) hidden(result.subarray(i * n, (i + 1) * n), left);
    for (let i = 0; i < n; i++) for (let j = 0; j < i; j++) [result[i * n + j], result[j * n + i]] = [result[j * n + i], result[i * n + j]];
  }
  for (const column of left) {
    for (let i = 0; i < n; i++) for (let j = 0; j < n; j++) result[i * n + j] += (largest || 1) * column[i] * column[j];
  }
  return result;
}

/** The Cholesky factor, below the diagonal; null where rounding leaves none. */
function choleskyOf(matrix, n) {
  const factor = matrix.slice();
  for (let i = 0; i < n; i++) {
    for (let j = 0; j <= i; j++) {
      let sum = factor[i * n + j];
      for (let k = 0; k < j; k++) sum -= factor[i * n + k] * factor[j * n + k];
      if (i > j) factor[i * n + j] = sum / factor[j * n + j];
      else if (sum > 0) factor[i * n + i] = Math.sqrt(sum);
      else return null;
    }
  }
  return factor;
}

/** Solve with a Cholesky factor, in place. */
function solved(factor, vector) {
  const n = vector.length;
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < i; j++) vector[i] -= factor[i * n + j] * vector[j];
    vector[i] /= factor[i * n + i];
  }
  for (let i = n - 1; i >= 0; i--) {
    for (let j = i + 1; j < n; j++) vector[i] -= factor[j * n + i] * vector[j];
    vector[i] /= factor[i * n + i];
  }
  return vector;
}

/**
 * The inverse for least squares, as NumPy's lstsq has it: directions whose eigenvalue is nothing
 * but rounding, beside the largest one among weights that polynomials do not see, are left out.
 */
function pseudoInverse(matrix, left, n) {
  const rows = Array.from({ length: n }, (_, i) => matrix.slice(i * n, (i + 1) * n));
  const vectors = rows.map((_, i) => Float64Array.from({ length: n }, (__, j) => Number(i === j)));
  const size = Math.sqrt(dot(matrix, matrix));
  for (let round = 0; round < 30; round++) {
    let off = 0;
    for (let p = 0; p < n - 1; p++) for (let q = p + 1; q < n; q++) off = Math.max(off, Math.abs(rows[p][q]));
    if (off <= Number.EPSILON * size) break;
    for (let p = 0; p < n - 1; p++) for (let q = p + 1; q < n; q++) jacobiTurn(rows, vectors, p, q);
  }
  const directions = rows.map((row, k) => ({ value: row[k], vector: Float64Array.from(vectors, (entries) => entries[k]) }));
  const unseen = ({ vector }) => left.reduce((sum, column) => sum + dot(column, vector) ** 2, 0) < 0.5;
  const largest = Math.max(...directions.filter(unseen).map(({ value }) => Math.abs(value)));
  const cutoff = Number.EPSILON * (n - left.length) * largest;
  const result = new Float64Array(n * n);
  for (const { value, vector } of directions) {
    if (!(Math.abs(value) > cutoff)) continue;
    for (let i = 0; i < n; i++) for (let j = 0; j < n; j++) result[i * n + j] += (vector[i] * vector[j]) / value;
  }
  return result;
}

function applied(matrix, vector) {
  const n = vector.length;
  return vector.map((_, i) => dot(matrix.subarray(i * n, (i + 1) * n), vector));
}

function residual(matrix, weights, wanted) {
  const n = weights.length;
  return wanted.map((v, i) => {
    for (let j = 0; j < n; j++) v -= matrix[i * n + j] * weights[j];
    return v;
  });
}
