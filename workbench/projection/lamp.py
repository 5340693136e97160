"""Local affine multidimensional projection."""

from __future__ import annotations

import math

import numpy as np
from numba import prange
from numpy.typing import NDArray

from workbench.kernels import compiled, compiled_parallel
from workbench.projection.control_points import ControlPointProjector


class LAMP(ControlPointProjector):
    """Place each sample by a map that keeps lengths, fitted to the control points near it.

    For a sample x, with weights α_i = 1 / d(x, c_i)² of the control points c_i and their
    weighted means c̃ and ỹ of features and positions, the map is f(x) = ỹ + s · (x − c̃) M.
    Among all M with MᵀM = I, the one that minimises Σ α_i ‖f(c_i) − y_i‖² is U Vᵀ from the
    singular value decomposition U D Vᵀ of Σ α_i (c_i − c̃)ᵀ (y_i − ỹ) (Joia et al. 2011).
    A control point keeps its position exactly.

    Settled here, where the paper is silent:

    - The scale s, one for the whole map, brings the data to the scale of the positions,
      which else would have to be that of the data: it fits best, in least squares, the
      distances between positions to those between the features of the control points.
    - For poses d is D_q, as in all other steps, and the features that M acts on are the
      nine matrix entries of each joint. Weights from √D_q or from the distance of the
      entries gave larger reconstruction errors on the clip 05_10 with each of three seed
      projectors (no difference after optimization).
    - Directions that control points leave undetermined, such as that across collinear
      positions, are left out of M, so that nothing moves along them.

    Attributes
    ----------
    scale_ : float
        s, in the unit of the positions by that of the features.

    Examples
    --------
    >>> from workbench.spaces import VectorSpace
    >>> corners = [[0.0, 0.0, 5.0], [2.0, 0.0, 5.0], [0.0, 2.0, 5.0], [1.0, 1.0, 5.0]]
    >>> projector = LAMP().fit(VectorSpace(corners), [0, 1, 2], [[0, 0], [1, 0], [0, 1]])
    >>> projector.transform([[1.0, 1.0, 5.0]]).round(9)
    array([[0.5, 0.5]])
    """

    scale_: float

    def _fit(self) -> None:
        from scipy.spatial.distance import pdist

        self._features = self.control_samples_.reshape(len(self.control_samples_), -1)
        apart = pdist(self._features)
        norm = float(apart @ apart)
        self.scale_ = float(apart @ pdist(self.positions_)) / norm if norm else 1.0

    def _transform(self, samples: NDArray[np.float64]) -> NDArray[np.float64]:
        distances = self.space_.cross_distances(samples, self.control_samples_)
        result = np.empty((len(samples), self.positions_.shape[1]))
        _place(
            np.ascontiguousarray(samples).reshape(len(samples), -1),
            distances,
            np.ascontiguousarray(self._features),
            self.positions_,
            self.scale_,
            result,
        )
        return result


@compiled_parallel
def _place(samples, distances, features, positions, scale, result):  # type: ignore[no-untyped-def]  # compiled
    for row in prange(samples.shape[0]):
        _place_one(samples[row], distances[row], features, positions, scale, result[row])


@compiled
def _place_one(sample, distances, features, positions, scale, result):  # type: ignore[no-untyped-def]  # compiled
    n_controls, n_features = features.shape
    n_components = positions.shape[1]
    nearest = np.argmin(distances)
    if distances[nearest] == 0.0:
        for c in range(n_components):
            result[c] = positions[nearest, c]
        return
    # Weights relative to the nearest control point's, so that none overflows.
    weights = np.empty(n_controls)
    total = 0.0
    for i in range(n_controls):
        ratio = distances[nearest] / distances[i]
        weights[i] = ratio * ratio
        total += weights[i]
    mean = np.zeros(n_components)
    for i in range(n_controls):
        for c in range(n_components):
            mean[c] += weights[i] / total * positions[i, c]
    # Relative to the sample: the weights make any shift of the features the same, and next
    # to a control point this one loses no digits.
    offset = np.zeros(n_features)
    cross = np.zeros((n_components, n_features))
    shift = np.empty(n_features)
    for i in range(n_controls):
        share = weights[i] / total
        for k in range(n_features):
            shift[k] = features[i, k] - sample[k]
            offset[k] -= share * shift[k]
        for c in range(n_components):
            factor = share * (positions[i, c] - mean[c])
            for k in range(n_features):
                cross[c, k] += factor * shift[k]
    _apply_orthogonal_factor(cross, offset, result)
    for c in range(n_components):
        result[c] = mean[c] + scale * result[c]


@compiled
def _apply_orthogonal_factor(cross, offset, result):  # type: ignore[no-untyped-def]  # compiled
    """Write ``offset`` · U Vᵀ, where ``crossᵀ`` = U D Vᵀ has two or three columns.

    Columns are turned in pairs until they are orthogonal (one-sided Jacobi), which finds
    small singular values to full relative precision; ``cross`` is overwritten.
    """
    n = cross.shape[0]
    turns = np.eye(n)
    for _ in range(30):
        done = True
        for p in range(n - 1):
            for q in range(p + 1, n):
                pp, qq, pq = 0.0, 0.0, 0.0
                for k in range(cross.shape[1]):
                    pp += cross[p, k] * cross[p, k]
                    qq += cross[q, k] * cross[q, k]
                    pq += cross[p, k] * cross[q, k]
                if abs(pq) <= 1e-15 * math.sqrt(pp * qq):
                    continue
                done = False
                theta = (qq - pp) / (2.0 * pq)
                t = math.copysign(1.0, theta) / (abs(theta) + math.hypot(1.0, theta))
                cosine = 1.0 / math.hypot(1.0, t)
                sine = t * cosine
                for k in range(cross.shape[1]):
                    a, b = cross[p, k], cross[q, k]
                    cross[p, k], cross[q, k] = cosine * a - sine * b, sine * a + cosine * b
                for k in range(n):
                    a, b = turns[p, k], turns[q, k]
                    turns[p, k], turns[q, k] = cosine * a - sine * b, sine * a + cosine * b
        if done:
            break
    lengths = np.empty(n)
    for p in range(n):
        lengths[p] = np.linalg.norm(cross[p])
    longest = lengths.max()
    result[:] = 0.0
    for p in range(n):
        if lengths[p] <= 1e-12 * longest:
            continue
        along = 0.0
        for k in range(cross.shape[1]):
            along += cross[p, k] * offset[k]
        for c in range(n):
            result[c] += along / lengths[p] * turns[p, c]
