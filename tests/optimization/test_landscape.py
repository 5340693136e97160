"""Tests of error landscapes."""

from __future__ import annotations

import numpy as np
import pytest

from tests.optimization.problems import flat, sheet
from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.optimization.landscape import PlaneGrid, error_landscape, rebuild_grid
from workbench.schemes import SpatialScheme


def test_a_landscape_is_the_objective_at_its_places():
    """Each entry equals the error that the optimizer would be told there."""
    problem = sheet()
    grid = PlaneGrid.around(problem.start, side=30)
    landscape = error_landscape(problem.space, 25, grid, rebuild_grid(problem.back_projector, grid))
    expected = problem.objective()(grid.points, np.full(900, 25))
    np.testing.assert_allclose(landscape.errors.ravel(), expected, atol=1e-12)


def test_the_minimum_is_next_to_the_exact_place():
    """On a plane the lowest grid place is one of the neighbours of the exact place."""
    problem, places = flat()
    grid = PlaneGrid.around(problem.start, side=80)
    rebuilt = rebuild_grid(problem.back_projector, grid)
    for sample in (15, 30):
        place, _ = error_landscape(problem.space, sample, grid, rebuilt).minimum
        assert np.abs(place - places[sample]).max() <= grid.x[1] - grid.x[0]


def test_frames_have_landscapes_too():
    """A frame's landscape has the error of its own pose."""
    space = load_space("cmu/01_01-jump")
    result = SpatialScheme("pca").run(space, ratio=0.05)
    grid = PlaneGrid.around(result.embedding, side=6)
    rebuilt = rebuild_grid(result.back_projector, grid)
    landscape = error_landscape(space, 7, grid, rebuilt)
    np.testing.assert_allclose(
        landscape.errors.ravel(), space.errors(np.full(36, 7), rebuilt), atol=1e-12
    )


def test_rebuilding_reports_how_much_is_done():
    """Reports rise to 1."""
    problem = sheet()
    reports: list[float] = []
    rebuild_grid(problem.back_projector, PlaneGrid.around(problem.start, 48), reports.append)
    assert len(reports) > 2
    assert reports == sorted(reports)
    assert reports[-1] == 1.0


def test_a_grid_is_square_around_a_single_place():
    """Samples that all coincide still get a plane to look at."""
    grid = PlaneGrid.around(np.full((3, 2), 4.0), side=3, padding=0.5)
    assert grid.x.tolist() == grid.y.tolist() == [3.0, 4.0, 5.0]


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: PlaneGrid.around(np.zeros((5, 3)), 4), "embedding: got 3 dimensions, want 2"),
        (lambda: PlaneGrid.around(np.zeros((5, 2)), 1), "side: got 1, want 2 or more"),
        (
            lambda: error_landscape(
                sheet().space, 60, PlaneGrid.around(sheet().start, 2), np.zeros((4, 4))
            ),
            "sample: got 60, want 0 to 59",
        ),
    ],
    ids=["three dimensions", "one place", "no such sample"],
)
def test_refusals_say_what_is_wrong(make, words):
    """Messages name the argument and what it wants."""
    with pytest.raises(WorkbenchError, match=words):
        make()
