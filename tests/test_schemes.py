"""Tests of workbench.schemes, selection and interpolation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from sklearn.base import BaseEstimator, MultiOutputMixin, RegressorMixin
from sklearn.ensemble import RandomForestRegressor

from tests.conftest import find_clip
from workbench.backprojection import back_projectors
from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.interpolation.slerp import Slerp
from workbench.mocap.bvh import read_bvh
from workbench.optimization import optimizers
from workbench.optimization.gradient_descent import GradientDescent
from workbench.optimization.objective import OptimizationResult
from workbench.projection.pca import PCA
from workbench.quality.summary import embedding_quality
from workbench.schemes import SpatialScheme, TemporalScheme
from workbench.spaces import PoseSpace, VectorSpace


@pytest.fixture
def table():
    """Give 80 rows on a curved sheet in 5-D."""
    plane = np.random.default_rng(0).random((80, 2))
    waves = [np.sin(3 * plane[:, 0]), np.cos(2 * plane[:, 1]), plane.sum(axis=1)]
    return VectorSpace(np.column_stack([plane, *waves]), name="sheet")


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
    assert result.quality == embedding_quality(table.distances, result.embedding)
    assert result.projected_quality == embedding_quality(table.distances, result.projected)


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


class Nearest:
    """A user's own back-projector that knows nothing of scikit-learn."""

    def fit(self, points, samples):
        self.points, self.samples = np.asarray(points), np.asarray(samples)
        return self

    def predict(self, points):
        distances = np.linalg.norm(np.asarray(points)[:, None] - self.points, axis=2)
        return self.samples[distances.argmin(axis=1)]


class Stay:
    """A user's own optimizer that leaves everything where it is."""

    def optimize(self, objective, embedding, free, neighbors, callback=None):
        errors = objective(embedding[free], free)
        return OptimizationResult(embedding, errors, np.array([errors.mean()]), len(free), "done")


@pytest.mark.parametrize("kind", ["table", "motion"])
def test_users_own_methods_are_found_by_name(table, waving, monkeypatch, kind):
    """Plain classes registered in a cell work for tables and motions alike."""
    for registry in (back_projectors, optimizers):
        monkeypatch.setattr(registry, "_entries", dict(registry._entries))
    back_projectors.register("nearest", Nearest)
    optimizers.register("stay", Stay)
    space = table if kind == "table" else PoseSpace(waving)
    scheme = SpatialScheme("pca", back_projector="nearest", optimizer="stay")
    result = scheme.run(space, ratio=0.2, random_state=0)
    assert np.array_equal(result.embedding, result.projected)
    control = space.samples[result.control_points]
    matches = [
        np.isclose(control, sample).reshape(len(control), -1).all(1).any()
        for sample in result.reconstruction
    ]
    assert all(matches)


def test_the_seed_reaches_every_open_random_state(table, waving):
    """Forests as back-projectors of tables and motions give one result for one seed."""
    for space in (table, PoseSpace(waving)):
        forest = RandomForestRegressor(n_estimators=5)
        scheme = SpatialScheme("pca", back_projector=forest)
        first, again, other = (
            scheme.run(space, ratio=0.2, random_state=seed).errors[1:-1] for seed in (3, 3, 4)
        )
        assert np.array_equal(first, again)
        assert not np.array_equal(first, other)
        assert forest.random_state is None


@pytest.mark.parametrize("seed", [-1, 2**32])
def test_impossible_seeds_are_refused(table, seed):
    """A seed is a number of 32 bits."""
    with pytest.raises(WorkbenchError, match=f"random_state: got {seed}"):
        SpatialScheme("tsne").run(table, ratio=0.1, random_state=seed)


def test_tables_take_random_control_points_by_default_and_motions_uniform_ones(table, waving):
    """Iris is sorted by class; frames are sorted by time."""
    named = SpatialScheme("pca", selector="random").run(table, ratio=0.1, random_state=1)
    default = SpatialScheme("pca").run(table, ratio=0.1, random_state=1)
    assert np.array_equal(default.control_points, named.control_points)
    frames = SpatialScheme("pca").run(PoseSpace(waving), count=7).control_points
    assert (frames[0], frames[-1]) == (0, 59)
    assert np.ptp(np.diff(frames)) <= 1


class Broken(MultiOutputMixin, RegressorMixin, BaseEstimator):
    """A back-projector whose result is wrong in a given way."""

    def __init__(self, change=None):
        self.change = change

    def fit(self, X, y):
        self.n_outputs_ = np.shape(y)[1]
        return self

    def predict(self, X):
        return self.change(np.zeros((len(X), self.n_outputs_)))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda rows: rows[:-1], "reconstructions: got shape"),
        (lambda rows: rows[:, :-1], "reconstructions: got shape"),
        (lambda rows: rows * np.nan, "not finite|want finite"),
    ],
    ids=["too few rows", "too few columns", "nan"],
)
@pytest.mark.parametrize("optimizer", [None, "alg12"])
def test_wrong_reconstructions_are_refused(table, change, message, optimizer):
    """What a back-projector gives is checked before it is measured."""
    scheme = SpatialScheme("pca", back_projector=Broken(change), optimizer=optimizer)
    with pytest.raises((WorkbenchError, ValueError), match=message):
        _ = scheme.run(table, ratio=0.1).error


@pytest.mark.parametrize(
    ("scheme", "message"),
    [
        (SpatialScheme(PCA), "projector: got the class PCA, want an object such as PCA"),
        (SpatialScheme(5), "projector: got 5, want one of pca"),
        (SpatialScheme("pca", optimizer=True), "optimizer: got True, want one of alg12"),
        (SpatialScheme("pca", optimizer=GradientDescent), "got the class GradientDescent"),
        (SpatialScheme("pca", selector=3), "selector: got 3"),
        (SpatialScheme("pca", back_projector=object()), "or an object with fit and predict"),
    ],
    ids=["class", "number", "flag", "optimizer class", "selector", "object"],
)
def test_what_is_no_method_is_refused(table, scheme, message):
    """The message names the step and what it takes."""
    with pytest.raises(WorkbenchError, match=message):
        scheme.run(table, ratio=0.1)


@pytest.mark.parametrize("data", ["uci/iris", np.eye(4)], ids=["name", "array"])
def test_what_is_no_space_is_refused(data):
    """Names and arrays must be made spaces first; the message says how."""
    with pytest.raises(WorkbenchError, match=r"want a VectorSpace or a PoseSpace.*load_space"):
        SpatialScheme("pca").run(data, ratio=0.1)


def test_a_motion_that_stands_still_has_no_relative_error(waving):
    """Nothing is lost of nothing: the relative error is 0, not a division by zero."""
    still = replace(waving, rotations=np.repeat(waving.rotations[:1], 60, axis=0))
    assert TemporalScheme(Slerp()).run(PoseSpace(still), count=4).relative_error == 0.0


def test_bundled_jump_keeps_its_values():
    """On data that every installation has, the readings of the thesis give these errors."""
    space = load_space("cmu/01_01-jump")
    for name, error in (("slerp", 0.270), ("linear", 0.276)):
        assert TemporalScheme(name).run(space, ratio=0.03).error == pytest.approx(error, rel=0.01)
    for name, raw_error, error in (
        ("pca", 0.197, 0.174),
        ("isomap", 0.203, 0.171),
        ("lle", 0.309, 0.191),
    ):
        optimized = SpatialScheme(name, optimizer="alg12").run(space, ratio=0.03)
        raw = SpatialScheme(name).run(space, ratio=0.03, projected=optimized.projected)
        assert raw.error == pytest.approx(raw_error, rel=0.01)
        assert optimized.error == pytest.approx(error, rel=0.01)


def test_published_behaviour_on_05_10():
    """Slerp, PCA and t-SNE at 3 % of 05_10 give the errors measured for these readings."""
    space = PoseSpace(read_bvh(find_clip("05_10"))[1:])
    assert TemporalScheme("slerp").run(space, ratio=0.03).error == pytest.approx(0.410, rel=0.01)
    pca = SpatialScheme("pca", optimizer="alg12").run(space, ratio=0.03)
    raw = SpatialScheme("pca").run(space, ratio=0.03, projected=pca.projected)
    assert raw.error == pytest.approx(0.777, rel=0.03)
    assert pca.error == pytest.approx(0.435, rel=0.03)
    tsne = SpatialScheme("tsne", optimizer="alg12").run(space, ratio=0.03, random_state=0)
    assert tsne.error == pytest.approx(0.344, abs=0.02)
