"""Spherical linear interpolation of rotation matrices."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.kernels import compiled
from workbench.validation import as_numbers


@compiled
def _slerp_one(a, b, t, result):  # type: ignore[no-untyped-def]  # compiled
    """Write the rotation a fraction ``t`` of the way from ``a`` to ``b``, all of shape (3, 3).

    The relative rotation aᵀb is turned into a quaternion by the largest of its four
    components, because each of them alone is badly conditioned somewhere and the axis of a
    half turn cannot be read off the antisymmetric part at all.
    """
    if t == 0.0 or t == 1.0:
        for i in range(3):
            for j in range(3):
                result[i, j] = a[i, j] if t == 0.0 else b[i, j]
        return
    m = np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            m[i, j] = a[0, i] * b[0, j] + a[1, i] * b[1, j] + a[2, i] * b[2, j]
    trace = m[0, 0] + m[1, 1] + m[2, 2]
    w, x, y, z = 0.0, 0.0, 0.0, 0.0
    if trace >= m[0, 0] and trace >= m[1, 1] and trace >= m[2, 2]:
        w, x, y, z = 1.0 + trace, m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]
    elif m[0, 0] >= m[1, 1] and m[0, 0] >= m[2, 2]:
        w, x = m[2, 1] - m[1, 2], 1.0 + m[0, 0] - m[1, 1] - m[2, 2]
        y, z = m[0, 1] + m[1, 0], m[0, 2] + m[2, 0]
    elif m[1, 1] >= m[2, 2]:
        w, y = m[0, 2] - m[2, 0], 1.0 + m[1, 1] - m[0, 0] - m[2, 2]
        x, z = m[0, 1] + m[1, 0], m[1, 2] + m[2, 1]
    else:
        w, z = m[1, 0] - m[0, 1], 1.0 + m[2, 2] - m[0, 0] - m[1, 1]
        x, y = m[0, 2] + m[2, 0], m[1, 2] + m[2, 1]
    # Of the two quaternions of a rotation, the one with w >= 0 turns the shorter way.
    if w < 0.0:
        w, x, y, z = -w, -x, -y, -z
    sine = math.sqrt(x * x + y * y + z * z)
    half = math.atan2(sine, w) * t
    scale = math.sin(half) / sine if sine > 0.0 else 0.0
    w, x, y, z = math.cos(half), x * scale, y * scale, z * scale
    m[0, 0] = 1.0 - 2.0 * (y * y + z * z)
    m[1, 1] = 1.0 - 2.0 * (x * x + z * z)
    m[2, 2] = 1.0 - 2.0 * (x * x + y * y)
    m[0, 1], m[1, 0] = 2.0 * (x * y - w * z), 2.0 * (x * y + w * z)
    m[0, 2], m[2, 0] = 2.0 * (x * z + w * y), 2.0 * (x * z - w * y)
    m[1, 2], m[2, 1] = 2.0 * (y * z - w * x), 2.0 * (y * z + w * x)
    for i in range(3):
        for j in range(3):
            result[i, j] = a[i, 0] * m[0, j] + a[i, 1] * m[1, j] + a[i, 2] * m[2, j]


@compiled
def _slerp(a, b, t, result):  # type: ignore[no-untyped-def]  # compiled
    for row in range(len(t)):
        _slerp_one(a[row], b[row], t[row], result[row])


def slerp(a: ArrayLike, b: ArrayLike, t: ArrayLike) -> NDArray[np.float64]:
    """Interpolate between rotations at constant angular speed.

    slerp(A, B, t) = A · exp(t · log(AᵀB)), along the shorter way (Shoemake 1985, written
    for matrices). ``t = 0`` and ``t = 1`` return A and B bit for bit; values outside
    [0, 1] continue the turn. Between exactly opposite rotations, where two ways are
    equally short, one of them is taken.

    Parameters
    ----------
    a, b : array-like of shape (..., 3, 3)
        Rotations at the two ends.
    t : array-like of shape (...)
        Fractions of the way; broadcast against the leading axes of ``a`` and ``b``, so that
        one value per frame needs the shape (n_frames, 1) beside (n_frames, n_joints, 3, 3).

    Returns
    -------
    ndarray of shape (..., 3, 3)

    Raises
    ------
    WorkbenchError
        If the shapes do not fit each other.

    Examples
    --------
    >>> quarter_turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    >>> slerp(np.eye(3), quarter_turn, 0.5)[0].round(4)
    array([ 0.7071, -0.7071,  0.    ])
    """
    a, b, t = as_numbers("a", a), as_numbers("b", b), as_numbers("t", t)
    if a.shape[-2:] != (3, 3) or b.shape[-2:] != (3, 3):
        raise WorkbenchError(f"a, b: got shapes {a.shape} and {b.shape}, want (..., 3, 3)")
    try:
        shape = np.broadcast_shapes(a.shape[:-2], b.shape[:-2], t.shape)
    except ValueError:
        raise WorkbenchError(
            f"t: got shape {t.shape}, want one that broadcasts with {a.shape[:-2]} "
            f"and {b.shape[:-2]}"
        ) from None
    result = np.empty((*shape, 3, 3))
    _slerp(
        np.ascontiguousarray(np.broadcast_to(a, result.shape)).reshape(-1, 3, 3),
        np.ascontiguousarray(np.broadcast_to(b, result.shape)).reshape(-1, 3, 3),
        np.ascontiguousarray(np.broadcast_to(t, shape)).reshape(-1),
        result.reshape(-1, 3, 3),
    )
    return result
