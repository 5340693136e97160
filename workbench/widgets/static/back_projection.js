// Back-projection by radial basis functions, as Python's RBF and SpatialKeyframes do it, for
// what follows the mouse. Nothing here knows of a page: authoring uses it too.

// Squared distance to the kernel's value, as in backprojection/radial.py.
const RADIAL_KERNELS = {
  linear: (r2) => Math.sqrt(r2),
  "thin-plate": (r2) => (r2 > 0 ? 0.5 * r2 * Math.log(r2) : 0),
  cubic: (r2) => r2 * Math.sqrt(r2),
  gaussian: (r2, epsilon) => Math.exp(-epsilon * epsilon * r2),
  multiquadric: (r2, epsilon) => Math.sqrt(1 + epsilon * epsilon * r2),
};

/**
 * f(x) = sum of w_j phi(|x - c_j|) + P(x).
 * `centers` holds m places, one after the other; `coefficients` a row of outputs for each
 * weight, then for the constant, then for each dimension of the plane.
 */
class RadialFunction {
  constructor({ kernel, epsilon, centers, coefficients, dimensions = 2 }) {
    this.phi = RADIAL_KERNELS[kernel];
    if (!this.phi) throw new Error(`kernel: got ${kernel}, want ${Object.keys(RADIAL_KERNELS).join(", ")}`);
    this.epsilon = epsilon;
    this.centers = centers;
    this.coefficients = coefficients;
    this.dimensions = dimensions;
    this.count = centers.length / dimensions;
    this.outputs = coefficients.length / (this.count + 1 + dimensions);
    this.values = new Float64Array(this.outputs);
  }

  /** Evaluate at a point; the values are overwritten by the next call. */
  at(point) {
    const { centers, coefficients, dimensions, count, outputs, values } = this;
    values.set(coefficients.subarray(count * outputs, (count + 1) * outputs));
    for (let k = 0; k < dimensions; k++) this.add(point[k], count + 1 + k);
    for (let j = 0; j < count; j++) {
      let r2 = 0;
      for (let k = 0; k < dimensions; k++) r2 += (point[k] - centers[j * dimensions + k]) ** 2;
      this.add(this.phi(r2, this.epsilon), j);
    }
    return values;
  }

  add(factor, row) {
    const { coefficients, outputs, values } = this;
    const start = row * outputs;
    for (let i = 0; i < outputs; i++) values[i] += factor * coefficients[start + i];
  }
}

/** Replace each 3 x 3 matrix of a row of them by the nearest rotation. */
function nearestRotations(matrices) {
  for (let at = 0; at < matrices.length; at += 9) nearestRotation(matrices, at);
  return matrices;
}

/**
 * Replace one matrix by the nearest rotation: Newton's iteration for the polar factor where
 * that is safe, an eigenvalue problem for the rest (as mocap/nearest_rotation.py).
 */
function nearestRotation(m, at) {
  let [a, b, c, d, e, f, g, h, i] = [m[at], m[at + 1], m[at + 2], m[at + 3], m[at + 4], m[at + 5], m[at + 6], m[at + 7], m[at + 8]];
  const size2 = (a * a + b * b + c * c + d * d + e * e + f * f + g * g + h * h + i * i) / 3;
  const size = Math.sqrt(size2);
  const det = a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g);
  if (!(det > 0.05 * size2 * size)) return nearestByQuaternion(m, at);
  [a, b, c, d, e, f, g, h, i] = [a / size, b / size, c / size, d / size, e / size, f / size, g / size, h / size, i / size];
  for (let round = 0; round < 12; round++) {
    const ca = e * i - f * h, cb = f * g - d * i, cc = d * h - e * g;
    const cd = c * h - b * i, ce = a * i - c * g, cf = b * g - a * h;
    const cg = b * f - c * e, ch = c * d - a * f, ci = a * e - b * d;
    const inverse = 0.5 / (a * ca + b * cb + c * cc);
    const na = 0.5 * a + inverse * ca, nb = 0.5 * b + inverse * cb, nc = 0.5 * c + inverse * cc;
    const nd = 0.5 * d + inverse * cd, ne = 0.5 * e + inverse * ce, nf = 0.5 * f + inverse * cf;
    const ng = 0.5 * g + inverse * cg, nh = 0.5 * h + inverse * ch, ni = 0.5 * i + inverse * ci;
    const change =
      Math.abs(na - a) + Math.abs(nb - b) + Math.abs(nc - c) + Math.abs(nd - d) + Math.abs(ne - e) +
      Math.abs(nf - f) + Math.abs(ng - g) + Math.abs(nh - h) + Math.abs(ni - i);
    a = na; b = nb; c = nc; d = nd; e = ne; f = nf; g = ng; h = nh; i = ni;
    if (change < 1e-8) {
      m[at] = a; m[at + 1] = b; m[at + 2] = c;
      m[at + 3] = d; m[at + 4] = e; m[at + 5] = f;
      m[at + 6] = g; m[at + 7] = h; m[at + 8] = i;
      return;
    }
  }
  nearestByQuaternion(m, at);
}

/** The rotation that maximises Tr(R^T M) over unit quaternions, for any finite matrix. */
function nearestByQuaternion(m, at) {
  let scale = 0;
  for (let k = 0; k < 9; k++) scale = Math.max(scale, Math.abs(m[at + k]));
  const [a, b, c, d, e, f, g, h, i] = Array.from({ length: 9 }, (_, k) =>
    scale > 0 ? m[at + k] / scale : Number(k % 4 === 0));
  const [w, x, y, z] = largestEigenvector([
    [a + e + i, h - f, c - g, d - b],
    [h - f, a - e - i, b + d, c + g],
    [c - g, b + d, e - i - a, f + h],
    [d - b, c + g, f + h, i - a - e],
  ]);
  m[at] = w * w + x * x - y * y - z * z;
  m[at + 4] = w * w - x * x + y * y - z * z;
  m[at + 8] = w * w - x * x - y * y + z * z;
  m[at + 1] = 2 * (x * y - w * z);
  m[at + 3] = 2 * (x * y + w * z);
  m[at + 2] = 2 * (x * z + w * y);
  m[at + 6] = 2 * (x * z - w * y);
  m[at + 5] = 2 * (y * z - w * x);
  m[at + 7] = 2 * (y * z + w * x);
}

/** The unit eigenvector of a symmetric matrix's largest eigenvalue, by cyclic Jacobi. */
function largestEigenvector(matrix) {
  const n = matrix.length;
  const vectors = matrix.map((_, r) => matrix.map((__, c) => Number(r === c)));
  for (let round = 0; round < 30; round++) {
    let off = 0;
    for (let p = 0; p < n - 1; p++) for (let q = p + 1; q < n; q++) off += matrix[p][q] ** 2;
    if (off < 1e-32) break;
    for (let p = 0; p < n - 1; p++) for (let q = p + 1; q < n; q++) jacobiTurn(matrix, vectors, p, q);
  }
  let best = 0;
  for (let q = 1; q < n; q++) if (matrix[q][q] > matrix[best][best]) best = q;
  return vectors.map((row) => row[best]);
}

/** Turn the plane of two axes so that the entry between them becomes 0. */
function jacobiTurn(matrix, vectors, p, q) {
  if (Math.abs(matrix[p][q]) < 1e-300) return;
  const theta = (matrix[q][q] - matrix[p][p]) / (2 * matrix[p][q]);
  const t = (theta < 0 || Object.is(theta, -0) ? -1 : 1) / (Math.abs(theta) + Math.hypot(1, theta));
  const c = 1 / Math.hypot(1, t);
  const s = t * c;
  const n = matrix.length;
  for (let r = 0; r < n; r++) {
    [matrix[r][p], matrix[r][q]] = [c * matrix[r][p] - s * matrix[r][q], s * matrix[r][p] + c * matrix[r][q]];
  }
  for (let r = 0; r < n; r++) {
    [matrix[p][r], matrix[q][r]] = [c * matrix[p][r] - s * matrix[q][r], s * matrix[p][r] + c * matrix[q][r]];
  }
  for (let r = 0; r < n; r++) {
    [vectors[r][p], vectors[r][q]] = [c * vectors[r][p] - s * vectors[r][q], s * vectors[r][p] + c * vectors[r][q]];
  }
}

/** Euclidean distance between two vectors: the back-projection error of a table's row. */
function vectorError(first, second) {
  let sum = 0;
  for (let i = 0; i < first.length; i++) sum += (first[i] - second[i]) ** 2;
  return Math.sqrt(sum);
}

/** D_q per joint between two poses of rotation matrices (Costa 2018, Eq. 3.2). */
function poseError(first, second, weights) {
  let sum = 0;
  for (let joint = 0; joint < weights.length; joint++) {
    let chord2 = 0;
    for (let i = 9 * joint; i < 9 * joint + 9; i++) chord2 += (first[i] - second[i]) ** 2;
    sum += weights[joint] * 2 * Math.asin(Math.min(1, Math.sqrt(chord2 / 8)));
  }
  return sum / weights.length;
}
