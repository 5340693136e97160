"""Views project without perspective, and the best one shows what moves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench import load_space
from workbench.errors import WorkbenchError
from workbench.figures.views import View, best_view
from workbench.mocap.kinematics import joint_positions

JUMP = load_space("cmu/01_01-jump").motion


@pytest.mark.parametrize(
    ("view", "point", "seen", "near"),
    [
        (View(0, 0), [1, 2, 3], [1, 2], 3),
        (View(90, 0), [1, 2, 3], [-3, 2], 1),
        (View(180, 0), [1, 2, 3], [-1, 2], -3),
        (View(0, 90), [1, 2, 3], [1, -3], 2),
    ],
    ids=["front", "side", "back", "from above"],
)
def test_known_directions(view, point, seen, near):
    """The axes of the world go where the angles say."""
    assert np.allclose(view.project(point), seen)
    assert np.allclose(view.nearness(point), near)


def test_a_view_is_a_rotation():
    """Right, up and nearness are at right angles, so lengths in the picture are true."""
    axes = View(37.0, 21.0).axes
    assert np.allclose(axes @ axes.T, np.eye(3))
    assert np.isclose(np.linalg.det(axes), 1.0)


def test_the_best_view_shows_the_largest_spread():
    """No other azimuth shows more variance along the picture."""
    positions = joint_positions(JUMP).reshape(-1, 3)

    def spread(azimuth):
        return View(azimuth).project(positions)[:, 0].var()

    best = best_view(JUMP, elevation=0.0)
    assert best.elevation == 0.0
    assert spread(best.azimuth) >= max(spread(a) for a in range(0, 180, 2)) * (1 - 1e-9)


@pytest.mark.parametrize("turn", [0.0, 77.0, 180.0, 250.0])
def test_a_motion_that_travels_goes_to_the_right(turn):
    """Whichever way a jump goes over the ground, the picture reads from left to right."""
    angle = np.radians(turn)
    around = np.array(
        [[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]
    )
    rotations = JUMP.rotations.copy()
    rotations[:, 0] = around @ rotations[:, 0]
    root = JUMP.root_translation @ around.T
    turned = replace(JUMP, rotations=rotations, root_translation=root)
    path = best_view(turned).project(root)[:, 0]
    assert path[-1] - path[0] > 0.9 * np.linalg.norm((root[-1] - root[0])[[0, 2]])


def test_a_body_in_place_faces_the_viewer():
    """From the front, the left hand is on the right of the picture."""
    motion = replace(JUMP, root_translation=JUMP.root_translation * [0.0, 1.0, 0.0])[:2]
    arms = motion.rotations.copy()
    names = motion.skeleton.names
    positions = joint_positions(replace(motion, rotations=arms))
    hips = [names.index(name) for name in ("LeftUpLeg", "RightUpLeg")]
    left, right = best_view(motion).project(positions[:, hips])[0, :, 0]
    assert left > right


@pytest.mark.parametrize("angles", [(np.nan, 0), (0, 91)], ids=["nan", "over the top"])
def test_impossible_angles_are_refused(angles):
    """The message tells both angles."""
    with pytest.raises(WorkbenchError, match="view"):
        View(*angles)
