"""Reconstruction quality of motions beside D_q: joint positions and compression."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.distances import position_distance_pairs
from workbench.mocap.kinematics import forward_kinematics, root_relative_positions
from workbench.mocap.motion import Motion, check_motion
from workbench.validation import as_numbers, finite


def position_error(motion: Motion, rotations: ArrayLike) -> float:
    """Measure how far the joints of a reconstruction are from where they were.

    Mean Euclidean distance of joint positions relative to the root's position, over all
    frames and joints, the root included. The root's rotation counts; joints that the motion
    moves as well as turns stay where it moves them.

    Parameters
    ----------
    motion : Motion
        The original.
    rotations : array-like of shape (n_frames, n_joints, 3, 3)
        Rebuilt rotations.

    Returns
    -------
    float
        In file units; times ``skeleton.unit_cm`` where that is known.

    Raises
    ------
    WorkbenchError
        If the rotations do not fit the motion, or are not finite.
    """
    original, rebuilt = _positions(motion, rotations)
    return float(np.linalg.norm(original - rebuilt, axis=2).mean())


def position_distances(
    motion: Motion, rotations: ArrayLike, weights: ArrayLike | None = None
) -> NDArray[np.float64]:
    """Measure D_p between each frame and its reconstruction (Costa 2018, Eq. 3.1).

    D_p(A, B) = Σ_j w_j · ‖P(A_j) − P(B_j)‖² with positions relative to the root's, whose
    path a reconstruction takes from the original; its rotation counts.

    Parameters
    ----------
    motion : Motion
        The original.
    rotations : array-like of shape (n_frames, n_joints, 3, 3)
        Rebuilt rotations.
    weights : array-like of shape (n_joints,), optional
        Joint weights; 1 for every joint by default.

    Returns
    -------
    ndarray of shape (n_frames,)
        In squared file units; its mean is the D_p error of the reconstruction.

    Raises
    ------
    WorkbenchError
        If the rotations or the weights do not fit the motion.
    """
    original, rebuilt = _positions(motion, rotations)
    joint_weights = np.ones(motion.skeleton.n_joints) if weights is None else weights
    return position_distance_pairs(original, rebuilt, as_numbers("weights", joint_weights))


def _positions(
    motion: Motion, rotations: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Place the joints of the original and of the rebuilt frames, seen from the root."""
    check_motion(motion)
    array = as_numbers("rotations", rotations)
    if array.shape != np.shape(motion.rotations):
        raise WorkbenchError(
            f"rotations: got shape {array.shape}, want {np.shape(motion.rotations)}"
        )
    rebuilt = forward_kinematics(
        motion.skeleton,
        finite(array, "rotations"),
        joint_translations=motion.joint_translations,
    )
    return root_relative_positions(motion), rebuilt


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
        If there are no frames, no joints, or more keyframes than frames.

    Examples
    --------
    >>> round(100 / compression_ratio(100_000, 3000, 31), 2)
    6.06
    """
    if n_joints < 1 or n_coordinates < 0:
        raise WorkbenchError(
            f"n_joints and n_coordinates: got {n_joints} and {n_coordinates}, "
            "want at least 1 and at least 0"
        )
    if not 0 < n_keyframes <= n_frames:
        raise WorkbenchError(f"n_keyframes: got {n_keyframes}, want from 1 to {n_frames}")
    original = n_frames * (3 * n_joints + 3)
    compacted = n_keyframes * (3 * n_joints + 1) + n_frames * (3 + n_coordinates)
    return original / compacted
