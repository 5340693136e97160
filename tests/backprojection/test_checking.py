"""Tests of workbench.backprojection.checking and places."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.backprojection.checking import empty_result, positions
from workbench.backprojection.places import spread_out
from workbench.backprojection.rbf import RBF
from workbench.errors import DataError

POINTS = np.random.default_rng(0).random((25, 2))


def test_results_that_memory_cannot_hold_are_refused_before_the_work():
    """The message says how much it would take and what to do."""
    with pytest.raises(DataError, match=r"1000000000 points needs .* GB.*in several parts"):
        empty_result(10**9, 10**5)


@pytest.mark.parametrize(
    "given",
    [
        POINTS.tolist(),
        POINTS.astype(np.float32),
        np.asfortranarray(POINTS),
        np.hstack([POINTS, POINTS])[:, :2],
        POINTS[::-1][::-1],
    ],
    ids=["list", "float32", "by columns", "some columns", "reversed"],
)
def test_positions_come_as_rows_of_doubles(given):
    """Whatever holds them, compiled loops get one contiguous array."""
    found = positions(RBF().fit(POINTS, POINTS[:, 0]), given)
    assert found.flags.c_contiguous
    assert found.dtype == np.float64
    assert np.allclose(found, POINTS, atol=1e-7)


def test_spread_out_points_cover_the_cloud():
    """The first is in the middle; each other is the farthest from those before it."""
    line = np.column_stack([np.arange(9.0), np.zeros(9)])
    assert spread_out(line, 1).tolist() == [4]
    assert spread_out(line, 3).tolist() == [0, 4, 8]
    assert spread_out(line, 9).tolist() == list(range(9))
    chosen = POINTS[spread_out(POINTS, 6)]
    gaps = np.linalg.norm(chosen[:, None] - chosen, axis=2)[np.triu_indices(6, 1)]
    reach = np.linalg.norm(POINTS[:, None] - chosen, axis=2).min(axis=1)
    assert reach.max() <= gaps.min()
