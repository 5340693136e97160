"""Rotation matrices: Euler angles, nearest rotation, geodesic angle.

Matrices act on column vectors. Arrays of rotations have shape ``(..., 3, 3)``. Angles are
in radians unless a name says degrees.
"""

from __future__ import annotations

import math

import numpy as np
from numba import prange
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.kernels import compiled, compiled_parallel

_AXES = {"X": 0, "Y": 1, "Z": 2}


def axis_rotation(axis: str, degrees: ArrayLike) -> NDArray[np.float64]:
    """Build rotations about a coordinate axis.

    Parameters
    ----------
    axis : {"X", "Y", "Z"}
        The axis.
    degrees : array-like of shape (...)
        Angles in degrees.

    Returns
    -------
    ndarray of shape (..., 3, 3)

    Raises
    ------
    WorkbenchError
        If there is no such axis, or the angles are no numbers.

    Examples
    --------
    >>> axis_rotation("Z", 90.0).round(6) @ np.array([1.0, 0.0, 0.0])
    array([0., 1., 0.])
    """
    if axis not in tuple(_AXES):  # a tuple, because what cannot be hashed is no axis either
        raise WorkbenchError(f"axis: got {axis!r}, want 'X', 'Y' or 'Z'")
    angle = np.radians(_numbers("degrees", degrees))
    k = _AXES[axis]
    i, j = (k + 1) % 3, (k + 2) % 3
    matrix = np.zeros((*angle.shape, 3, 3))
    matrix[..., k, k] = 1.0
    matrix[..., i, i] = matrix[..., j, j] = np.cos(angle)
    matrix[..., j, i] = np.sin(angle)
    matrix[..., i, j] = -matrix[..., j, i]
    return matrix


def rotations_from_euler(order: str, degrees: ArrayLike) -> NDArray[np.float64]:
    """Compose rotations from Euler angles.

    The rotation is R_first · R_second · R_third, the convention of BVH channels read from
    left to right.

    Parameters
    ----------
    order : str
        Axes such as ``"ZYX"``; up to three, possibly none (the identity).
    degrees : array-like of shape (..., len(order))
        Angles in degrees, in that order.

    Returns
    -------
    ndarray of shape (..., 3, 3)

    Raises
    ------
    WorkbenchError
        If there is no such axis, or not one angle for each.

    Examples
    --------
    >>> rotations_from_euler("ZX", [90.0, 90.0]).round(6) @ np.array([0.0, 1.0, 0.0])
    array([0., 0., 1.])
    """
    if not isinstance(order, str) or not set(order) <= set(_AXES):
        raise WorkbenchError(f"order: got {order!r}, want axes such as 'ZYX'")
    degrees = _numbers(f"degrees of the order {order!r}", degrees, len(order))
    result = np.broadcast_to(np.eye(3), (*degrees.shape[:-1], 3, 3)).copy()
    for column, axis in enumerate(order):
        result = result @ axis_rotation(axis, degrees[..., column])
    return result


def euler_from_rotations(order: str, rotations: ArrayLike) -> NDArray[np.float64]:
    """Decompose rotations into Euler angles.

    Parameters
    ----------
    order : str
        Three different axes, such as ``"ZYX"``.
    rotations : array-like of shape (..., 3, 3)
        Rotation matrices.

    Returns
    -------
    ndarray of shape (..., 3)
        Angles in degrees, the middle one within [-90, 90]. In gimbal lock, where only a
        sum of the outer angles is determined, the last one is 0.

    Raises
    ------
    WorkbenchError
        If the axes are not three different ones, or the shape is another.

    Examples
    --------
    >>> euler_from_rotations("ZXY", rotations_from_euler("ZXY", [10.0, 20.0, 30.0])).round(9)
    array([10., 20., 30.])
    """
    if not isinstance(order, str) or sorted(order) != ["X", "Y", "Z"]:
        raise WorkbenchError(f"order: got {order!r}, want three different axes such as 'ZYX'")
    rotations = _numbers("rotations", rotations, 3, 3)
    i, j, k = (_AXES[axis] for axis in order)
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    sine = np.clip(sign * rotations[..., i, k], -1.0, 1.0)
    # atan2 keeps its precision near +-90 degrees, where arcsin loses half the digits.
    cosine = np.hypot(rotations[..., i, i], rotations[..., i, j])
    second = np.arctan2(sine, cosine)
    first = np.arctan2(-sign * rotations[..., j, k], rotations[..., k, k])
    third = np.arctan2(-sign * rotations[..., i, j], rotations[..., i, i])
    locked = cosine < 1e-9
    first = np.where(locked, np.arctan2(sign * rotations[..., k, j], rotations[..., j, j]), first)
    third = np.where(locked, 0.0, third)
    return np.degrees(np.stack([first, second, third], axis=-1))


def rotation_vectors(rotations: ArrayLike) -> NDArray[np.float64]:
    """Write rotations as axis times angle.

    Parameters
    ----------
    rotations : array-like of shape (..., 3, 3)
        Rotation matrices.

    Returns
    -------
    ndarray of shape (..., 3)
        Vectors along the axes, as long as the angles in radians, at most π.

    Raises
    ------
    WorkbenchError
        If the shape is another, or a matrix is singular, mirrored or not finite.

    Examples
    --------
    >>> rotation_vectors(axis_rotation("Y", 90.0)).round(4)
    array([0.    , 1.5708, 0.    ])
    """
    from scipy.spatial.transform import Rotation

    matrices = _finite("rotations", _numbers("rotations", rotations, 3, 3))
    try:
        vectors = Rotation.from_matrix(matrices.reshape(-1, 3, 3)).as_rotvec()
    except ValueError:
        raise WorkbenchError(
            "rotations: got a singular or mirrored matrix, want rotations (see nearest_rotations)"
        ) from None
    return vectors.reshape(matrices.shape[:-1])


def rotations_from_vectors(vectors: ArrayLike) -> NDArray[np.float64]:
    """Turn rotation vectors into matrices; undoes :func:`rotation_vectors`.

    Parameters
    ----------
    vectors : array-like of shape (..., 3)
        Axes times angles in radians.

    Returns
    -------
    ndarray of shape (..., 3, 3)

    Raises
    ------
    WorkbenchError
        If the shape is another, or a number is not finite.

    Examples
    --------
    >>> np.allclose(rotations_from_vectors([np.pi / 2, 0, 0]), axis_rotation("X", 90.0))
    True
    """
    from scipy.spatial.transform import Rotation

    array = _finite("vectors", _numbers("vectors", vectors, 3))
    return Rotation.from_rotvec(array.reshape(-1, 3)).as_matrix().reshape(*array.shape, 3)


def unwrap_degrees(angles: ArrayLike) -> NDArray[np.float64]:
    """Remove jumps of full turns from angle curves.

    Parameters
    ----------
    angles : array-like of shape (n_frames, ...)
        Angles in degrees.

    Returns
    -------
    ndarray of the same shape

    Raises
    ------
    WorkbenchError
        If there are no frames to compare, only a single number.

    Examples
    --------
    >>> unwrap_degrees([170.0, -170.0])
    array([170., 190.])
    """
    curves = _numbers("angles", angles)
    if curves.ndim == 0:
        raise WorkbenchError("angles: got a single number, want shape (n_frames, ...)")
    return np.unwrap(curves, period=360.0, axis=0)


@compiled
def _quaternion_of_largest_eigenvalue(symmetric, quaternion):  # type: ignore[no-untyped-def]  # compiled
    """Write the unit eigenvector of a 4 x 4 matrix's largest eigenvalue (cyclic Jacobi)."""
    vectors = np.eye(4)
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
    whether there is one: not if an entry is not finite.
    """
    if not np.isfinite(m).all():
        return False
    scale = np.abs(m).max()
    if scale == 0.0:
        m[:] = np.eye(3)
        return True
    a = m / scale
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
    norm2 = a * a + b * b + c * c + d * d + e * e + f * f + g * g + h * h + i * i
    for iteration in range(12):
        ca, cb, cc = e * i - f * h, f * g - d * i, d * h - e * g
        det = a * ca + b * cb + c * cc
        # det relative to (norm / sqrt 3)³, the determinant of a scaled rotation of that norm.
        if iteration == 0 and not det > 0.05 * (norm2 / 3.0) ** 1.5:
            break
        cd, ce, cf = c * h - b * i, a * i - c * g, b * g - a * h
        cg, ch, ci = b * f - c * e, c * d - a * f, a * e - b * d
        # Scaling by det^(-1/3) first removes the size, which Newton is slow at.
        size = det ** (-1.0 / 3.0) if iteration == 0 else 1.0
        inverse = 0.5 / (det * size)
        half = 0.5 * size
        na, nb, nc = half * a + inverse * ca, half * b + inverse * cb, half * c + inverse * cc
        nd, ne, nf = half * d + inverse * cd, half * e + inverse * ce, half * f + inverse * cf
        ng, nh, ni = half * g + inverse * cg, half * h + inverse * ch, half * i + inverse * ci
        change = (
            abs(na - a)
            + abs(nb - b)
            + abs(nc - c)
            + abs(nd - d)
            + abs(ne - e)
            + abs(nf - f)
            + abs(ng - g)
            + abs(nh - h)
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


def nearest_rotations(matrices: ArrayLike) -> NDArray[np.float64]:
    """Find the rotation nearest to each matrix, in the Frobenius norm.

    This is the orthonormalisation of spatial keyframing: interpolated matrix entries no
    longer form a rotation. A rotation is returned unchanged up to rounding; reflections
    and singular matrices give a nearest proper rotation too (Costa 2018, section 3.1,
    names a relaxation; the exact minimiser is used here).

    Parameters
    ----------
    matrices : array-like of shape (..., 3, 3)
        Any finite matrices.

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
    result = _numbers("matrices", matrices, 3, 3).copy()
    rows = result.shape[0] if result.ndim == 4 else 1
    if result.size and _nearest_rotations(result.reshape(rows, -1, 3, 3)):
        raise WorkbenchError("matrices: got numbers that are not finite")
    return result


def geodesic_angles(a: ArrayLike, b: ArrayLike) -> NDArray[np.float64]:
    """Measure the angle of the rotation between two rotations.

    Computed as 2·asin(‖A − B‖_F / (2√2)), which is exact near 0, where the arccos of the
    trace loses half its digits.

    Parameters
    ----------
    a, b : array-like of shape (..., 3, 3)
        Rotations.

    Returns
    -------
    ndarray of shape (...)
        Angles in radians, within [0, π].

    Raises
    ------
    WorkbenchError
        If a shape is another, or the two do not fit each other.

    Examples
    --------
    >>> float(np.degrees(geodesic_angles(np.eye(3), axis_rotation("X", 60.0))).round(9))
    60.0
    """
    a, b = _numbers("a", a, 3, 3), _numbers("b", b, 3, 3)
    try:
        difference = a - b
    except ValueError:
        raise WorkbenchError(
            f"a and b: got shapes {a.shape} and {b.shape}, want equal ones, or one for all"
        ) from None
    chord = np.sqrt(np.einsum("...ij,...ij->...", difference, difference))
    return 2.0 * np.arcsin(np.minimum(chord / (2.0 * np.sqrt(2.0)), 1.0))


def _numbers(name: str, values: ArrayLike, *ending: int) -> NDArray[np.float64]:
    """Take values as numbers, refusing an array whose last axes have other lengths."""
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise WorkbenchError(f"{name}: got what is no array of numbers") from None
    if array.shape[array.ndim - len(ending) :] != ending:
        wanted = ", ".join(["...", *map(str, ending)])
        raise WorkbenchError(f"{name}: got shape {array.shape}, want ({wanted})")
    return array


def _finite(name: str, array: NDArray[np.float64]) -> NDArray[np.float64]:
    if not np.isfinite(array).all():
        raise WorkbenchError(f"{name}: got numbers that are not finite")
    return array
