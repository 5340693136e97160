"""Euler angles of a motion's joints, channel by channel as motion files hold them."""

from __future__ import annotations

import numpy as np
from numba import prange
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.kernels import compiled, compiled_fused, compiled_parallel
from workbench.mocap.elementary import sine_and_cosine
from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.rotations import (
    euler_from_rotations,
    geodesic_angles,
    rotations_from_euler,
)
from workbench.mocap.skeleton import Skeleton

# A rotation that leaves its joint's channels by more than this cannot be meant by rounding.
_TOLERANCE = np.radians(1e-6)

# Larger angles lose their full turns before their sine is computed.
_MOST_DEGREES = 1e9


def rotation_columns(skeleton: Skeleton) -> list[slice]:
    """Locate each joint's columns in an array of all rotation channels.

    Returns
    -------
    list of slice
        One per joint, empty for a joint without rotation channels.
    """
    counts = [len(skeleton.rotation_order(joint)) for joint in range(skeleton.n_joints)]
    ends = np.cumsum(counts).tolist()
    return [slice(end - count, end) for end, count in zip(ends, counts, strict=True)]


#: Frames that one thread composes at a time.
_BLOCK = 64


@compiled_fused
def _fill_sines(degrees, sines, cosines):  # type: ignore[no-untyped-def]  # compiled
    for column in range(len(degrees)):
        sines[column], cosines[column] = sine_and_cosine(degrees[column])


@compiled
def _compose_pose(axes, starts, sines, cosines, pose):  # type: ignore[no-untyped-def]  # compiled
    """Write R_first · R_second · … of each joint; ``axes`` holds 0, 1, 2 per column."""
    for joint in range(pose.shape[0]):
        m = pose[joint]
        start, end = starts[joint], starts[joint + 1]
        if end - start == 3:
            i, j, k = axes[start], axes[start + 1], axes[start + 2]
            # The product for the order XYZ serves all orders: an odd permutation of the
            # axes only changes the sense of every turn.
            sense = 1.0 if (j - i) % 3 == 1 else -1.0
            sa, ca = sense * sines[start], cosines[start]
            sb, cb = sense * sines[start + 1], cosines[start + 1]
            sc, cc = sense * sines[start + 2], cosines[start + 2]
            m[i, i], m[i, j], m[i, k] = cb * cc, -cb * sc, sb
            m[j, i], m[j, j], m[j, k] = ca * sc + sa * sb * cc, ca * cc - sa * sb * sc, -sa * cb
            m[k, i], m[k, j], m[k, k] = sa * sc - ca * sb * cc, sa * cc + ca * sb * sc, ca * cb
            continue
        for i in range(3):
            for j in range(3):
                m[i, j] = 1.0 if i == j else 0.0
        for column in range(start, end):
            s, c = sines[column], cosines[column]
            j = (axes[column] + 1) % 3
            k = (axes[column] + 2) % 3
            for i in range(3):
                p, q = m[i, j], m[i, k]
                m[i, j], m[i, k] = c * p + s * q, c * q - s * p


@compiled_parallel
def _compose(rows, columns, axes, starts, rotations):  # type: ignore[no-untyped-def]  # compiled
    n_frames, n_columns = rotations.shape[0], len(columns)
    for block in prange((n_frames + _BLOCK - 1) // _BLOCK):
        degrees = np.empty(n_columns)
        sines = np.empty(n_columns)
        cosines = np.empty(n_columns)
        for frame in range(block * _BLOCK, min((block + 1) * _BLOCK, n_frames)):
            for column in range(n_columns):
                degrees[column] = rows[frame, columns[column]]
            _fill_sines(degrees, sines, cosines)
            _compose_pose(axes, starts, sines, cosines, rotations[frame])


def rotations_from_channels(skeleton: Skeleton, degrees: ArrayLike) -> NDArray[np.float64]:
    """Compose joint rotations from their channels' angles.

    Parameters
    ----------
    skeleton : Skeleton
        The joints; each has its own rotation channels, none to three, in its own order.
    degrees : array-like of shape (n_frames, n_rotation_channels)
        Angles in degrees, in file order.

    Returns
    -------
    ndarray of shape (n_frames, n_joints, 3, 3)

    Raises
    ------
    WorkbenchError
        If the number of columns is not that of the skeleton's rotation channels.

    Examples
    --------
    >>> hinge = Skeleton(("knee",), [-1], [[0, 0, 0]], (), (("Zrotation",),))
    >>> rotations_from_channels(hinge, [[90.0]]).round(9)[0, 0, 0]
    array([ 0., -1.,  0.])
    """
    degrees = np.asarray(degrees, dtype=np.float64)
    n_columns = sum(len(skeleton.rotation_order(joint)) for joint in range(skeleton.n_joints))
    if degrees.ndim != 2 or degrees.shape[1] != n_columns:
        raise WorkbenchError(f"degrees: got shape {degrees.shape}, want (n_frames, {n_columns})")
    return compose_rows(skeleton, degrees, np.arange(n_columns))


def compose_rows(
    skeleton: Skeleton, rows: NDArray[np.float64], columns: NDArray[np.intp]
) -> NDArray[np.float64]:
    """Compose joint rotations from angles that stand among other channels.

    Parameters
    ----------
    skeleton : Skeleton
        The joints.
    rows : ndarray of shape (n_frames, n_channels)
        All channels of a file; angles in degrees.
    columns : ndarray of shape (n_rotation_channels,)
        Which of them are the rotation channels, in file order.

    Returns
    -------
    ndarray of shape (n_frames, n_joints, 3, 3)
    """
    orders = [skeleton.rotation_order(joint) for joint in range(skeleton.n_joints)]
    axes = np.array(["XYZ".index(axis) for order in orders for axis in order], dtype=np.intp)
    starts = np.cumsum([0, *(len(order) for order in orders)], dtype=np.intp)
    rotations = np.empty((len(rows), skeleton.n_joints, 3, 3))
    if rows.size and not max(rows.max(), -rows.min()) < _MOST_DEGREES:
        rows = np.fmod(rows, 360.0)
    _compose(np.ascontiguousarray(rows), columns, axes, starts, rotations)
    return rotations


def channels_from_rotations(skeleton: Skeleton, rotations: ArrayLike) -> NDArray[np.float64]:
    """Decompose joint rotations into their channels' angles.

    Parameters
    ----------
    skeleton : Skeleton
        The joints.
    rotations : array-like of shape (n_frames, n_joints, 3, 3)
        Rotation of each joint relative to its parent.

    Returns
    -------
    ndarray of shape (n_frames, n_rotation_channels)
        Angles in degrees within [-180, 180], in file order.

    Raises
    ------
    WorkbenchError
        If a joint has a rotation that its channels cannot express, for instance one about
        X where there is only a Z channel.
    """
    rotations = np.asarray(rotations, dtype=np.float64)
    n_joints = skeleton.n_joints
    if rotations.shape != (len(rotations), n_joints, 3, 3):
        raise WorkbenchError(
            f"rotations: got shape {rotations.shape}, want (n_frames, {n_joints}, 3, 3)"
        )
    columns = []
    for joint in range(n_joints):
        order = skeleton.rotation_order(joint)
        angles = _decompose(order, rotations[:, joint])
        missed = geodesic_angles(rotations_from_euler(order, angles), rotations[:, joint])
        # Written so that a NaN is refused too.
        if len(missed) and not missed.max() <= _TOLERANCE:
            frame = int(np.argmax(np.where(np.isnan(missed), np.inf, missed)))
            raise WorkbenchError(
                f"rotations: joint {joint} ({skeleton.names[joint]}) has in frame {frame} a "
                f"rotation off by {np.degrees(missed[frame]):.3g} degrees from what its channels "
                f"({order or 'none'}) can express"
            )
        columns.append(angles)
    return np.concatenate(columns, axis=1)


def motion_to_euler(motion: Motion, *, unwrap: bool = False) -> NDArray[np.float64]:
    """Compute the Euler angles of a motion, for methods that work on angle curves.

    Parameters
    ----------
    motion : Motion
        The motion.
    unwrap : bool, default False
        Keep the curves continuous: in each frame take, of all angles that stand for the
        same rotation, those nearest to the frame before. Otherwise a curve jumps by a full
        turn at ±180 degrees, and by half turns where a joint passes its gimbal lock.

    Returns
    -------
    ndarray of shape (n_frames, n_rotation_channels)
        Angles in degrees, in file order; :func:`rotations_from_channels` is the way back.
    """
    check_motion(motion)
    degrees = channels_from_rotations(motion.skeleton, motion.rotations)
    if unwrap:
        starts = np.array(
            [s.start for s in rotation_columns(motion.skeleton) if s.stop - s.start == 3],
            dtype=np.intp,
        )
        _follow(degrees, starts)
    return degrees


@compiled
def _follow(degrees, triples):  # type: ignore[no-untyped-def]  # compiled
    """Replace angles by the equivalent ones nearest to the frame before, in place.

    Three angles (a, b, c) about different axes have one other representative,
    (a + 180, 180 - b, c + 180), each up to full turns; ``triples`` lists their first columns.
    """
    for frame in range(1, degrees.shape[0]):
        row, before = degrees[frame], degrees[frame - 1]
        for column in range(degrees.shape[1]):
            row[column] += 360.0 * np.round((before[column] - row[column]) / 360.0)
        for start in triples:
            here, there = 0.0, 0.0
            other = np.empty(3)
            for i in range(3):
                angle, last = row[start + i], before[start + i]
                flipped = 180.0 - angle if i == 1 else 180.0 + angle
                other[i] = flipped + 360.0 * np.round((last - flipped) / 360.0)
                here += abs(angle - last)
                there += abs(other[i] - last)
            if there < here:
                for i in range(3):
                    row[start + i] = other[i]


def _decompose(order: str, rotations: NDArray[np.float64]) -> NDArray[np.float64]:
    """Find the angles of (n_frames, 3, 3) rotations about one to three different axes."""
    if len(order) == 3:
        return euler_from_rotations(order, rotations)
    axes = ["XYZ".index(axis) for axis in order]
    angles = np.empty((len(rotations), len(order)))
    if len(order) == 1:
        j, k = (axes[0] + 1) % 3, (axes[0] + 2) % 3
        angles[:, 0] = np.arctan2(
            rotations[:, k, j] - rotations[:, j, k], rotations[:, j, j] + rotations[:, k, k]
        )
    elif len(order) == 2:
        # The first rotation alone moves the second axis, so column R·e_second tells its
        # angle; likewise row e_firstᵀ·R tells the second, over the whole circle.
        first, second = axes
        j, k = (first + 1) % 3, (first + 2) % 3
        turned, sign = (k, 1.0) if second == j else (j, -1.0)
        angles[:, 0] = np.arctan2(sign * rotations[:, turned, second], rotations[:, second, second])
        j, k = (second + 1) % 3, (second + 2) % 3
        turned, sign = (k, -1.0) if first == j else (j, 1.0)
        angles[:, 1] = np.arctan2(sign * rotations[:, first, turned], rotations[:, first, first])
    return np.degrees(angles)
