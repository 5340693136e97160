"""Eq. 5.1 to 5.3 of Costa 2018, counted by hand."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.reproduction.costa2018.size_formulas import (
    equal_size_difference,
    spatial_limit,
    spatial_size,
    temporal_limit,
    temporal_size,
    whole_size,
)
from workbench.reproduction.published import published


@pytest.mark.parametrize("n_joints", [1, 31, 60])
@pytest.mark.parametrize("dimensions", [2, 3])
def test_sizes_are_those_of_arrays(n_joints, dimensions):
    """200 frames, 8 keyframes: as many numbers as the arrays that would be stored have."""
    frames, keys = 200, 8
    path = np.zeros((frames, 3)).size
    poses = np.zeros((keys, n_joints, 3)).size + np.zeros(keys).size
    positions = np.zeros((frames, dimensions)).size
    header = 17
    options = {"n_joints": n_joints, "header": header}
    assert whole_size(frames, **options) == header + np.zeros((frames, n_joints, 3)).size + path
    assert temporal_size(frames, 0.04, **options) == header + path + poses
    assert (
        spatial_size(frames, 0.04, dimensions=dimensions, **options)
        == header + path + poses + positions
    )


def test_limits_are_those_published():
    """6.06 and 8.15 % of the whole motion, and 2.13 % more keyframes at equal size."""
    table = published("costa2018:sec5.1").table()["per cent"]
    ours = [100 * temporal_limit(0.03), 100 * spatial_limit(0.03), 100 * equal_size_difference()]
    assert np.round(ours, 2).tolist() == table.tolist()


def test_limits_are_approached_as_motions_grow():
    """With a header of half a frame in a hundred, long motions come near to the limits."""
    sizes = [temporal_size(f, 0.03, header=500) / whole_size(f, header=500) for f in (10**3, 10**7)]
    assert abs(sizes[1] - temporal_limit(0.03)) < 1e-6 < abs(sizes[0] - temporal_limit(0.03))


@pytest.mark.parametrize("dimensions", [2, 3])
def test_the_difference_makes_sizes_equal(dimensions):
    """A temporal scheme with that many more keyframes stores as much as the spatial one."""
    more = equal_size_difference(dimensions=dimensions)
    assert temporal_size(1000, 0.03 + more) == pytest.approx(
        spatial_size(1000, 0.03, dimensions=dimensions)
    )
