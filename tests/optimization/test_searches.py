"""Tests of the local and the global search."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear
from sklearn.neighbors import KNeighborsRegressor

import workbench
from tests.conftest import find_clip
from tests.optimization.problems import Problem, flat, sheet
from workbench.backprojection.rbf import RBF
from workbench.errors import WorkbenchError
from workbench.optimization.global_search import GlobalSearch
from workbench.optimization.gradient_descent import GradientDescent
from workbench.optimization.local_search import LocalSearch
from workbench.schemes import SpatialScheme
from workbench.spaces import VectorSpace

SEARCHES = pytest.mark.parametrize("search", [LocalSearch, GlobalSearch], ids=["local", "global"])
DERIVATIVES = pytest.mark.parametrize("derivatives", [True, False], ids=["newton", "probing"])


@SEARCHES
@DERIVATIVES
@given(seed=st.integers(0, 10_000), dimensions=st.sampled_from([2, 3]), noise=st.floats(0.0, 1.0))
@settings(max_examples=15, deadline=None)
def test_no_sample_gets_worse(search, derivatives, seed, dimensions, noise):
    """Whatever the start, no sample's error rises, control points stay, errors are true."""
    problem = sheet(seed, dimensions, noise, n=24, n_control=9)
    before = problem.errors(problem.start)
    result = problem.run(search(), derivatives=derivatives)
    assert np.all(result.errors <= before)
    assert np.array_equal(result.embedding[:9], problem.start[:9])
    assert np.allclose(problem.errors(result.embedding), result.errors, rtol=0, atol=1e-12)
    assert np.all(np.diff(result.history) <= 0)
    assert result.history[-1] == pytest.approx(result.errors.mean())


@SEARCHES
@DERIVATIVES
@pytest.mark.parametrize("dimensions", [2, 3])
def test_samples_of_a_plane_find_their_place(search, derivatives, dimensions):
    """Where an exact place exists, it is found."""
    problem, places = flat(dimensions=dimensions)
    result = problem.run(search(tolerance=1e-6), derivatives=derivatives)
    assert np.abs(result.embedding - places).max() < (1e-6 if derivatives else 5e-3)


@SEARCHES
@DERIVATIVES
def test_bounds_are_kept(search, derivatives):
    """No sample leaves the box, though its best place lies outside."""
    problem, places = flat(seed=3)
    low, high = np.array([0.2, 0.2]), np.array([0.8, 0.8])
    problem.start = np.clip(problem.start, low, high)
    result = problem.run(search(bounds=(low, high), tolerance=1e-6), derivatives=derivatives)
    assert np.all((result.embedding >= low) & (result.embedding <= high))
    assert np.any((places < low) | (places > high))
    inside = np.all((places > low) & (places < high), axis=1)
    inside[:10] = False
    error = np.abs(result.embedding - places)[inside].max()
    assert error < (1e-6 if derivatives else 5e-3)


@pytest.mark.parametrize("dimensions", [2, 3])
@given(seed=st.integers(0, 10_000))
@settings(max_examples=10, deadline=None)
def test_the_best_place_within_bounds_is_found(dimensions, seed):
    """Samples slide along the bounds to where scipy's least squares within a box ends."""
    rng = np.random.default_rng(seed)
    places = rng.random((20, dimensions))
    samples = places @ rng.normal(size=(dimensions, 5))  # axes depend on each other
    low, high = np.full(dimensions, 0.3), np.full(dimensions, 0.7)
    start = rng.uniform(0.3, 0.7, size=(20, dimensions))
    free = np.arange(8, 20)
    start[free[:6]] = np.where(start[free[:6]] < 0.5, low, high)  # in corners
    back_projector = RBF().fit(places[:8], samples[:8])
    problem = Problem(VectorSpace(samples), start, free, back_projector)
    result = problem.run(LocalSearch(bounds=(low, high), tolerance=1e-9))
    origin = back_projector.predict(np.zeros((1, dimensions)))[0]
    slope = back_projector.jacobian(np.zeros((1, dimensions)))[0]
    expected = [
        np.sqrt(2 * lsq_linear(slope, sample - origin, (low, high), tol=1e-14).cost)
        for sample in samples[free]
    ]
    assert np.all((result.embedding[free] >= low) & (result.embedding[free] <= high))
    assert np.allclose(result.errors, expected, atol=1e-6)


@SEARCHES
def test_a_start_out_of_bounds_is_refused(search):
    """A sample outside could be brought in only by raising its error."""
    with pytest.raises(WorkbenchError, match=r"embedding: .* within the bounds"):
        sheet().run(search(bounds=([0.4, 0.4], [0.5, 0.5])))


@SEARCHES
@DERIVATIVES
def test_a_callback_watches_and_stops(search, derivatives):
    """It sees each iteration in order; a true answer ends the search where it is."""
    seen = []

    def stop_at_three(iteration, error, embedding):
        seen.append((iteration, error, embedding.copy()))
        return iteration == 3

    problem = sheet(noise=0.5)
    result = problem.run(search(), stop_at_three, derivatives=derivatives)
    assert [iteration for iteration, _, _ in seen] == [1, 2, 3]
    assert result.reason == "stopped by the callback"
    assert np.array_equal(result.embedding, seen[-1][2])
    assert [error for _, error, _ in seen] == result.history[1:].tolist()


class Counting:
    """A back-projector that counts what is asked of it."""

    def __init__(self, inner):
        self.inner, self.predicted, self.differentiated = inner, 0, 0

    def predict(self, points):
        self.predicted += len(points)
        return self.inner.predict(points)

    def predict_with_jacobian(self, points):
        self.predicted += len(points)
        self.differentiated += len(points)
        return self.inner.predict_with_jacobian(points)


@SEARCHES
def test_the_effort_is_what_was_computed(search):
    """The reported evaluations and Jacobians are those that the back-projector was asked for."""
    problem = sheet()
    problem.back_projector = Counting(problem.back_projector)
    effort = problem.run(search()).effort
    assert effort.evaluations == problem.back_projector.predicted
    assert effort.jacobians == problem.back_projector.differentiated
    assert effort.distances >= effort.jacobians > 0


@SEARCHES
def test_the_derivatives_save_work(search):
    """With the Jacobian, counted as finite differences would cost, fewer points are needed."""
    with_them = sheet().run(search())
    without = sheet().run(search(), derivatives=False)
    cost = with_them.effort.evaluations + 2 * with_them.effort.jacobians
    assert cost < without.effort.evaluations
    assert with_them.errors.mean() <= 1.01 * without.errors.mean()


@SEARCHES
def test_a_stepwise_constant_back_projector_will_do(search):
    """With nearest neighbours, whose slope is 0 everywhere, errors still fall."""
    problem = sheet(noise=0.2)
    nearest = KNeighborsRegressor(n_neighbors=2)
    nearest.fit(problem.start[:20], problem.space.samples[:20])
    problem.back_projector = nearest
    result = problem.run(search())
    assert result.effort.jacobians == 0
    assert result.history[-1] < 0.8 * result.history[0]


def roll(turns_off):
    """Unroll a Swiss roll of two turns; samples of the first turn may start one turn off."""
    along, across = (part.ravel() for part in np.meshgrid(np.linspace(0, 1, 81), [0.0, 0.1, 0.2]))
    radius, angle = 1.0 + along, 4 * np.pi * along
    samples = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), 5 * across])
    plane = np.column_stack([along, across])
    control = np.flatnonzero(np.arange(len(along)) % 4 == 0)
    free = np.setdiff1d(np.arange(len(along)), control)
    start = plane.copy()
    start[free[along[free] < 0.5]] += [0.5 * turns_off, 0.0]
    return Problem(VectorSpace(samples), start, free, RBF().fit(plane[control], samples[control]))


@DERIVATIVES
def test_the_global_search_leaves_poor_basins(derivatives):
    """One turn off, samples of a roll come home by the global search, not by the local one."""
    home = roll(0).run(LocalSearch()).errors.mean()
    stuck = roll(1).run(LocalSearch(), derivatives=derivatives).errors.mean()
    found = roll(1).run(GlobalSearch(), derivatives=derivatives).errors.mean()
    assert stuck > 3 * home
    assert found < 1.5 * home


def dense_search(problem, steps=81, padding=0.25):
    """Look everywhere on a fine grid and go down from the best, sample by sample."""
    extent = np.ptp(problem.start, axis=0).max()
    low = problem.start.min(axis=0) - padding * extent
    high = problem.start.max(axis=0) + padding * extent
    axes = [np.linspace(a, b, steps) for a, b in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    table = problem.space.error_table(problem.free, problem.back_projector.predict(grid))
    started = Problem(problem.space, problem.start.copy(), problem.free, problem.back_projector)
    started.start[problem.free] = grid[table.argmin(axis=1)]
    return started.run(LocalSearch(tolerance=1e-6)).errors


@pytest.mark.parametrize(
    ("name", "projector"),
    [
        ("01_01-jump", "pca"),
        ("01_01-jump", "isomap"),
        ("02_01", "pca"),
        ("05_10", "isomap"),
        ("05_11", "pca"),
        ("06_04", "lle"),
        ("09_06", "mds"),
    ],
    ids=" by ".join,
)
def test_a_motion_is_searched_as_well_as_densely(name, projector):
    """Within 2 % of a dense search and not above Alg. 12, at far less work."""
    if name != "01_01-jump":
        find_clip(name)
    clip = workbench.load_space(f"cmu/{name}")
    raw = SpatialScheme(projector).run(clip, ratio=0.03, random_state=0)
    free = np.setdiff1d(np.arange(len(clip)), raw.control_points)
    problem = Problem(clip, raw.projected, free, raw.back_projector)
    reference = problem.run(GradientDescent())
    found, local = problem.run(GlobalSearch()), problem.run(LocalSearch())
    assert found.errors.sum() <= 1.02 * dense_search(problem).sum()
    assert found.errors.sum() <= 1.002 * reference.errors.sum()
    assert total(local.effort) < total(reference.effort) / 5
    # A fifth holds in the mean over clips; this one is short of sweeps for Alg. 12.
    assert total(found.effort) < total(reference.effort) / 2


def total(effort):
    """Add everything up, a Jacobian as the evaluations that differences would need."""
    return effort.evaluations + 2 * effort.jacobians + effort.distances


@pytest.mark.parametrize(
    ("search", "arguments", "message"),
    [
        (LocalSearch, {"tolerance": -1}, "tolerance: got -1"),
        (LocalSearch, {"max_iterations": 0}, "max_iterations: got 0"),
        (GlobalSearch, {"tolerance": float("nan")}, "tolerance: got nan"),
        (GlobalSearch, {"grid": 0}, "grid: got 0"),
        (GlobalSearch, {"share": 1.5}, "share: got 1.5"),
        (GlobalSearch, {"padding": -0.1}, "padding: got -0.1"),
    ],
    ids=lambda value: str(value) if isinstance(value, dict) else "",
)
def test_bad_settings_are_refused(search, arguments, message):
    """The message names the setting and its value."""
    with pytest.raises(WorkbenchError, match=message):
        search(**arguments)


@SEARCHES
@pytest.mark.parametrize(
    ("bounds", "message"),
    [
        (([0, 0], [0, 1]), "bounds: .*first below the second"),
        (([0, 0, 0], [1, 1, 1]), "bounds: .* 2 numbers each"),
        (5, "bounds: got 5"),
    ],
    ids=["empty", "three corners", "a number"],
)
def test_bad_bounds_are_refused(search, bounds, message):
    """The message says what a box is."""
    with pytest.raises(WorkbenchError, match=message):
        sheet().run(search(bounds=bounds))


@SEARCHES
def test_bad_arrays_are_refused(search):
    """Arrays that do not fit the embedding are named."""
    problem = sheet()
    with pytest.raises(WorkbenchError, match="neighbors: got shape"):
        search().optimize(problem.objective(), problem.start, problem.free, [[0, 1]])
    with pytest.raises(WorkbenchError, match="free: got 60"):
        search().optimize(problem.objective(), problem.start, [60], problem.space.neighbors)
