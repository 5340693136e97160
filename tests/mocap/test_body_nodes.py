"""What a drawing needs to know of a body's nodes."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.mocap.body_nodes import body_nodes
from workbench.mocap.skeleton import EndSite, Skeleton


def spine(names: list[str], ends: tuple[int, ...]) -> Skeleton:
    """Make a chain of joints, with end sites on some of them."""
    n = len(names)
    sites = tuple(EndSite(joint, np.array([0.0, 0.5, 0.0])) for joint in ends)
    offsets = np.tile([0.0, 1.0, 0.0], (n, 1))
    return Skeleton(tuple(names), np.arange(-1, n - 1), offsets, sites, ((),) * n)


@pytest.mark.parametrize(
    ("names", "ends", "head"),
    [
        (["Hips", "Neck", "Head"], (2,), 3),
        (["root", "neck", "head"], (), 2),
        (["Bip01", "Bip01 Head", "Bip01 HeadNub"], (2,), 2),
        (["mixamorig:Hips", "mixamorig:Head", "mixamorig:HeadTop_End"], (), 2),
        (["Hips", "Spine", "Neck"], (2,), -1),
        (["Head", "Arm"], (1,), -1),
    ],
    ids=["end site", "joint alone", "nub", "top", "no head", "the root is no head"],
)
def test_the_head_is_found_by_its_name(names: list[str], ends: tuple[int, ...], head: int) -> None:
    """It is the far end of the bone of the joint called head, whatever the file puts there."""
    nodes = body_nodes(spine(names, ends))
    assert nodes.head == head


def test_end_sites_have_the_side_of_their_joint() -> None:
    """They follow the joints, in the order of the skeleton."""
    names = ("Hips", "LeftArm", "RightArm")
    sites = (EndSite(2, np.ones(3)), EndSite(1, np.ones(3)))
    skeleton = Skeleton(names, np.array([-1, 0, 0]), np.ones((3, 3)), sites, ((),) * 3)
    nodes = body_nodes(skeleton)
    assert nodes.parents == [-1, 0, 0, 2, 1]
    assert nodes.sides == ["middle", "left", "right", "right", "left"]
    assert nodes.names[3:] == ["RightArm", "LeftArm"]
