"""Tracks: a motion or a set of curves, ready to be interpolated between two of its frames.

Keyframe selectors ask one question very often: how wrong is a frame, if it is interpolated
between two given keys? The answer is a compiled function of a track, an array layout in
which the frames of one joint lie side by side, so that many frames are computed at once.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.kernels import compiled
from workbench.mocap.channels import motion_to_euler, rotation_columns
from workbench.spaces import PoseSpace
from workbench.validation import MIN_SAMPLES, as_numbers, finite, require_memory

#: What a track interpolates: rotations, Euler angles of rotations, or plain numbers.
SLERP, EULER, VALUES = 0, 1, 2

#: Interpolators that a motion can be tracked for; both depend on the two nearest keys only.
INTERPOLATORS = ("slerp", "linear")


class Track(NamedTuple):
    """What frames are, what is interpolated between them, and how errors are weighted.

    Attributes
    ----------
    kind : int
        ``SLERP``, ``EULER`` or ``VALUES``.
    goals : ndarray of shape (n_rows, n_parts, n_frames)
        What interpolated frames are compared with: unit quaternions of joints (4 parts), or
        one number of each curve.
    curves : ndarray of shape (n_rows, 3, n_frames)
        Halves of unwrapped Euler angles, in degrees, where these are interpolated; else empty.
    axes : ndarray of shape (n_rows, 3)
        Which axis each of these angles turns about, 0 to 2; −1 for none.
    weights : ndarray of shape (n_rows,)
        Weight of each joint in the error of a frame.
    """

    kind: int
    goals: NDArray[np.float64]
    curves: NDArray[np.float64]
    axes: NDArray[np.intp]
    weights: NDArray[np.float64]

    @property
    def n_frames(self) -> int:
        """Number of frames."""
        return int(self.goals.shape[2])


def pose_track(space: Any, interpolator: str, selector: str) -> Track:
    """Lay a motion out for a selector; errors are D_q divided by the number of joints.

    Parameters
    ----------
    space : PoseSpace
        The motion.
    interpolator : {"slerp", "linear"}
        How poses between keys are rebuilt; ``"linear"`` interpolates unwrapped Euler angles.
    selector : str
        Who asks, for the message.

    Returns
    -------
    Track

    Raises
    ------
    WorkbenchError
        If the space is a table, the interpolator is another, or memory will not suffice.
    """
    check_interpolator(interpolator)
    motion = motion_of(space, selector)
    n_frames, n_joints = len(motion), motion.skeleton.n_joints
    require_memory(
        8.0 * n_frames * n_joints * (4 if interpolator == "slerp" else 12),
        f"{space.name or 'motion'}: selecting among {n_frames} frames",
        "cut the clip into parts or thin it",
    )
    goals = np.empty((n_joints, 4, n_frames))
    _quaternions(space.samples, goals)
    axes = np.full((n_joints, 3), -1, dtype=np.intp)
    curves = np.zeros((n_joints, 3, n_frames if interpolator == "linear" else 0))
    if interpolator == "linear":
        half_angles = motion_to_euler(motion, unwrap=True).T / 2.0
        for joint, columns in enumerate(rotation_columns(motion.skeleton)):
            order = motion.skeleton.rotation_order(joint)
            axes[joint, : len(order)] = ["XYZ".index(axis) for axis in order]
            curves[joint, : len(order)] = half_angles[columns]
    kind = SLERP if interpolator == "slerp" else EULER
    return Track(kind, goals, curves, axes, space.weights / n_joints)


def value_track(values: ArrayLike) -> Track:
    """Lay curves out for linear interpolation; errors are Euclidean distances.

    Parameters
    ----------
    values : array-like of shape (n_frames, n_values)
        One row per frame, in the order of time.

    Returns
    -------
    Track

    Raises
    ------
    WorkbenchError
        If the shape is another, there are fewer than 3 frames or a value is not finite.
    """
    curves = check_curves(values)
    goals = np.ascontiguousarray(curves.T)[:, None, :]
    rows = len(goals)
    nothing = np.zeros((rows, 3, 0))
    return Track(VALUES, goals, nothing, np.full((rows, 3), -1, dtype=np.intp), np.ones(rows))


def motion_of(space: Any, selector: str) -> Any:
    """Take the motion of a space, or say what to use for a table instead.

    Raises
    ------
    WorkbenchError
        If the space is a table.
    """
    if not isinstance(space, PoseSpace):
        raise WorkbenchError(
            f"space: got the table {space.name!r}, want a motion for the selector {selector!r}: "
            "rows of a table have no order in time; use the selectors 'rols' or 'random'"
        )
    return space.motion


def check_interpolator(interpolator: Any) -> None:
    """Refuse an interpolator other than those that depend on the two nearest keys.

    Raises
    ------
    WorkbenchError
        If it is another.
    """
    if interpolator not in INTERPOLATORS:
        raise WorkbenchError(
            f"interpolator: got {interpolator!r}, want one of {', '.join(INTERPOLATORS)}"
        )


def check_curves(values: ArrayLike) -> NDArray[np.float64]:
    """Check curves over time.

    Parameters
    ----------
    values : array-like of shape (n_frames, n_values)
        One row per frame.

    Returns
    -------
    ndarray of shape (n_frames, n_values)

    Raises
    ------
    WorkbenchError
        If the shape is another, there are fewer than 3 frames or a value is not finite.
    """
    array = as_numbers("values", values)
    if array.ndim != 2 or len(array) < MIN_SAMPLES or array.shape[1] < 1:
        raise WorkbenchError(
            f"values: got shape {array.shape}, want at least {MIN_SAMPLES} rows and 1 column"
        )
    return finite(array, "values")


def with_ends(fixed: NDArray[np.intp], n_frames: int, count: int) -> NDArray[np.intp]:
    """Add the first and the last frame to the fixed ones.

    Parameters
    ----------
    fixed : ndarray of shape (n_fixed,)
        Sorted.
    n_frames : int
        Number of frames.
    count : int
        How many keys are wanted.

    Returns
    -------
    ndarray of shape (n_keys,)
        Sorted.

    Raises
    ------
    WorkbenchError
        If these are more than ``count``.
    """
    keys = np.union1d(fixed, [0, n_frames - 1]).astype(np.intp)
    if len(keys) > count:
        raise WorkbenchError(
            f"count: got {count} keyframes, want at least {len(keys)}: the first and the last "
            f"frame are always among them, and {len(fixed)} are fixed"
        )
    return keys


@compiled
def _quaternions(rotations, quaternions):  # type: ignore[no-untyped-def]  # compiled
    """Write the quaternions (w, x, y, z) of (n_frames, n_joints, 3, 3) by joint and part.

    Computed from the largest of the four components, because each of them alone is badly
    conditioned somewhere.
    """
    for joint in range(rotations.shape[1]):
        for frame in range(rotations.shape[0]):
            m = rotations[frame, joint]
            trace = m[0, 0] + m[1, 1] + m[2, 2]
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
            scale = 1.0 / np.sqrt(w * w + x * x + y * y + z * z)
            quaternions[joint, 0, frame] = w * scale
            quaternions[joint, 1, frame] = x * scale
            quaternions[joint, 2, frame] = y * scale
            quaternions[joint, 3, frame] = z * scale
