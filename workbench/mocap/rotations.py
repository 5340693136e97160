"""Rotation matrices: Euler angles, rotation vectors, geodesic angle.

Matrices act on column vectors. Arrays of rotations have shape ``(..., 3, 3)``. Angles are
in radians unless a name says degrees.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.validation import as_numbers, finite

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
    angle = np.radians(as_numbers("degrees", degrees))
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
    degrees = as_numbers(f"degrees of the order {order!r}", degrees, len(order))
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
    rotations = as_numbers("rotations", rotations, 3, 3)
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

    matrices = finite(as_numbers("rotations", rotations, 3, 3), "rotations")
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

    array = finite(as_numbers("vectors", vectors, 3), "vectors")
    return Rotation.from_rotvec(array.reshape(-1, 3)).as_matrix().reshape(*array.shape, 3)


def check_rotations(name: str, matrices: NDArray[np.float64]) -> None:
    """Refuse matrices that are no rotations.

    Parameters
    ----------
    name : str
        The argument's name, for the message.
    matrices : ndarray of shape (..., 3, 3)
        Finite matrices.

    Raises
    ------
    WorkbenchError
        If one is mirrored, or further than 1e-6 from orthogonal.

    Examples
    --------
    >>> check_rotations("pose", axis_rotation("X", [0.0, 90.0]))
    """
    skew = np.abs(matrices @ np.swapaxes(matrices, -1, -2) - np.eye(3)).max(initial=0.0)
    if skew > 1e-6 or np.linalg.det(matrices).min(initial=1.0) < 0:
        raise WorkbenchError(
            f"{name}: got matrices that are {skew:.2g} from orthogonal or mirrored, "
            "want rotations (see nearest_rotations)"
        )


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
    curves = as_numbers("angles", angles)
    if curves.ndim == 0:
        raise WorkbenchError("angles: got a single number, want shape (n_frames, ...)")
    return np.unwrap(curves, period=360.0, axis=0)


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
    a, b = as_numbers("a", a, 3, 3), as_numbers("b", b, 3, 3)
    try:
        difference = a - b
    except ValueError:
        raise WorkbenchError(
            f"a and b: got shapes {a.shape} and {b.shape}, want equal ones, or one for all"
        ) from None
    chord = np.sqrt(np.einsum("...ij,...ij->...", difference, difference))
    return 2.0 * np.arcsin(np.minimum(chord / (2.0 * np.sqrt(2.0)), 1.0))
