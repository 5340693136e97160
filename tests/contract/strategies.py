"""Random spaces for tests of all methods."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

from tests.mocap.strategies import motions
from workbench.mocap import Motion
from workbench.spaces import PoseSpace, Space, VectorSpace

#: Few examples each: the methods are many, and compiled kernels take long to load.
examples = settings(max_examples=8, deadline=None, suppress_health_check=list(HealthCheck))

seeds = st.integers(0, 2**32 - 1)


@st.composite
def tables(draw: st.DrawFn, min_rows: int = 3, max_rows: int = 16) -> VectorSpace:
    """Draw a table whose rows may repeat, and one of whose columns may be constant."""
    n = draw(st.integers(min_rows, max_rows))
    values = np.random.default_rng(draw(seeds)).normal(size=(n, draw(st.integers(1, 5))))
    values *= 10.0 ** draw(st.integers(-2, 3))
    if draw(st.booleans()):
        values[n // 2 :] = values[: n - n // 2]
    if draw(st.booleans()):
        values[:, -1] = values[0, -1]
    values[-1, 0] = values[:, 0].max() + 1.0
    return VectorSpace(values, name="random table")


@st.composite
def poses(draw: st.DrawFn, min_frames: int = 3, max_frames: int = 12) -> PoseSpace:
    """Draw a motion in which something moves, of a skeleton that has bones."""
    motion = draw(motions(min_frames, max_frames).filter(_moves_bones))
    return PoseSpace(replace(motion, name="random motion"))


def _moves_bones(motion: Motion) -> bool:
    weighted = motion.skeleton.path_weights > 0
    return bool(np.ptp(motion.rotations[:, weighted], axis=0).any())


@st.composite
def still_poses(draw: st.DrawFn) -> PoseSpace:
    """Draw a motion whose frames are all equal."""
    motion = draw(poses()).motion
    held = np.repeat(motion.rotations[:1], len(motion), axis=0)
    still = {j: np.repeat(t[:1], len(t), axis=0) for j, t in motion.joint_translations.items()}
    path = np.repeat(motion.root_translation[:1], len(motion), axis=0)
    return PoseSpace(
        replace(motion, rotations=held, root_translation=path, joint_translations=still)
    )


def spaces() -> st.SearchStrategy[Space]:
    """Draw a table or a motion."""
    return st.one_of(tables(), poses())
