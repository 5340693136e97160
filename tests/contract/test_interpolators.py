"""What every registered interpolator keeps, beside tests/interpolation/test_properties.py."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.contract.strategies import examples, poses, still_poses
from workbench.interpolation import interpolators

every_interpolator = pytest.mark.parametrize("name", interpolators.names())


def draw_keys(draw: st.DataObject, n_frames: int) -> np.ndarray:
    frames = st.integers(0, n_frames - 1)
    return np.sort(draw.draw(st.lists(frames, min_size=2, max_size=n_frames, unique=True), "keys"))


@every_interpolator
@examples
@given(space=poses(), draw=st.data())
def test_frames_before_and_after_the_keyframes_hold_their_pose(name, space, draw):
    """Rotations everywhere, those of the outer keyframes beyond them; the motion stays."""
    keys = draw_keys(draw, len(space))
    before = space.samples.copy()
    rebuilt = interpolators.create(name).interpolate(space.motion, keys)
    assert rebuilt.shape == space.samples.shape
    assert np.abs(rebuilt @ np.swapaxes(rebuilt, -1, -2) - np.eye(3)).max() < 1e-9
    assert np.linalg.det(rebuilt).min() > 0
    # Near gimbal lock angles keep half of the digits.
    assert np.abs(rebuilt[keys] - space.samples[keys]).max() < 1e-7
    assert np.abs(rebuilt[: keys[0]] - space.samples[keys[0]]).max(initial=0.0) < 1e-7
    assert np.abs(rebuilt[keys[-1] :] - space.samples[keys[-1]]).max() < 1e-7
    assert np.array_equal(space.samples, before)
    assert np.array_equal(rebuilt, interpolators.create(name).interpolate(space.motion, keys))


@every_interpolator
@examples
@given(space=still_poses(), draw=st.data())
def test_a_still_motion_is_rebuilt_exactly(name, space, draw):
    """No error from any keyframes, to the digits that angles keep near gimbal lock."""
    rebuilt = interpolators.create(name).interpolate(space.motion, draw_keys(draw, len(space)))
    assert np.abs(rebuilt - space.samples).max() < 1e-7


@every_interpolator
@examples
@given(space=poses())
def test_all_frames_as_keyframes_lose_nothing(name, space):
    """Where nothing is left to rebuild, the motion comes back."""
    rebuilt = interpolators.create(name).interpolate(space.motion, np.arange(len(space)))
    assert np.abs(rebuilt - space.samples).max() < 1e-7
