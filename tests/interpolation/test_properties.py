"""Properties of all interpolators on random skeletons and motions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.mocap.strategies import motions
from workbench.interpolation import interpolators
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotations_from_vectors

every_interpolator = pytest.mark.parametrize("name", interpolators.names())
examples = settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.too_slow])


@st.composite
def keyed_motions(draw: st.DrawFn) -> tuple[Motion, np.ndarray]:
    """Draw a motion of at least two frames and two or more of its frames."""
    motion = draw(motions().filter(lambda motion: len(motion) >= 2))
    frames = st.integers(0, len(motion) - 1)
    keys = draw(st.lists(frames, min_size=2, max_size=len(motion), unique=True))
    return motion, np.sort(keys)


@every_interpolator
@examples
@given(keyed_motions())
def test_results_are_rotations_through_the_keyframes(name, drawn):
    """Orthogonal matrices of determinant 1, those of the clip at its keyframes."""
    motion, keys = drawn
    rebuilt = interpolators.create(name).interpolate(motion, keys)
    assert rebuilt.shape == motion.rotations.shape
    assert np.abs(rebuilt @ np.swapaxes(rebuilt, -1, -2) - np.eye(3)).max() < 1e-9
    assert np.abs(np.linalg.det(rebuilt) - 1).max() < 1e-9
    # Near gimbal lock angles keep half of the digits.
    assert np.abs(rebuilt[keys] - motion.rotations[keys]).max() < 1e-7


@every_interpolator
@examples
@given(keyed_motions())
def test_a_pose_that_is_held_stays(name, drawn):
    """Where all frames are equal, so are the rebuilt ones."""
    motion, keys = drawn
    still = replace(motion, rotations=np.repeat(motion.rotations[:1], len(motion), axis=0))
    rebuilt = interpolators.create(name).interpolate(still, keys)
    assert np.abs(rebuilt - still.rotations).max() < 1e-7


@every_interpolator
@examples
@given(keyed_motions())
def test_a_motion_backwards_is_rebuilt_backwards(name, drawn):
    """Time has no direction, as long as angles are unwrapped the same way from both ends."""
    motion, keys = drawn
    # Angles small enough to need no unwrapping, which starts from the first frame.
    calm = replace(motion, rotations=_calmed(motion.rotations))
    back = replace(calm, rotations=calm.rotations[::-1])
    forth = interpolators.create(name).interpolate(_free_joints(calm), keys)
    mirrored = np.sort(len(motion) - 1 - keys)
    rebuilt = interpolators.create(name).interpolate(_free_joints(back), mirrored)
    assert np.abs(rebuilt[::-1] - forth).max() < 1e-9


@pytest.mark.parametrize("name", ["slerp", "rbf"])
@examples
@given(keyed_motions(), st.tuples(*[st.floats(-3, 3)] * 3))
def test_methods_on_rotations_do_not_depend_on_the_axes(name, drawn, turn):
    """Turning every pose turns what is rebuilt between them."""
    motion, keys = drawn
    motion = _free_joints(replace(motion, rotations=_calmed(motion.rotations)))
    frame = rotations_from_vectors(np.array(turn))
    interpolator = interpolators.create(name)
    turned = replace(motion, rotations=frame @ motion.rotations)
    expected = frame @ interpolator.interpolate(motion, keys)
    assert np.abs(interpolator.interpolate(turned, keys) - expected).max() < 1e-7


def _calmed(rotations: np.ndarray) -> np.ndarray:
    """Give rotations of at most half a radian, one for each."""
    seeds = rotations[..., 0, :]
    return rotations_from_vectors(0.5 * seeds / np.linalg.norm(seeds, axis=-1, keepdims=True))


def _free_joints(motion: Motion) -> Motion:
    """Give every joint three channels, so that it can have any rotation."""
    channels = (("Zrotation", "Xrotation", "Yrotation"),) * motion.skeleton.n_joints
    skeleton = replace(motion.skeleton, channels=channels)
    return replace(motion, skeleton=skeleton, joint_translations={})
