"""Reconstruction quality of motions beside D_q: joint positions and compression."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.kinematics import forward_kinematics, root_relative_positions
from workbench.mocap.motion import Motion


def position_error(motion: Motion, rotations: NDArray[np.float64]) -> float:
    """Measure how far the joints of a reconstruction are from where they were.

    Mean Euclidean distance of joint positions relative to the root's position, over all
    frames and joints, the root included. The root's rotation counts; joints that the motion
    moves as well as turns stay where it moves them.

    Parameters
    ----------
    motion : Motion
        The original.
    rotations : ndarray of shape (n_frames, n_joints, 3, 3)
        Rebuilt rotations.

    Returns
    -------
    float
        In file units; times ``skeleton.unit_cm`` where that is known.
    """
    original = root_relative_positions(motion)
    rebuilt = forward_kinematics(
        motion.skeleton, rotations, joint_translations=motion.joint_translations
    )
    return float(np.linalg.norm(original - rebuilt, axis=2).mean())


def compression_ratio(
    n_frames: int, n_keyframes: int, n_joints: int, *, n_coordinates: int = 0
) -> float:
    """Compare how many numbers a clip and its compacted form hold.

    Without headers, a clip holds f·(3·J + 3) numbers and its compacted form
    k·(3·J + 1) + 3·f + c·f, with f frames, k keyframes, J joints and c stored
    coordinates for each frame (Costa 2018, Eq. 5.1-5.3, with h = 0).

    Parameters
    ----------
    n_frames, n_keyframes, n_joints : int
        f, k and J.
    n_coordinates : int
        Dimensions of the embedding that is stored, 0 for temporal schemes.

    Returns
    -------
    float
        Original over compacted: 12 means twelve times smaller.

    Raises
    ------
    WorkbenchError
        If there are no frames or more keyframes than frames.

    Examples
    --------
    >>> round(100 / compression_ratio(100_000, 3000, 31), 2)
    6.06
    """
    if not 0 < n_keyframes <= n_frames:
        raise WorkbenchError(f"n_keyframes: got {n_keyframes}, want from 1 to {n_frames}")
    original = n_frames * (3 * n_joints + 3)
    compacted = n_keyframes * (3 * n_joints + 1) + n_frames * (3 + n_coordinates)
    return original / compacted
