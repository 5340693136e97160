"""What Python gives the motion player."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.mocap.kinematics import end_site_positions, joint_positions
from workbench.mocap.motion import Motion
from workbench.widgets.player import MotionPlayer, motion_traits


@pytest.fixture(scope="module")
def jump() -> Motion:
    return load_space("cmu/01_01-jump").motion


def test_the_browser_gets_joints_and_end_sites_of_each_motion(jump: Motion) -> None:
    """Positions are those of forward kinematics, motion by motion, to single precision."""
    still = replace(jump, rotations=np.broadcast_to(jump.rotations[:1], jump.rotations.shape))
    traits = motion_traits({"original": jump, "still": still})
    for motion, nodes in zip((jump, still), traits["positions"], strict=True):
        wanted = np.concatenate([joint_positions(motion), end_site_positions(motion)], axis=1)
        np.testing.assert_allclose(nodes, wanted, rtol=1e-5, atol=1e-4)
    assert traits["frame_time"] == jump.frame_time


def test_each_node_has_a_parent_before_it_and_a_side(jump: Motion) -> None:
    """End sites hang on their joints, and the feet are on different sides."""
    traits = motion_traits({"A": jump})
    n_nodes = traits["positions"].shape[2]
    assert len(traits["parents"]) == len(traits["sides"]) == n_nodes
    assert all(parent < node for node, parent in enumerate(traits["parents"]))
    names = jump.skeleton.names
    assert traits["sides"][names.index("LeftFoot")] == "left"
    assert traits["sides"][names.index("RightFoot")] == "right"
    assert traits["parents"][traits["head"]] == names.index("Head")


@pytest.mark.parametrize(
    ("change", "words"),
    [(lambda m: {}, "got none"), (lambda m: {"A": m, "B": m[:-1]}, "'B'.*play in step")],
    ids=["no motion", "another length"],
)
def test_what_cannot_play_in_step_is_refused(jump: Motion, change, words: str) -> None:
    """The message says which motion differs."""
    with pytest.raises(WorkbenchError, match=words):
        motion_traits(change(jump))


def test_a_player_takes_the_traits(jump: Motion) -> None:
    """The widget holds them as they are, and does not play by itself."""
    player = MotionPlayer(**motion_traits({"A": jump, "B": jump}), keyframes=[9, 0])
    assert player.motions == ["A", "B"]
    assert player.keyframes.tolist() == [0, 9]
    assert not player.autoplay
