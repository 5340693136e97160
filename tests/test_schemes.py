"""Tests of workbench.schemes, selection and interpolation."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from tests.conftest import find_clip
from workbench.errors import WorkbenchError
from workbench.interpolation import interpolators
from workbench.mocap.bvh import read_bvh
from workbench.schemes import SpatialScheme, TemporalScheme, choose_control_points
from workbench.spaces import PoseSpace, VectorSpace


@pytest.fixture
def table():
    """Give 80 rows on a curved sheet in 5-D."""
    plane = np.random.default_rng(0).random((80, 2))
    waves = [np.sin(3 * plane[:, 0]), np.cos(2 * plane[:, 1]), plane.sum(axis=1)]
    return VectorSpace(np.column_stack([plane, *waves]), name="sheet")


def test_uniform_selection_includes_both_ends(waving):
    """Keyframes are evenly spaced to within one frame."""
    keys = choose_control_points(PoseSpace(waving), "uniform", count=7)
    assert (keys[0], keys[-1], len(keys)) == (0, 59, 7)
    assert np.ptp(np.diff(keys)) <= 1


def test_random_selection_depends_on_the_seed_only(table):
    """One seed, one sample; another seed, another sample."""
    first, again, other = (
        choose_control_points(table, "random", ratio=0.2, random_state=seed).tolist()
        for seed in (1, 1, 2)
    )
    assert first == again != other
    assert len(set(first)) == 16


@pytest.mark.parametrize("name", interpolators.names())
def test_interpolators_keep_the_keyframes(waving, name):
    """Rotations at the keyframes are those of the clip."""
    keys = np.array([0, 7, 20, 59])
    rebuilt = interpolators.create(name).interpolate(waving, keys)
    assert np.abs(rebuilt[keys] - waving.rotations[keys]).max() < 1e-12


@pytest.mark.parametrize("name", interpolators.names())
def test_interpolators_rebuild_a_steady_turn(arm, name):
    """A joint that turns about one axis at constant speed is rebuilt from two keyframes."""
    from workbench.mocap.motion import Motion
    from workbench.mocap.rotations import rotations_from_euler

    angles = np.zeros((11, 4, 3))
    angles[:, 1, 0] = np.linspace(-80, 80, 11)
    motion = Motion(arm, rotations_from_euler("ZYX", angles), np.zeros((11, 3)), 0.1)
    rebuilt = interpolators.create(name).interpolate(motion, np.array([0, 10]))
    assert np.abs(rebuilt - motion.rotations).max() < 1e-12


def test_slerp_agrees_with_scipy(waving):
    """Every joint follows scipy's spherical interpolation of the keyframes."""
    keys = np.array([0, 13, 30, 59])
    rebuilt = interpolators.create("slerp").interpolate(waving, keys)
    for joint in range(4):
        rotations = Rotation.from_matrix(waving.rotations[keys, joint])
        expected = Slerp(keys, rotations)(np.arange(60)).as_matrix()
        assert np.abs(rebuilt[:, joint] - expected).max() < 1e-12


def test_frames_outside_the_keyframes_hold_their_pose(waving):
    """Before the first and after the last keyframe nothing moves."""
    rebuilt = interpolators.create("slerp").interpolate(waving, np.array([10, 30]))
    assert np.allclose(rebuilt[:10], waving.rotations[10])
    assert np.allclose(rebuilt[31:], waving.rotations[30])


def test_temporal_errors_are_zero_at_keyframes_and_fall_with_more(waving):
    """More keyframes, less error; none at the keyframes."""
    space = PoseSpace(waving)
    few, many = (TemporalScheme().run(space, count=n) for n in (4, 20))
    assert np.all(few.errors[few.control_points] == 0)
    assert 0 < many.error < 0.3 * few.error
    assert few.error == pytest.approx(few.errors.sum() / 60)


def test_tables_have_no_time(table):
    """A temporal scheme refuses a table by name."""
    with pytest.raises(WorkbenchError, match="got the table 'sheet', want a motion"):
        TemporalScheme().run(table, count=5)


@pytest.mark.parametrize("kind", ["table", "motion"])
def test_the_optimizer_improves_both_kinds_of_space(table, waving, kind):
    """Optimized error is below the raw one, for vectors and for poses alike."""
    space = table if kind == "table" else PoseSpace(waving)
    raw = SpatialScheme("pca").run(space, ratio=0.15, random_state=0)
    better = SpatialScheme("pca", optimizer="alg12").run(space, ratio=0.15, random_state=0)
    assert better.error < 0.9 * raw.error
    assert np.array_equal(raw.projected, better.projected)
    assert raw.embedding is raw.projected
    control = better.control_points
    assert np.array_equal(better.embedding[control], better.projected[control])
    assert np.all(better.errors[control] == 0)


def test_the_result_is_what_it_says(table):
    """Errors, quality and evaluations follow from the result's own parts."""
    result = SpatialScheme("mds", optimizer="alg12").run(table, ratio=0.1, random_state=3)
    free = np.setdiff1d(np.arange(80), result.control_points)
    rebuilt = result.back_projector.predict(result.embedding[free])
    assert np.allclose(result.reconstruction[free], rebuilt)
    assert result.evaluations == result.optimization.evaluations + len(free)
    assert result.relative_error == pytest.approx(result.error / table.mean_prediction_error())
    assert list(result.timings.steps) == ["select", "project", "fit", "optimize", "back-project"]
    assert result.quality.stress != result.projected_quality.stress


def test_a_given_projection_is_used(table):
    """Schemes that share a projection need not compute it twice."""
    projected = np.random.default_rng(1).random((80, 2))
    result = SpatialScheme("pca").run(table, ratio=0.1, projected=projected)
    assert np.array_equal(result.projected, projected)
    assert "project" not in result.timings.steps


def test_same_seed_same_result(table):
    """All randomness comes from the seed."""
    scheme = SpatialScheme("tsne", optimizer="alg12")
    first, second = (scheme.run(table, ratio=0.1, random_state=5) for _ in range(2))
    assert np.array_equal(first.embedding, second.embedding)
    assert first.error == second.error


def test_published_behaviour_on_05_10():
    """Slerp, PCA and t-SNE at 3 % of 05_10 give the errors measured for these readings."""
    space = PoseSpace(read_bvh(find_clip("05_10"))[1:])
    assert TemporalScheme("slerp").run(space, ratio=0.03).error == pytest.approx(0.410, rel=0.01)
    pca = SpatialScheme("pca", optimizer="alg12").run(space, ratio=0.03)
    raw = SpatialScheme("pca").run(space, ratio=0.03, projected=pca.projected)
    assert raw.error == pytest.approx(0.777, rel=0.03)
    assert pca.error == pytest.approx(0.435, rel=0.03)
    for seed in range(3):
        tsne = SpatialScheme("tsne", optimizer="alg12").run(space, ratio=0.03, random_state=seed)
        assert tsne.error == pytest.approx(0.344, abs=0.02)
