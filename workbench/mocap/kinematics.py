"""Forward kinematics: from joint rotations to positions."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.kernels import compiled
from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.skeleton import Skeleton


@compiled
def _place(  # type: ignore[no-untyped-def]  # compiled
    parents, offsets, moved, translations, rotations, root_translation, positions
):
    """Place all nodes of all frames; nodes beyond the last joint are end sites.

    ``moved`` gives the row of ``translations`` that replaces a node's offset, or -1.
    """
    n_joints = rotations.shape[1]
    world = np.empty((n_joints, 3, 3))
    for frame in range(positions.shape[0]):
        for node in range(positions.shape[1]):
            parent = parents[node]
            if parent < 0:
                for i in range(3):
                    positions[frame, node, i] = root_translation[frame, i]
                    for j in range(3):
                        world[node, i, j] = rotations[frame, node, i, j]
                continue
            x, y, z = offsets[node, 0], offsets[node, 1], offsets[node, 2]
            if moved[node] >= 0:
                x = translations[moved[node], frame, 0]
                y = translations[moved[node], frame, 1]
                z = translations[moved[node], frame, 2]
            for i in range(3):
                a, b, c = world[parent, i, 0], world[parent, i, 1], world[parent, i, 2]
                positions[frame, node, i] = positions[frame, parent, i] + a * x + b * y + c * z
                if node < n_joints:
                    for j in range(3):
                        world[node, i, j] = (
                            a * rotations[frame, node, 0, j]
                            + b * rotations[frame, node, 1, j]
                            + c * rotations[frame, node, 2, j]
                        )


def _node_positions(
    skeleton: Skeleton,
    rotations: ArrayLike,
    root_translation: ArrayLike,
    joint_translations: Mapping[int, NDArray[np.float64]] | None,
) -> NDArray[np.float64]:
    """Place the joints, followed by the end sites, as (n_frames, n_joints + n_end_sites, 3)."""
    rotations = np.ascontiguousarray(rotations, dtype=np.float64)
    n_frames, n_joints = len(rotations), skeleton.n_joints
    if rotations.shape != (n_frames, n_joints, 3, 3):
        raise WorkbenchError(
            f"rotations: got shape {rotations.shape}, want (n_frames, {n_joints}, 3, 3)"
        )
    try:
        root = np.ascontiguousarray(
            np.broadcast_to(np.asarray(root_translation, dtype=np.float64), (n_frames, 3))
        )
    except ValueError:
        raise WorkbenchError(
            f"root_translation: got shape {np.shape(root_translation)}, want ({n_frames}, 3)"
        ) from None
    sites = skeleton.end_sites
    parents = np.concatenate([skeleton.parents, np.array([s.joint for s in sites], dtype=np.intp)])
    offsets = np.concatenate(
        [skeleton.offsets, np.array([s.offset for s in sites], dtype=np.float64).reshape(-1, 3)]
    )
    moved = np.full(len(parents), -1, dtype=np.intp)
    translations = np.zeros((len(joint_translations or ()), n_frames, 3))
    for row, (joint, values) in enumerate((joint_translations or {}).items()):
        moved[joint] = row
        translations[row] = values
    positions = np.empty((n_frames, len(parents), 3))
    _place(parents, offsets, moved, translations, rotations, root, positions)
    return positions


def forward_kinematics(
    skeleton: Skeleton,
    rotations: ArrayLike,
    root_translation: ArrayLike = (0.0, 0.0, 0.0),
    joint_translations: Mapping[int, NDArray[np.float64]] | None = None,
) -> NDArray[np.float64]:
    """Compute the world positions of the joints from bare rotations.

    Reconstructed poses are arrays of rotations without a motion around them. With G the
    rotation of a joint in the world, p its position and o its offset:
    G_j = G_parent · R_j and p_j = p_parent + G_parent · o_j.

    Parameters
    ----------
    skeleton : Skeleton
        The joints.
    rotations : array-like of shape (n_frames, n_joints, 3, 3)
        Rotation of each joint relative to its parent.
    root_translation : array-like of shape (n_frames, 3) or (3,)
        World position of the root, in file units; at the origin by default.
    joint_translations : mapping of int to ndarray of shape (n_frames, 3), optional
        Positions relative to the parent that replace the offsets of some joints.

    Returns
    -------
    ndarray of shape (n_frames, n_joints, 3)
        In file units.

    Raises
    ------
    WorkbenchError
        If a shape does not fit the skeleton.

    Examples
    --------
    >>> arm = Skeleton(("shoulder", "elbow"), [-1, 0], [[0, 0, 0], [2, 0, 0]], (), ((), ()))
    >>> quarter_turn = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    >>> forward_kinematics(arm, [[quarter_turn, np.eye(3)]])
    array([[[0., 0., 0.],
            [0., 2., 0.]]])
    """
    nodes = _node_positions(skeleton, rotations, root_translation, joint_translations)
    return nodes[:, : skeleton.n_joints].copy() if skeleton.end_sites else nodes


def joint_positions(motion: Motion) -> NDArray[np.float64]:
    """Compute the world positions of a motion's joints.

    Returns
    -------
    ndarray of shape (n_frames, n_joints, 3)
        In file units.
    """
    return _motion_nodes(motion)[:, : motion.skeleton.n_joints]


def end_site_positions(motion: Motion) -> NDArray[np.float64]:
    """Compute the world positions of a motion's end sites.

    Returns
    -------
    ndarray of shape (n_frames, n_end_sites, 3)
        In file units, in the order of :attr:`Skeleton.end_sites`.
    """
    return _motion_nodes(motion)[:, motion.skeleton.n_joints :]


def root_relative_positions(motion: Motion) -> NDArray[np.float64]:
    """Compute joint positions seen from the root, keeping the directions of the world.

    Only the root's path is removed; a dancer who turns still turns.

    Returns
    -------
    ndarray of shape (n_frames, n_joints, 3)
        In file units; the root's own row is zero.
    """
    check_motion(motion)
    return forward_kinematics(
        motion.skeleton, motion.rotations, joint_translations=motion.joint_translations
    )


def body_positions(motion: Motion) -> NDArray[np.float64]:
    """Compute joint positions in the root's own frame.

    The root's path and its rotation are both removed, so that equal postures have equal
    positions wherever they stand and whichever way they face (the body coordinates of
    Halit 2010, Eq. 4.1).

    Returns
    -------
    ndarray of shape (n_frames, n_joints, 3)
        In file units; the root's own row is zero.
    """
    check_motion(motion)
    rotations = np.array(motion.rotations, dtype=np.float64)
    rotations[:, 0] = np.eye(3)
    return forward_kinematics(
        motion.skeleton, rotations, joint_translations=motion.joint_translations
    )


def _motion_nodes(motion: Motion) -> NDArray[np.float64]:
    check_motion(motion)
    return _node_positions(
        motion.skeleton, motion.rotations, motion.root_translation, motion.joint_translations
    )
