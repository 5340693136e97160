"""Tests of the searches on starts that leave them little to go by."""

from __future__ import annotations

import numpy as np
import pytest

from tests.optimization.problems import Problem, flat, sheet
from workbench.backprojection.rbf import RBF
from workbench.optimization import global_search
from workbench.optimization.global_search import GlobalSearch
from workbench.optimization.gradient_descent import GradientDescent
from workbench.optimization.local_search import LocalSearch
from workbench.spaces import VectorSpace

SEARCHES = pytest.mark.parametrize("search", [LocalSearch, GlobalSearch], ids=["local", "global"])
DERIVATIVES = pytest.mark.parametrize("derivatives", [True, False], ids=["newton", "probing"])


@SEARCHES
@DERIVATIVES
def test_free_points_in_one_place_come_apart(search, derivatives):
    """Without any distance to neighbours, the extent of the embedding sets the first step."""
    problem, places = flat()
    problem.start[10:] = places[10:].mean(axis=0)
    nowhere = np.tile([[10, 11]], (40, 1))
    result = search(tolerance=1e-6).optimize(
        problem.objective() if derivatives else problem.objective_without_derivatives(),
        problem.start,
        problem.free,
        nowhere,
    )
    assert np.abs(result.embedding - places).max() < (1e-6 if derivatives else 1e-2)


@SEARCHES
@DERIVATIVES
@pytest.mark.filterwarnings("ignore::workbench.errors.DegenerateDataWarning")
def test_an_embedding_in_one_place_is_left_there(search, derivatives):
    """Where the back-projection is the same everywhere, the search ends without a gain."""
    samples = np.random.default_rng(0).random((12, 4))
    start = np.zeros((12, 2))
    problem = Problem(
        VectorSpace(samples), start, np.arange(4, 12), RBF().fit(start[:4], samples[:4])
    )
    result = problem.run(search(), derivatives=derivatives)
    assert np.allclose(result.errors, problem.errors(start))


@SEARCHES
@DERIVATIVES
def test_one_free_point_finds_its_place(search, derivatives):
    """It lies on a control point that is both its neighbours, so it has no radius at all."""
    problem, places = flat()
    problem.start, problem.free = places.copy(), np.array([25])
    problem.start[25] = places[3]
    objective = problem.objective() if derivatives else problem.objective_without_derivatives()
    result = search(tolerance=1e-6).optimize(
        objective, problem.start, problem.free, np.full((40, 2), 3)
    )
    assert np.abs(result.embedding - places).max() < (1e-6 if derivatives else 1e-2)


@SEARCHES
@DERIVATIVES
@pytest.mark.parametrize("n_control", [0, 1, 2], ids=["none", "one", "two"])
def test_few_fixed_points_are_enough(search, derivatives, n_control):
    """A back-projector may come from elsewhere; then every sample may be free."""
    problem = sheet(noise=0.2)
    problem.free = np.arange(n_control, 60)
    before = problem.errors(problem.start)
    result = problem.run(search(), derivatives=derivatives)
    assert np.all(result.errors <= before)
    assert result.errors.sum() < 0.8 * before.sum()


@SEARCHES
@DERIVATIVES
def test_clusters_far_smaller_than_the_map_are_searched(search, derivatives):
    """As LLE makes them: 1e-8 wide, 1 apart; errors fall and none rises."""
    problem = sheet()
    clusters = (np.arange(60) % 3)[:, None] * [1.0, 0.5] + 1e-8 * problem.start
    control = np.arange(20)
    problem.start = clusters
    problem.back_projector = RBF().fit(clusters[control], problem.space.samples[control])
    before = problem.objective()(clusters[problem.free], problem.free)
    result = problem.run(search(), derivatives=derivatives)
    # Where 1e-8 makes all the difference, rounding makes some.
    assert np.all(result.errors <= before + 1e-6)
    assert result.history[-1] < 0.95 * result.history[0]
    assert np.all(np.diff(result.history) <= 0)


def test_few_samples_have_a_scout_too():
    """Of less than 9 samples one measures all coarse points, so a poor basin can be left."""
    problem = sheet()
    objective = problem.objective()
    GlobalSearch().optimize(objective, problem.start, [30], problem.space.neighbors)
    assert objective.effort.distances > 196


def test_the_table_of_scouts_is_made_in_parts(monkeypatch):
    """However little memory it may take, the result is the same."""
    problem = sheet(noise=0.5)
    expected = problem.run(GlobalSearch(scouts=2))
    monkeypatch.setattr(global_search, "_TABLE", 1)
    result = problem.run(GlobalSearch(scouts=2))
    assert result.effort == expected.effort
    assert np.allclose(result.errors, expected.errors)


@pytest.mark.parametrize("optimizer", [LocalSearch, GlobalSearch, GradientDescent])
def test_an_exception_in_the_callback_gets_through(optimizer):
    """It is the caller's; the start that was given stays as it was."""
    problem = sheet()
    before = problem.start.copy()

    def fail(*_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        problem.run(optimizer(), fail)
    assert np.array_equal(problem.start, before)


def test_the_reason_tells_of_the_limit():
    """A global search that was cut short among its rounds says so."""
    problem = sheet(noise=0.5)
    assert problem.run(GlobalSearch()).reason == "no sample found a better place"
    cut = problem.run(GlobalSearch(max_iterations=1))
    assert cut.reason == "reached 1 rounds among neighbours"
