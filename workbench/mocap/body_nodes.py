"""The nodes of a body as it is drawn: joints, followed by end sites."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.mocap.kinematics import end_site_positions, joint_positions
from workbench.mocap.motion import Motion
from workbench.mocap.sides import joint_sides
from workbench.mocap.skeleton import Skeleton

#: What ends the name of a joint above the head, which some files have in place of an end site.
_TOPS = ("headtop", "headend", "headnub", "headtopend")


@dataclass(frozen=True)
class BodyNodes:
    """How the nodes of a body hang together.

    Attributes
    ----------
    names : list of str
        The joint that each node is, or hangs on.
    parents : list of int
        Parent of each node, -1 for the root.
    sides : list of {"left", "right", "middle"}
        Which side of the body each node is on.
    head : int
        The far end of the head's bone, around which a head is drawn; -1 if none is found.
    """

    names: list[str]
    parents: list[int]
    sides: list[str]
    head: int


def body_nodes(skeleton: Skeleton) -> BodyNodes:
    """List joints and end sites of a skeleton with what a drawing needs to know of them.

    Parameters
    ----------
    skeleton : Skeleton
        The joints.

    Returns
    -------
    BodyNodes

    Examples
    --------
    >>> from workbench.datasets import load_space
    >>> nodes = body_nodes(load_space("cmu/01_01-jump").motion.skeleton)
    >>> len(nodes.parents), nodes.names[nodes.head], nodes.sides[nodes.head]
    (38, 'Head', 'middle')
    """
    hanging = [site.joint for site in skeleton.end_sites]
    sides = joint_sides(skeleton.names)
    parents = [*skeleton.parents.tolist(), *hanging]
    return BodyNodes(
        names=[*skeleton.names, *(skeleton.names[joint] for joint in hanging)],
        parents=parents,
        sides=[*sides, *(sides[joint] for joint in hanging)],
        head=_head(skeleton.names, parents),
    )


def node_positions(motion: Motion) -> NDArray[np.float64]:
    """Compute where all nodes are.

    Parameters
    ----------
    motion : Motion
        The clip.

    Returns
    -------
    ndarray of shape (n_frames, n_nodes, 3)
        World positions of joints and end sites, in file units.
    """
    return np.concatenate([joint_positions(motion), end_site_positions(motion)], axis=1)


def _head(names: tuple[str, ...], parents: list[int]) -> int:
    """Find the end of the bone of the joint called head; the joint itself if it has none."""
    plain = ["".join(filter(str.isalnum, name.rpartition(":")[2])).lower() for name in names]
    for joint, name in enumerate(plain):
        if not name.endswith("head"):
            continue
        below = [node for node, parent in enumerate(parents) if parent == joint]
        tops = [node for node in below if node < len(names) and plain[node].endswith(_TOPS)]
        sites = [node for node in below if node >= len(names)]
        return next(iter([*sites, *tops]), joint if joint else -1)
    return -1
