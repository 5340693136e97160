"""Tests of workbench.projection.control_points and two_step."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.distance import pdist
from sklearn.manifold import trustworthiness

from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.projection import control_point_projectors, project, scale_to_unit_square
from workbench.projection.two_step import project_in_two_steps
from workbench.spaces import PoseSpace, VectorSpace

pytestmark = pytest.mark.filterwarnings("ignore::workbench.AdjustmentWarning")
every_placer = pytest.mark.parametrize("placer", control_point_projectors.names())
CONTROL = np.arange(0, 60, 4)


@pytest.fixture
def table():
    """Give 60 rows on a curved sheet in 5-D."""
    plane = np.random.default_rng(0).random((60, 2))
    waves = [np.sin(3 * plane[:, 0]), np.cos(2 * plane[:, 1]), plane.sum(axis=1)]
    return VectorSpace(np.column_stack([plane, *waves]), name="sheet")


@every_placer
@pytest.mark.parametrize(
    ("control_points", "positions", "message"),
    [
        ([0, 2, 1], np.zeros((3, 2)), "control points: got unsorted"),
        ([0, 1, 1], np.zeros((3, 2)), "control points: got unsorted or repeated"),
        ([0, 1, 60], np.zeros((3, 2)), "control points: got 0…60"),
        ([0, 1, 2], np.zeros((2, 2)), r"positions: got shape \(2, 2\), want \(3, 2\)"),
        ([0, 1, 2], np.zeros((3, 4)), r"positions: got shape \(3, 4\)"),
        ([0, 1], [[0, 0], [np.nan, 1]], r"positions: got nan at \[1, 0\]"),
    ],
    ids=["unsorted", "repeated", "outside", "too few", "four dimensions", "nan"],
)
def test_unusable_control_points_are_refused(table, placer, control_points, positions, message):
    """The message names the argument, its value and what is wanted."""
    with pytest.raises(WorkbenchError, match=message):
        control_point_projectors.create(placer).fit(table, control_points, positions)


@every_placer
def test_unusable_samples_are_refused(table, placer):
    """Neither before fitting nor of another shape nor with gaps."""
    projector = control_point_projectors.create(placer)
    with pytest.raises(WorkbenchError, match="call fit before transform"):
        projector.transform(table.samples)
    projector.fit(table, [0, 5, 9], [[0, 0], [1, 0], [0, 1]])
    with pytest.raises(WorkbenchError, match=r"samples: got shape \(60, 4\), want \(n_samples, 5"):
        projector.transform(table.samples[:, :4])
    with pytest.raises(WorkbenchError, match=r"samples: got nan at \[1, 0\]"):
        projector.transform([[0.0] * 5, [np.nan] * 5])
    with pytest.raises(WorkbenchError, match="space: got ndarray"):
        projector.fit(table.samples, [0, 5, 9], [[0, 0], [1, 0], [0, 1]])


@every_placer
@pytest.mark.parametrize("n_control_points", [1, 2, 3])
def test_few_control_points_are_enough(table, placer, n_control_points):
    """Even one gives every sample a finite place."""
    positions = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])[:n_control_points]
    projector = control_point_projectors.create(placer)
    placed = projector.fit(table, range(n_control_points), positions).transform(table.samples)
    assert np.isfinite(placed).all()
    assert np.allclose(placed[:n_control_points], positions)


@every_placer
def test_no_samples_have_no_places(table, placer):
    """An empty list of new samples is no error."""
    projector = control_point_projectors.create(placer)
    projector.fit(table, [0, 5, 9], [[0, 0], [1, 0], [0, 1]])
    assert projector.transform(np.empty((0, 5))).shape == (0, 2)


@every_placer
@pytest.mark.parametrize("kind", ["table", "motion"])
@pytest.mark.parametrize("dimensions", [2, 3])
def test_control_points_keep_their_seed_positions(table, waving, placer, kind, dimensions):
    """The map of all samples holds the seed map of the control points, to scale."""
    space = table if kind == "table" else PoseSpace(waving)
    embedding = project_in_two_steps(
        space, "mds", placer, CONTROL, seed_share=0, dimensions=dimensions
    )
    seeds = project(space.subset(CONTROL), "mds", dimensions=dimensions)
    assert embedding.shape == (60, dimensions)
    ratios = pdist(embedding[CONTROL]) / pdist(seeds)
    assert np.allclose(ratios, ratios[0], rtol=1e-6)
    assert embedding.min() == 0
    assert embedding.max() == 1


@every_placer
@pytest.mark.filterwarnings("error::workbench.AdjustmentWarning:workbench.projection.base")
def test_the_seed_projector_sees_its_share(table, placer):
    """A share of 0 shows it the control points alone, 1 all samples, 0.5 half of them."""
    seen = []

    class Recorder:
        def fit_transform(self, X):
            seen.append(X)
            return X[:, :2]

    for share in (0, 0.5, 1):
        project_in_two_steps(table, Recorder(), placer, CONTROL, seed_share=share, random_state=1)
    assert [len(X) for X in seen] == [15, 30, 60]
    assert np.array_equal(seen[0], table.samples[CONTROL])
    assert set(map(tuple, table.samples[CONTROL])) <= set(map(tuple, seen[1]))


def test_a_seed_gives_one_result(table):
    """The share is drawn from the seed and from nothing else."""
    runs = [
        project_in_two_steps(table, "pca", "rbfp", CONTROL, random_state=seed) for seed in (5, 5, 6)
    ]
    assert np.array_equal(runs[0], runs[1])
    assert not np.allclose(runs[0], runs[2])


@pytest.mark.parametrize("share", [-0.1, 1.1, float("nan")])
def test_impossible_shares_are_refused(table, share):
    """Less than nothing or more than all cannot be seen."""
    with pytest.raises(WorkbenchError, match=r"seed_share: got .*, want a number from 0 to 1"):
        project_in_two_steps(table, "pca", "rbfp", CONTROL, seed_share=share)


@every_placer
def test_iris_stays_in_order(placer):
    """A tenth of the flowers, placed by PCA, tells where the others belong."""
    iris = load_space("uci/iris")
    embedding = project_in_two_steps(iris, "pca", placer, np.arange(0, 150, 10), random_state=0)
    assert trustworthiness(iris.samples, embedding, n_neighbors=10) > 0.9


@every_placer
def test_seeds_that_are_the_samples_are_the_map(placer):
    """Samples of a plane, seeded by themselves, all come out where they are."""
    plane = np.random.default_rng(0).random((60, 2))

    class Itself:
        def fit_transform(self, X):
            return X

    embedding = project_in_two_steps(VectorSpace(plane), Itself(), placer, CONTROL)
    assert np.abs(embedding - scale_to_unit_square(plane)).max() < 0.05
