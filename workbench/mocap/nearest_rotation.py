"""The nearest rotation to a matrix: the orthonormalisation of spatial keyframing."""

from __future__ import annotations

import math

import numpy as np
from numba import prange
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.kernels import compiled, compiled_parallel
from workbench.validation import as_numbers


@compiled
def _quaternion_of_largest_eigenvalue(symmetric, quaternion):  # type: ignore[no-untyped-def]  # compiled
    """Write the unit eigenvector of a 4 x 4 matrix's largest eigenvalue (cyclic Jacobi)."""
    vectors = np.zeros((4, 4))
    for r in range(4):
        vectors[r, r] = 1.0
    for _ in range(30):
        off = 0.0
        for p in range(3):
            for q in range(p + 1, 4):
                off += symmetric[p, q] * symmetric[p, q]
        if off < 1e-32:
            break
        for p in range(3):
            for q in range(p + 1, 4):
                if abs(symmetric[p, q]) < 1e-300:
                    continue
                theta = (symmetric[q, q] - symmetric[p, p]) / (2.0 * symmetric[p, q])
                t = math.copysign(1.0, theta) / (abs(theta) + math.hypot(1.0, theta))
                c = 1.0 / math.hypot(1.0, t)
                s = t * c
                for r in range(4):
                    a, b = symmetric[r, p], symmetric[r, q]
                    symmetric[r, p], symmetric[r, q] = c * a - s * b, s * a + c * b
                for r in range(4):
                    a, b = symmetric[p, r], symmetric[q, r]
                    symmetric[p, r], symmetric[q, r] = c * a - s * b, s * a + c * b
                for r in range(4):
                    a, b = vectors[r, p], vectors[r, q]
                    vectors[r, p], vectors[r, q] = c * a - s * b, s * a + c * b
    best = 0
    for q in range(1, 4):
        if symmetric[q, q] > symmetric[best, best]:
            best = q
    for r in range(4):
        quaternion[r] = vectors[r, best]


@compiled
def _nearest_rotation_by_quaternion(m):  # type: ignore[no-untyped-def]  # compiled
    """Solve for the nearest proper rotation of any matrix, singular or reflecting too.

    Maximises Tr(Rᵀ M) over unit quaternions (Horn 1987), an eigenvalue problem. Tells
    whether there is one: not if an entry is not finite. Loops, because operations on whole
    arrays would take four times as long to compile.
    """
    scale = 0.0
    for row in range(3):
        for column in range(3):
            if not math.isfinite(m[row, column]):
                return False
            scale = max(scale, abs(m[row, column]))
    a = np.zeros((3, 3))
    for row in range(3):
        # The zero matrix is as near to all rotations; that which turns nothing stands for it.
        a[row, row] = 1.0
        for column in range(3):
            if scale > 0.0:
                a[row, column] = m[row, column] / scale
    k = np.empty((4, 4))
    k[0, 0] = a[0, 0] + a[1, 1] + a[2, 2]
    k[1, 1] = a[0, 0] - a[1, 1] - a[2, 2]
    k[2, 2] = a[1, 1] - a[0, 0] - a[2, 2]
    k[3, 3] = a[2, 2] - a[0, 0] - a[1, 1]
    k[0, 1] = k[1, 0] = a[2, 1] - a[1, 2]
    k[0, 2] = k[2, 0] = a[0, 2] - a[2, 0]
    k[0, 3] = k[3, 0] = a[1, 0] - a[0, 1]
    k[1, 2] = k[2, 1] = a[0, 1] + a[1, 0]
    k[1, 3] = k[3, 1] = a[0, 2] + a[2, 0]
    k[2, 3] = k[3, 2] = a[1, 2] + a[2, 1]
    quaternion = np.empty(4)
    _quaternion_of_largest_eigenvalue(k, quaternion)
    w, x, y, z = quaternion[0], quaternion[1], quaternion[2], quaternion[3]
    m[0, 0] = w * w + x * x - y * y - z * z
    m[1, 1] = w * w - x * x + y * y - z * z
    m[2, 2] = w * w - x * x - y * y + z * z
    m[0, 1], m[1, 0] = 2.0 * (x * y - w * z), 2.0 * (x * y + w * z)
    m[0, 2], m[2, 0] = 2.0 * (x * z + w * y), 2.0 * (x * z - w * y)
    m[1, 2], m[2, 1] = 2.0 * (y * z - w * x), 2.0 * (y * z + w * x)
    return True


@compiled
def _nearest_rotation(m):  # type: ignore[no-untyped-def]  # compiled
    """Replace a 3 x 3 matrix by the nearest rotation, in place, and tell whether there is one.

    Newton's iteration for the polar factor, X ← (X + X⁻ᵀ) / 2, converges quadratically and
    leaves a rotation as it is; it fits well-conditioned matrices with a positive
    determinant, nearly all there are. The rest goes to the eigenvalue method, also what is
    not finite, so that looking for that costs the others nothing.
    """
    a, b, c = m[0, 0], m[0, 1], m[0, 2]
    d, e, f = m[1, 0], m[1, 1], m[1, 2]
    g, h, i = m[2, 0], m[2, 1], m[2, 2]
    # The mean squared singular value, and the determinant of a scaled rotation of that norm.
    # Sums are written as trees, which the processor adds up side by side.
    size2 = ((a * a + b * b) + (c * c + d * d) + ((e * e + f * f) + (g * g + h * h)) + i * i) / 3.0
    size = math.sqrt(size2)
    det = a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)
    if not det > 0.05 * size2 * size:
        return _nearest_rotation_by_quaternion(m)
    # Without the size, which Newton is slow at. np.divide spares the check for a zero.
    scale = np.divide(1.0, size)
    a, b, c = a * scale, b * scale, c * scale
    d, e, f = d * scale, e * scale, f * scale
    g, h, i = g * scale, h * scale, i * scale
    for _ in range(12):
        ca, cb, cc = e * i - f * h, f * g - d * i, d * h - e * g
        cd, ce, cf = c * h - b * i, a * i - c * g, b * g - a * h
        cg, ch, ci = b * f - c * e, c * d - a * f, a * e - b * d
        inverse = np.divide(0.5, a * ca + b * cb + c * cc)
        na, nb, nc = 0.5 * a + inverse * ca, 0.5 * b + inverse * cb, 0.5 * c + inverse * cc
        nd, ne, nf = 0.5 * d + inverse * cd, 0.5 * e + inverse * ce, 0.5 * f + inverse * cf
        ng, nh, ni = 0.5 * g + inverse * cg, 0.5 * h + inverse * ch, 0.5 * i + inverse * ci
        change = (
            ((abs(na - a) + abs(nb - b)) + (abs(nc - c) + abs(nd - d)))
            + ((abs(ne - e) + abs(nf - f)) + (abs(ng - g) + abs(nh - h)))
            + abs(ni - i)
        )
        a, b, c, d, e, f, g, h, i = na, nb, nc, nd, ne, nf, ng, nh, ni
        # Quadratic convergence: after a change of 1e-8 the next would be of 1e-16.
        if change < 1e-8:
            m[0, 0], m[0, 1], m[0, 2] = a, b, c
            m[1, 0], m[1, 1], m[1, 2] = d, e, f
            m[2, 0], m[2, 1], m[2, 2] = g, h, i
            return True
    return _nearest_rotation_by_quaternion(m)


@compiled_parallel
def _nearest_rotations(matrices):  # type: ignore[no-untyped-def]  # compiled
    """Replace all matrices in place and count those that have no nearest rotation."""
    refused = 0
    for row in prange(matrices.shape[0]):
        for joint in range(matrices.shape[1]):
            if not _nearest_rotation(matrices[row, joint]):
                refused += 1
    return refused


def nearest_rotations(matrices: ArrayLike, *, overwrite: bool = False) -> NDArray[np.float64]:
    """Find the rotation nearest to each matrix, in the Frobenius norm.

    This is the orthonormalisation of spatial keyframing: interpolated matrix entries no
    longer form a rotation. A rotation is returned unchanged up to rounding; reflections
    and singular matrices give a nearest proper rotation too (Costa 2018, section 3.1,
    names a relaxation; the exact minimiser is used here).

    Parameters
    ----------
    matrices : array-like of shape (..., 3, 3)
        Any finite matrices.
    overwrite : bool
        Whether the result may take the place of the input, to spare memory.

    Returns
    -------
    ndarray of shape (..., 3, 3)
        Orthogonal matrices of determinant 1.

    Raises
    ------
    WorkbenchError
        If the shape is another, or an entry is not finite.

    Examples
    --------
    >>> nearest_rotations(2.0 * np.eye(3))
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    copy = None if overwrite else True
    result = np.array(as_numbers("matrices", matrices, 3, 3), order="C", copy=copy)
    rows = result.shape[0] if result.ndim == 4 else 1
    if result.size and _nearest_rotations(result.reshape(rows, -1, 3, 3)):
        raise WorkbenchError("matrices: got numbers that are not finite")
    return result
