"""Join clips of one skeleton."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.motion import Motion, check_motion


def join(motions: Sequence[Motion]) -> Motion:
    """Put clips of one skeleton one after the other, for instance to show them on one map.

    Nothing is done about the jumps from one clip to the next.

    Parameters
    ----------
    motions : sequence of Motion
        The clips, at least one.

    Returns
    -------
    Motion
        All their frames, with the first one's skeleton. Its name is theirs with " + " between.

    Raises
    ------
    WorkbenchError
        If there is none, or skeletons or frame rates differ: distances between poses have a
        meaning only if the same joints turn by them.

    Examples
    --------
    >>> from workbench.datasets import load
    >>> jump, turn = load("cmu/01_01-jump"), load("cmu/01_01-turn")
    >>> len(join([jump, turn])) == len(jump) + len(turn)
    True
    """
    if not motions:
        raise WorkbenchError("motions: got none, want at least one")
    for motion in motions:
        check_motion(motion)
        _check_fit(motions[0], motion)
    moved = sorted({joint for motion in motions for joint in motion.joint_translations})
    return Motion(
        skeleton=motions[0].skeleton,
        rotations=np.concatenate([motion.rotations for motion in motions]),
        root_translation=np.concatenate([motion.root_translation for motion in motions]),
        frame_time=motions[0].frame_time,
        joint_translations={
            joint: np.concatenate([_translations(motion, joint) for motion in motions])
            for joint in moved
        },
        name=" + ".join(motion.name for motion in motions),
    )


def _check_fit(first: Motion, other: Motion) -> None:
    if not first.skeleton.same_structure(other.skeleton):
        raise WorkbenchError(
            f"{other.name!r} has another skeleton than {first.name!r}, want clips of one "
            "skeleton: the same joints, with bones of the same length"
        )
    if not np.isclose(first.frame_time, other.frame_time):
        raise WorkbenchError(
            f"{other.name!r} has {1 / other.frame_time:.4g} frames per second and {first.name!r} "
            f"{1 / first.frame_time:.4g}, want one frame rate"
        )


def _translations(motion: Motion, joint: int) -> NDArray[np.float64]:
    """Give the positions of a joint that some clips move; in others it rests at its offset."""
    resting = np.broadcast_to(motion.skeleton.offsets[joint], (len(motion), 3))
    return motion.joint_translations.get(joint, resting)
