"""Tests of workbench.compact.reduction and workbench.compact.motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.mocap.strategies import skeletons
from workbench.backprojection.poses import PoseBackProjector, SpatialKeyframes
from workbench.backprojection.rbf import RBF
from workbench.compact import compact_bytes, compact_motion
from workbench.errors import DegenerateDataWarning, WorkbenchError
from workbench.interpolation import interpolators
from workbench.interpolation.rbf import RBFInTime
from workbench.mocap import Motion, read_bvh, rotations_from_channels, write_bvh
from workbench.mocap.rotations import geodesic_angles, rotations_from_vectors
from workbench.schemes import SpatialScheme, TemporalScheme
from workbench.spaces import PoseSpace, VectorSpace


def test_the_stated_error_is_that_of_the_expanded_motion(compacted):
    """Measured again on the expanded motion it is the same, and within the tolerance."""
    result, compact = compacted
    errors = result.space.errors(np.arange(len(result.space)), compact.expand().rotations)
    assert errors.mean() == pytest.approx(compact.error, rel=1e-12)
    assert compact.scheme_error == result.error
    slack = 1e-4 * result.space.weights.mean()
    assert compact.error <= result.error + max(0.01 * result.error, slack)


def test_the_stated_bounds_hold(compacted):
    """Path, positions and keys' rotations are off by no more than what the parts state."""
    result, compact = compacted
    motion, expanded = result.space.motion, compact.expand()
    moved = np.abs(expanded.root_translation - motion.root_translation).max()
    assert moved <= compact.path.bound + 1e-12
    assert compact.path.bound <= 1e-4 * motion.skeleton.path_weights.max()
    if compact.embedding is not None:
        off = np.abs(compact.embedding.values - result.embedding).max()
        assert off <= compact.embedding.bound
        keys = compact.keyframes
        angles = geodesic_angles(expanded.rotations[keys], motion.rotations[keys])
        assert angles.max() <= np.sqrt(3) * compact.keys.bound + 1e-14


def test_skeleton_and_timing_stay(compacted):
    """Names, bones, channels and frame time are those of the motion."""
    result, compact = compacted
    original, expanded = result.space.motion, compact.expand()
    assert expanded.skeleton is original.skeleton
    assert (expanded.frame_time, expanded.name) == (original.frame_time, original.name)


@pytest.fixture
def two_scales(waving):
    """Give a result on a map of which half lies within a millionth of the other half."""
    angle = np.linspace(0, 2 * np.pi, 60)
    plane = np.stack([np.cos(angle), np.sin(angle)], axis=1) + 1
    plane[30:] = plane[30] + 1e-6 * (plane[30:] - plane[30])
    return SpatialScheme("pca").run(PoseSpace(waving), count=12, projected=plane)


def test_maps_of_two_scales_get_the_bits_they_need(two_scales):
    """Where half of the markers nearly coincide twelve bits do not do, and more are taken."""
    compact = compact_motion(two_scales)
    assert compact.embedding.bound < 1e-8
    assert compact.error <= 1.01 * two_scales.error


def test_a_looser_tolerance_saves_bytes(two_scales):
    """What may add ten times the error takes fewer bits, and adds no more than that."""
    loose, tight = (compact_motion(two_scales, tolerance=share) for share in (10.0, 0.01))
    assert len(compact_bytes(loose)) < len(compact_bytes(tight))
    assert tight.error < loose.error <= 11 * two_scales.error


def test_markers_that_coincide_can_be_kept(waving):
    """Two keyframes at one place give their mean, as they did before rounding."""
    plane = np.stack([np.arange(60) % 30, np.arange(60) % 7], axis=1) / 30.0
    plane[[11, 38]] = 0.5
    with pytest.warns(DegenerateDataWarning, match="coincide"):
        result = SpatialScheme("pca").run(PoseSpace(waving), count=12, projected=plane)
    compact = compact_motion(result)
    assert compact.error <= 1.01 * result.error


@pytest.mark.parametrize(
    "model",
    [
        SpatialKeyframes("cubic"),
        SpatialKeyframes("gaussian", epsilon=np.float64(2.5)),
        SpatialKeyframes(smoothing=0.1),
        SpatialKeyframes("thin-plate", centers=np.int64(8)),
    ],
    ids=["cubic", "gaussian", "smoothing", "centers"],
)
def test_parameters_of_spatial_keyframes_are_kept(waving, model):
    """The expanded motion is the one that these parameters gave."""
    result = SpatialScheme("pca", back_projector=model).run(PoseSpace(waving), count=12)
    compact = compact_motion(result)
    assert compact.back_projector == model.get_params()
    slack = 1e-4 * result.space.weights.mean()
    assert compact.error <= result.error + max(0.01 * result.error, slack)
    compact_bytes(compact)


def test_another_interpolator_is_refused(waving):
    """A name, or parameters, that would rebuild another motion are found out."""
    space = PoseSpace(waving)
    linear = TemporalScheme("linear").run(space, count=12)
    with pytest.raises(WorkbenchError, match=r"result: interpolator 'slerp' would rebuild it"):
        compact_motion(linear, "slerp")
    cubic = TemporalScheme(RBFInTime("cubic")).run(space, count=12)
    with pytest.raises(WorkbenchError, match=r"interpolator 'rbf' would rebuild it"):
        compact_motion(cubic, "rbf")


def test_an_interpolator_of_ones_own_must_say_what_it_keeps(waving, monkeypatch):
    """Without encode and decode there is nothing to write."""

    class Still:
        def interpolate(self, motion, _):
            return motion.rotations

    monkeypatch.setitem(interpolators._entries, "still", Still)
    result = TemporalScheme("still").run(PoseSpace(waving), count=12)
    with pytest.raises(WorkbenchError, match="interpolator 'still': has no encode and decode"):
        compact_motion(result, "still")


def test_what_has_no_compact_form_is_refused(waving):
    """Tables, results of other back-projectors, and negative tolerances."""
    table = VectorSpace(np.random.default_rng(0).random((20, 3)))
    with pytest.raises(WorkbenchError, match="that of a table"):
        compact_motion(SpatialScheme("pca").run(table, count=5))
    other = SpatialScheme("pca", back_projector=PoseBackProjector(RBF()))
    with pytest.raises(WorkbenchError, match="want a temporal scheme's"):
        compact_motion(other.run(PoseSpace(waving), count=5))
    with pytest.raises(WorkbenchError, match="tolerance: got -1"):
        compact_motion(TemporalScheme().run(PoseSpace(waving), count=5), "slerp", tolerance=-1)


def test_a_known_scale_sets_the_step_of_the_path(waving):
    """With 2 cm to the unit, the root is off by at most half of a hundredth of a centimetre."""
    skeleton = replace(waving.skeleton, unit_cm=2.0)
    space = PoseSpace(replace(waving, skeleton=skeleton))
    compact = compact_motion(TemporalScheme().run(space, count=12), "slerp")
    assert 0.0025 / 2 < compact.path.bound * 2.0 <= 0.005


def test_moved_joints_are_kept(waving):
    """A joint that the motion moves as well as turns is where it was, to the path's bound."""
    moved = np.random.default_rng(0).normal(size=(60, 3))
    channels = list(waving.skeleton.channels)
    channels[2] = channels[0]
    motion = replace(
        waving,
        skeleton=replace(waving.skeleton, channels=tuple(channels)),
        joint_translations={2: moved},
    )
    compact = compact_motion(TemporalScheme().run(PoseSpace(motion), count=12), "slerp")
    found = compact.expand().joint_translations
    assert list(found) == [2]
    assert np.abs(found[2] - moved).max() <= compact.path.bound + 1e-12


def test_joints_with_two_axes_can_be_written(waving, tmp_path):
    """Halfway between two such poses a third axis is needed, so the joint gets one."""
    channels = list(waving.skeleton.channels)
    channels[1] = ("Zrotation", "Xrotation")
    motion = replace(waving, skeleton=replace(waving.skeleton, channels=tuple(channels)))
    compact = compact_motion(TemporalScheme().run(PoseSpace(motion), count=12), "slerp")
    expanded = compact.expand()
    assert expanded.skeleton.channels[1] == ("Zrotation", "Xrotation", "Yrotation")
    write_bvh(expanded, tmp_path / "clip.bvh")
    written = read_bvh(tmp_path / "clip.bvh").rotations
    assert geodesic_angles(written, expanded.rotations).max() < 1e-9


@settings(max_examples=25, deadline=None)
@given(skeletons(), st.integers(0, 2**32 - 1), st.sampled_from(["slerp", "linear", "pca"]))
def test_any_motion_can_be_compacted(skeleton, seed, method):
    """On random skeletons and motions the bounds hold and the stated error is the true one."""
    assume(skeleton.path_weights.any())
    rng = np.random.default_rng(seed)
    n_channels = sum(len(skeleton.rotation_order(j)) for j in range(skeleton.n_joints))
    degrees = np.cumsum(rng.uniform(-30, 30, (12, n_channels)), axis=0)
    path = skeleton.offsets[0] + rng.normal(0, 50, (12, 3))
    motion = Motion(skeleton, rotations_from_channels(skeleton, degrees), path, 0.1)
    space = PoseSpace(motion)
    assume(np.ptp(space.features, axis=0).any())
    if method == "pca":
        result = SpatialScheme("pca").run(space, count=5)
        compact = compact_motion(result)
        poses = rotations_from_vectors(compact.keys.values.reshape(5, -1, 3))
        angles = geodesic_angles(poses, space.samples[compact.keyframes])
        assert angles.max() <= np.sqrt(3) * compact.keys.bound + 1e-14
    else:
        result = TemporalScheme(method).run(space, count=5)
        compact = compact_motion(result, method)
    expanded = compact.expand()
    assert np.abs(expanded.root_translation - path).max() <= compact.path.bound + 1e-9
    errors = space.errors(np.arange(12), expanded.rotations)
    assert errors.mean() == pytest.approx(compact.error, rel=1e-9, abs=1e-12)
