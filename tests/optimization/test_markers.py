"""Tests of the searches for better markers."""

from __future__ import annotations

import numpy as np
import pytest

import workbench
from workbench.backprojection.rbf import RBF
from workbench.errors import WorkbenchError
from workbench.optimization.markers import ExchangeMarkers, MoveMarkers, marker_searches
from workbench.schemes import SpatialScheme
from workbench.spaces import PoseSpace, VectorSpace

SEARCHES = pytest.mark.parametrize(
    "search", [MoveMarkers, ExchangeMarkers], ids=["move", "exchange"]
)
KEPT = np.arange(0, 40, 4)


@pytest.fixture
def bent():
    """Give a bent sheet and the plane that it was bent from."""
    plane = np.random.default_rng(1).random((40, 2))
    samples = np.column_stack([plane, np.sin(4 * plane[:, 0]), plane[:, 1] ** 2])
    return VectorSpace(samples), plane


@SEARCHES
def test_the_error_never_rises_and_is_true(bent, search):
    """Round by round the mean error falls; fitting anew at the end gives the last one."""
    space, plane = bent
    result = search(max_rounds=5).search(space, RBF(), KEPT, plane)
    assert np.all(np.diff(result.history) <= 0)
    assert result.history[-1] < 0.98 * result.history[0]
    markers = result.markers
    refitted = RBF().fit(
        markers.embedding[markers.control_points], space.samples[markers.control_points]
    )
    errors = space.errors(markers.free, refitted.predict(markers.embedding[markers.free]))
    assert errors.sum() / len(space) == pytest.approx(result.history[-1], rel=1e-12)
    assert result.fits > len(KEPT)
    assert result.effort.evaluations > result.fits


def test_moving_keeps_the_samples_and_exchanging_the_places(bent):
    """One search changes where control points lie, the other which samples they are."""
    space, plane = bent
    moved = MoveMarkers(max_rounds=1).search(space, RBF(), KEPT, plane).markers
    assert np.array_equal(moved.control_points, KEPT)
    assert not np.allclose(moved.embedding[KEPT], plane[KEPT])
    exchanged = ExchangeMarkers(max_rounds=1).search(space, RBF(), KEPT, plane).markers
    assert len(exchanged.control_points) == len(KEPT)
    assert set(exchanged.control_points) != set(KEPT)


@pytest.mark.parametrize("name", marker_searches.names())
def test_a_scheme_with_markers_beats_that_without(name):
    """On every third frame of the bundled jump the error is lower, and the result consistent."""
    clip = PoseSpace(workbench.load("cmu/01_01-jump")[::3])
    plain = SpatialScheme("pca", optimizer="local").run(clip, ratio=0.06)
    scheme = SpatialScheme("pca", optimizer="local", markers=name)
    result = scheme.run(clip, ratio=0.06)
    assert result.error < plain.error
    assert result.error == pytest.approx(result.marker_result.history[-1], rel=1e-9)
    rebuilt = result.back_projector.predict(result.embedding[result.control_points])
    assert np.allclose(rebuilt, clip.samples[result.control_points], atol=1e-6)
    assert result.timings.steps["markers"] > 0
    assert result.evaluations > plain.evaluations


@SEARCHES
def test_a_callback_stops_the_search(bent, search):
    """A true answer after the second round ends it there."""
    space, plane = bent
    seen = []
    result = search().search(
        space, RBF(), KEPT, plane, callback=lambda number, *_: seen.append(number) or number == 2
    )
    assert seen == list(range(1, len(result.history)))
    assert len(seen) <= 2


@SEARCHES
def test_bad_input_is_refused(bent, search):
    """Messages name the argument."""
    space, plane = bent
    with pytest.raises(WorkbenchError, match="max_rounds: got 0"):
        search(max_rounds=0)
    with pytest.raises(WorkbenchError, match="embedding: got shape"):
        search().search(space, RBF(), KEPT, plane[:-1])
    with pytest.raises(WorkbenchError, match="unsorted or repeated"):
        search().search(space, RBF(), [3, 1], plane)
