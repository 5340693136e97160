"""Motions for tests of keyframe selectors."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import strategies as st

from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotations_from_euler
from workbench.mocap.skeleton import EndSite, Skeleton
from workbench.spaces import PoseSpace

_CHANNELS = ("Zrotation", "Yrotation", "Xrotation")

#: A root with two chains, as short as they come.
SKELETON = Skeleton(
    names=("root", "upper", "lower"),
    parents=np.array([-1, 0, 0]),
    offsets=np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0]], dtype=float),
    end_sites=(EndSite(1, np.array([0.0, 0.0, 3.0])), EndSite(2, np.array([0.0, 1.0, 0.0]))),
    channels=(_CHANNELS,) * 3,
)


def random_motion(n_frames: int, seed: int) -> PoseSpace:
    """Make a motion of random turns, each some way from the one before."""
    rng = np.random.default_rng(seed)
    angles = np.cumsum(rng.normal(0.0, 12.0, (n_frames, 3, 3)), axis=0)
    rotations = rotations_from_euler("ZYX", angles)
    return PoseSpace(Motion(SKELETON, rotations, np.zeros((n_frames, 3)), 1 / 30, name="random"))


def wave(n_frames: int) -> PoseSpace:
    """Make a motion of smooth turns, of several periods and some of them large."""
    t = np.linspace(0.0, 1.0, n_frames)[:, None, None]
    speeds = np.array([[1.0, 2.0, 0.5], [3.0, 1.5, 0.3], [5.0, 0.7, 2.5]])
    angles = 80.0 * np.sin(2 * np.pi * speeds * t + speeds)
    rotations = rotations_from_euler("ZYX", angles)
    return PoseSpace(Motion(SKELETON, rotations, np.zeros((n_frames, 3)), 1 / 30, name="wave"))


def still_motion(n_frames: int) -> PoseSpace:
    """Make a motion without any."""
    rotations = np.tile(np.eye(3), (n_frames, 3, 1, 1))
    return PoseSpace(Motion(SKELETON, rotations, np.zeros((n_frames, 3)), 1 / 30, name="still"))


@st.composite
def selections(draw: st.DrawFn, max_frames: int = 24) -> tuple[PoseSpace, int, list[int]]:
    """Draw a motion, a number of keyframes and frames that must be among them."""
    n_frames = draw(st.integers(4, max_frames))
    space = random_motion(n_frames, draw(st.integers(0, 2**32 - 1)))
    count = draw(st.integers(2, n_frames - 1))
    inner = st.lists(st.integers(1, n_frames - 2), unique=True, max_size=count - 2)
    return space, count, draw(inner)


@pytest.fixture
def wandering() -> PoseSpace:
    """Give a random motion of 40 frames."""
    return random_motion(40, 3)
