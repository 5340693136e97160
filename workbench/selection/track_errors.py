"""Errors of frames that are interpolated between two keys, compiled.

All loops that matter run over the frames of one joint and store one number for each, with
no branch and no call of a library, so that they are compiled to instructions on several
frames at once.
"""

from __future__ import annotations

import math

import numpy as np
from numba import prange

from workbench.kernels import compiled, compiled_fused, compiled_parallel
from workbench.mocap.elementary import (
    angle_from_squared_chord,
    sine_and_cosine,
)
from workbench.selection.tracks import EULER, SLERP, Track

#: Frames that are computed together: few enough for the fastest cache.
BLOCK = 64


@compiled_fused
def quaternion_angle(w, x, y, z, a, b, c, d):  # type: ignore[no-untyped-def]  # compiled
    """Compute the rotation angle between two unit quaternions, of either sign."""
    sign = 1.0 if w * a + x * b + y * c + z * d >= 0.0 else -1.0
    dw, dx, dy, dz = w - sign * a, x - sign * b, y - sign * c, z - sign * d
    chord2 = dw * dw + dx * dx + dy * dy + dz * dz
    # With φ half the angle, chord² = 4 sin²(φ/2), and matrices are 8 sin²(φ) apart, squared.
    return angle_from_squared_chord(8.0 * chord2 * (1.0 - 0.25 * chord2))


@compiled_fused
def add_slerp_errors(  # type: ignore[no-untyped-def]  # compiled
    p, q, length, goals, begin, spacing, weight, errors
):
    """Add one joint's weighted angles between its poses and slerp from one key to the next.

    Slerp from p to q is cos(m·θ)·p + sin(m·θ)·u after m frames, where θ is the angle per
    frame and u the unit vector at right angles to p in the plane of p and q.

    Parameters
    ----------
    p, q : ndarray of shape (4,)
        Unit quaternions of the keys.
    length : int
        Frames from the one to the other.
    goals : ndarray of shape (4, n_all)
        Unit quaternions, of which those from ``begin`` on are compared.
    begin : tuple of (int, int)
        Position in ``goals`` of the first to compare, and its frame, counted from ``p``.
    spacing : int
        Frames from one to the next.
    weight : float
        The joint's weight.
    errors : ndarray of shape (n_errors,)
        Added to.
    """
    p0, p1, p2, p3 = p[0], p[1], p[2], p[3]
    q0, q1, q2, q3 = q[0], q[1], q[2], q[3]
    if p0 * q0 + p1 * q1 + p2 * q2 + p3 * q3 < 0.0:
        # Of the two quaternions of a rotation, the nearer one turns the shorter way.
        q0, q1, q2, q3 = -q0, -q1, -q2, -q3
    cosine = p0 * q0 + p1 * q1 + p2 * q2 + p3 * q3
    u0, u1, u2, u3 = q0 - cosine * p0, q1 - cosine * p1, q2 - cosine * p2, q3 - cosine * p3
    sine = math.sqrt(u0 * u0 + u1 * u1 + u2 * u2 + u3 * u3)
    scale = 1.0 / sine if sine > 0.0 else 0.0
    u0, u1, u2, u3 = u0 * scale, u1 * scale, u2 * scale, u3 * scale
    step = math.degrees(math.atan2(sine, cosine)) / length
    start, frame = begin
    end = start + errors.shape[0]
    w, x, y, z = goals[0, start:end], goals[1, start:end], goals[2, start:end], goals[3, start:end]
    for i in range(errors.shape[0]):
        s, c = sine_and_cosine((frame + spacing * i) * step)
        a0, a1, a2, a3 = c * p0 + s * u0, c * p1 + s * u1, c * p2 + s * u2, c * p3 + s * u3
        errors[i] += weight * quaternion_angle(w[i], x[i], y[i], z[i], a0, a1, a2, a3)


@compiled_fused
def _turn(curve, first, last, begin, w, v, v_next, v_after):  # type: ignore[no-untyped-def]  # compiled
    """Multiply quaternions, from the right, by turns about the axis of ``v``."""
    slope = (curve[last] - curve[first]) / (last - first)
    for i in range(w.shape[0]):
        s, c = sine_and_cosine(curve[first] + (begin - first + i) * slope)
        w[i], v[i] = c * w[i] - s * v[i], c * v[i] + s * w[i]
        v_next[i], v_after[i] = c * v_next[i] + s * v_after[i], c * v_after[i] - s * v_next[i]


@compiled_fused
def _add_euler_errors(  # type: ignore[no-untyped-def]  # compiled
    goals, curves, axes, weight, first, last, begin, errors
):
    """Add one joint's weighted angles; ``curves`` is its (3, n_frames) half Euler angles."""
    n = errors.shape[0]
    w, v = np.ones(n), np.zeros((3, n))
    for k in range(3):
        axis = axes[k]
        if axis >= 0:
            _turn(curves[k], first, last, begin, w, v[axis], v[(axis + 1) % 3], v[(axis + 2) % 3])
    end = begin + n
    a, b, c, d = goals[0, begin:end], goals[1, begin:end], goals[2, begin:end], goals[3, begin:end]
    x, y, z = v[0], v[1], v[2]
    for i in range(n):
        errors[i] += weight * quaternion_angle(w[i], x[i], y[i], z[i], a[i], b[i], c[i], d[i])


@compiled
def _add_squares(curve, weight, first, last, begin, errors):  # type: ignore[no-untyped-def]  # compiled
    """Add the squared differences of one curve from the line between two of its frames."""
    start, slope = curve[first], (curve[last] - curve[first]) / (last - first)
    values = curve[begin : begin + errors.shape[0]]
    for i in range(errors.shape[0]):
        difference = values[i] - (start + (begin - first + i) * slope)
        errors[i] += weight * difference * difference


@compiled
def frame_errors(track, first, last, begin, errors):  # type: ignore[no-untyped-def]  # compiled
    """Write the errors of successive frames that are interpolated between two keys.

    Parameters
    ----------
    track : Track
        The frames.
    first, last : int
        The keys.
    begin : int
        The frame that the first error is of; all must lie between the keys.
    errors : ndarray of shape (n_errors,)
        Written to.
    """
    errors[:] = 0.0
    for row in range(track.goals.shape[0]):
        weight = track.weights[row]
        if weight == 0.0:
            continue
        goals = track.goals[row]
        if track.kind == SLERP:
            p, q = goals[:, first], goals[:, last]
            start = (begin, begin - first)
            add_slerp_errors(p, q, last - first, goals, start, 1, weight, errors)
        elif track.kind == EULER:
            curves, axes = track.curves[row], track.axes[row]
            _add_euler_errors(goals, curves, axes, weight, first, last, begin, errors)
        else:
            _add_squares(goals[0], weight, first, last, begin, errors)
    if track.kind != SLERP and track.kind != EULER:
        for i in range(errors.shape[0]):
            errors[i] = math.sqrt(errors[i])


@compiled_parallel
def _all_between(track, first, last, errors):  # type: ignore[no-untyped-def]  # compiled
    n_blocks = (errors.shape[0] + BLOCK - 1) // BLOCK
    for block in prange(n_blocks):
        start = np.int64(block) * BLOCK
        part = errors[start : min(start + BLOCK, errors.shape[0])]
        frame_errors(track, first, last, first + 1 + start, part)


def errors_between(track: Track, first: int, last: int) -> np.ndarray:
    """Compute the errors of all frames between two neighbouring keys.

    Parameters
    ----------
    track : Track
        The frames.
    first, last : int
        The keys.

    Returns
    -------
    ndarray of shape (last - first - 1,)
    """
    errors = np.empty(last - first - 1)
    _all_between(track, first, last, errors)
    return errors
