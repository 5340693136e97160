"""Tests of workbench.validation and workbench.registry."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.registry import Registry
from workbench.validation import (
    as_distances,
    as_embedding,
    control_point_count,
    control_point_indices,
    whole_number,
)


@pytest.mark.parametrize(
    ("n", "ratio", "expected"),
    [(817, 0.03, 24), (150, 0.03, 4), (40, 0.03, 3), (10, 0.3, 3), (1000, 0.29, 290), (3, 0.03, 2)],
)
def test_ratio_gives_its_floor_but_at_least_three(n, ratio, expected):
    """The number of control points is max(3, floor(ratio · n))."""
    assert control_point_count(n, ratio=ratio) == expected


@pytest.mark.parametrize(
    ("wanted", "message"),
    [
        ({}, "exactly one"),
        ({"count": 5, "ratio": 0.1}, "exactly one"),
        ({"ratio": 0.0}, "ratio: got 0.0"),
        ({"ratio": 1.0}, "ratio: got 1.0"),
        ({"ratio": float("nan")}, "ratio: got nan"),
        ({"ratio": "3%"}, "ratio: got '3%'"),
        ({"count": 1}, "count: got 1"),
        ({"count": 3.7}, "count: got 3.7"),
        ({"count": True}, "count: got True"),
        ({"count": 100}, "want from 2 to 99"),
    ],
    ids=["neither", "both", "zero", "one", "nan", "text", "too few", "part", "flag", "too many"],
)
def test_unusable_counts_are_refused(wanted, message):
    """The message names the argument, its value and what is allowed."""
    with pytest.raises(WorkbenchError, match=message):
        control_point_count(100, **wanted)


@pytest.mark.parametrize(
    ("indices", "message"),
    [
        ([], "want a list"),
        ([0.5, 1.5], "want a list"),
        ([0, 10], "want indices from 0 to 9"),
        ([-1, 2], "want indices from 0 to 9"),
        ([3, 1], "unsorted"),
        ([1, 1], "repeated"),
    ],
    ids=["none", "fractions", "too large", "negative", "unsorted", "repeated"],
)
def test_unusable_indices_are_refused(indices, message):
    """Control points are sorted indices, each once."""
    with pytest.raises(WorkbenchError, match=message):
        control_point_indices(indices, 10)


@pytest.mark.parametrize(
    "points", [np.zeros((5, 4)), np.zeros(5), [[0, np.nan]]], ids=["4-D", "flat", "nan"]
)
def test_unusable_embeddings_are_refused(points):
    """Embeddings are finite and have two or three columns."""
    with pytest.raises(WorkbenchError, match="embedding"):
        as_embedding(points)


def test_registries_are_open_and_name_what_they_hold():
    """A registered factory is created by name; an unknown name lists the known ones."""
    registry = Registry("number", {"third": "fractions:Fraction"})
    registry.register("two", lambda offset=0: 2 + offset)
    assert registry.create("two", offset=3) == 5
    assert registry.create("third", 1, 3) * 3 == 1
    assert "two" in registry
    with pytest.raises(WorkbenchError, match="got 'four', want one of third, two"):
        registry.create("four")
    with pytest.raises(WorkbenchError, match="want a class or function"):
        registry.register("five", 5)


def test_a_matrix_that_is_not_symmetric_is_found_anywhere():
    """One entry that differs from its mirror image is enough, in whatever block it lies."""
    points = np.random.default_rng(0).random((700, 2))
    distances = np.linalg.norm(points[:, None] - points, axis=2)
    assert as_distances(distances) is distances
    for i, j in [(0, 699), (699, 0), (300, 301), (511, 512)]:
        broken = distances.copy()
        broken[i, j] += 0.01
        with pytest.raises(WorkbenchError, match="not symmetric"):
            as_distances(broken)


def test_a_sample_is_at_no_distance_from_itself():
    """A matrix of similarities, 1 on the diagonal, is not taken for one of distances."""
    with pytest.raises(WorkbenchError, match=r"got 1\.0 from a sample to itself"):
        as_distances(np.ones((4, 4)))


@pytest.mark.parametrize("value", [0, 2.5, "3", True, None], ids=repr)
def test_what_is_no_whole_number_is_named(value):
    """The setting and its value are in the message; numpy's integers are fine."""
    with pytest.raises(WorkbenchError, match="sweeps: got"):
        whole_number("sweeps", value)
    assert whole_number("sweeps", np.int64(3)) == 3
