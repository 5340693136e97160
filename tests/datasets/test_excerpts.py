"""Excerpts: each holds the motion that its name says."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from workbench.datasets import load, load_space
from workbench.datasets.clips import EXCERPTS
from workbench.errors import DataError
from workbench.mocap import joint_positions
from workbench.mocap.motion import Motion
from workbench.resources import bundled

FEET = ("LeftFoot", "RightFoot")
HANDS = ("LeftHand", "RightHand")


@pytest.fixture(autouse=True)
def _bundled_only(cache: Path) -> None:
    """Use the bundled clips, whatever folders the machine has."""


def excerpt(name: str) -> Motion:
    motion = load(f"cmu/{name}")
    assert isinstance(motion, Motion)
    return motion


def heights(motion: Motion, joints: tuple[str, ...]) -> NDArray[np.float64]:
    """Heights of joints over the lowest point of the clip: (n_frames, n_joints)."""
    index = [motion.skeleton.names.index(joint) for joint in joints]
    positions = joint_positions(motion)
    return positions[:, index, 1] - positions[..., 1].min()


def jumps(motion: Motion) -> int:
    """Count the times that both feet are high over the ground with the hips thrown up."""
    airborne = heights(motion, FEET).min(axis=1) > 3.0
    return int((np.diff(airborne.astype(int)) == 1).sum())


def heading(motion: Motion) -> NDArray[np.float64]:
    """Direction of the hips about the vertical, in degrees: (n_frames,)."""
    root = motion.rotations[:, 0]
    return np.degrees(np.unwrap(np.arctan2(root[:, 0, 2], root[:, 2, 2])))


@pytest.mark.parametrize("name", [row[0] for row in EXCERPTS])
def test_excerpts_are_short_and_named(name: str) -> None:
    """Each is 300 to 1100 frames long, lies within its clip and carries its name."""
    motion = excerpt(name)
    assert 300 <= len(motion) <= 1100
    assert motion.name == f"cmu/{name}"
    start, stop = next(row[1:3] for row in EXCERPTS if row[0] == name)
    assert len(motion) == stop - start
    whole = excerpt(name.partition("-")[0])
    np.testing.assert_array_equal(motion.rotations, whole.rotations[start:stop])


def test_there_are_enough_of_them() -> None:
    """At least six, with different names."""
    assert len({row[0] for row in EXCERPTS}) >= 6


@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("01_01-jump", 1),
        ("01_01-two-jumps", 2),
        ("01_01-three-jumps", 3),
        ("01_01-turn", 0),
        ("01_03-walk", 0),
    ],
)
def test_jumps_are_whole(name: str, count: int) -> None:
    """The excerpts hold as many jumps as they say, and begin and end on the ground."""
    motion = excerpt(name)
    assert jumps(motion) == count
    assert heights(motion, FEET)[[0, -1]].min(axis=1).max() < 1.5


def test_turn_turns() -> None:
    """The turn turns by half a circle; the jumps keep their direction."""
    turned = heading(excerpt("01_01-turn"))
    assert abs(turned[-1] - turned[0]) == pytest.approx(180, abs=10)
    straight = heading(excerpt("01_01-three-jumps"))
    assert np.ptp(straight) < 25


def test_walk_walks() -> None:
    """The walk covers ground with one foot down at any time."""
    motion = excerpt("01_03-walk")
    assert np.linalg.norm(np.diff(motion.root_translation[[0, -1]][:, [0, 2]], axis=0)) > 25
    assert heights(motion, FEET).min(axis=1).max() < 2.0


@pytest.mark.parametrize(("name", "direction"), [("01_03-climb-up", 1), ("01_03-climb-down", -1)])
def test_climbs_change_height(name: str, direction: int) -> None:
    """Hips and both feet end more than 10 units (56 cm) higher, or lower."""
    motion = excerpt(name)
    rise = heights(motion, ("Hips", *FEET))
    assert (direction * (rise[-1] - rise[0]) > 10).all()


def tilt(motion: Motion) -> NDArray[np.float64]:
    """Angle between the trunk and the vertical, in degrees: (n_frames,)."""
    names = motion.skeleton.names
    positions = joint_positions(motion)
    trunk = positions[:, names.index("Neck")] - positions[:, names.index("Hips")]
    return np.degrees(np.arccos(trunk[:, 1] / np.linalg.norm(trunk, axis=1)))


def test_lean_stays_up() -> None:
    """The lean keeps the trunk bent forward, with the feet up on the equipment."""
    motion = excerpt("01_03-lean-over")
    names = motion.skeleton.names
    feet = joint_positions(motion)[:, [names.index(foot) for foot in FEET], 1]
    assert feet.min() > 10
    assert tilt(motion).min() > 40
    assert tilt(motion).max() > 70
    assert tilt(excerpt("01_03-walk")).max() < 30


@pytest.mark.parametrize("name", ["01_03-hang", "01_03-swing"])
def test_hanging_hangs(name: str) -> None:
    """Both hands stay above the head while both feet are off the ground."""
    motion = excerpt(name)
    head = heights(motion, ("Head",))
    hands = heights(motion, HANDS)
    feet = heights(motion, FEET)
    hanging = (hands > head).all(axis=1) & (feet > 1.5).all(axis=1)
    assert hanging.sum() > 100


def test_swing_is_wider_than_hang() -> None:
    """The swing raises the feet twice as high as the hang."""
    hang, swing = (heights(excerpt(f"01_03-{name}"), FEET).max() for name in ("hang", "swing"))
    assert swing > 1.7 * hang


def test_excerpts_are_spaces_of_poses() -> None:
    """An excerpt is ready to be projected."""
    space = load_space("cmu/01_01-jump")
    assert len(space) == 300
    assert space.name == "cmu/01_01-jump"


def test_excerpts_of_one_clip_are_independent() -> None:
    """Changing an excerpt changes neither itself when it is loaded again, nor another one."""
    first, start = excerpt("01_01-jump"), excerpt("01_01").rotations
    kept = first.rotations.copy()
    first.rotations[:] = 0.0
    np.testing.assert_array_equal(excerpt("01_01-jump").rotations, kept)
    turn = next(row for row in EXCERPTS if row[0] == "01_01-turn")
    np.testing.assert_array_equal(excerpt("01_01-turn").rotations, start[turn[1] : turn[2]])


def test_a_clip_that_changes_is_read_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A clip that is damaged after an excerpt was loaded is noticed with the next."""
    folder = tmp_path / "mocap" / "bvh"
    folder.mkdir(parents=True)
    source = next(bundled("datasets").rglob("01_01.bvh"))
    (folder / source.name).write_bytes(source.read_bytes())
    monkeypatch.setenv("WORKBENCH_DATA", str(tmp_path))
    assert len(excerpt("01_01-jump")) == 300
    (folder / source.name).write_bytes(source.read_bytes().replace(b"Frame Time: ", b"Time: "))
    with pytest.raises(DataError, match="Frame Time"):
        excerpt("01_01-turn")
