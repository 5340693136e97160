"""Tests of workbench.selection.tracks and track_errors."""

from __future__ import annotations

import numpy as np
import pytest

from tests.selection.conftest import random_motion, still_motion
from workbench.errors import WorkbenchError
from workbench.interpolation import interpolators
from workbench.selection.track_errors import errors_between
from workbench.selection.tracks import pose_track, value_track
from workbench.spaces import VectorSpace


@pytest.mark.parametrize("name", ["slerp", "linear"])
@pytest.mark.parametrize(("first", "last"), [(0, 149), (20, 90), (7, 9)])
def test_errors_are_those_of_the_interpolator(name, first, last):
    """Compiled errors agree with interpolating all poses and measuring D_q per joint."""
    space = random_motion(150, 0)
    inner = np.arange(first + 1, last)
    rebuilt = interpolators.build(name).interpolate(space.motion, [first, last])[inner]
    found = errors_between(pose_track(space, name, "scs"), first, last)
    assert np.allclose(found, space.errors(inner, rebuilt), rtol=1e-12, atol=1e-13)


def test_a_still_motion_has_no_error_at_all():
    """Interpolating between equal poses gives exactly the pose."""
    found = errors_between(pose_track(still_motion(10), "slerp", "scs"), 0, 9)
    assert np.array_equal(found, np.zeros(8))


def test_values_are_compared_with_the_line_between_keys():
    """For plain curves an error is the Euclidean distance from linear interpolation."""
    values = np.random.default_rng(1).normal(size=(90, 4))
    frames = np.arange(90)
    line = np.column_stack([np.interp(frames, [5, 85], curve[[5, 85]]) for curve in values.T])
    found = errors_between(value_track(values), 5, 85)
    assert np.allclose(found, np.linalg.norm(values - line, axis=1)[6:85])


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([[1.0], [2.0]], "values: got shape"),
        ([1.0, 2.0, 3.0], "values: got shape"),
        ([[1.0], [np.nan], [3.0]], "values: got nan"),
        ([["a"], ["b"], ["c"]], "values: got what is no array"),
    ],
    ids=["short", "flat", "nan", "words"],
)
def test_bad_curves_are_refused(values, message):
    """The message names the argument."""
    with pytest.raises(WorkbenchError, match=message):
        value_track(values)


def test_tables_and_unknown_interpolators_are_refused(wandering):
    """A table has no order in time; only interpolators between two keys can be tracked."""
    table = VectorSpace(np.eye(4), name="t")
    with pytest.raises(WorkbenchError, match=r"got the table 't'.*'rols' or 'random'"):
        pose_track(table, "slerp", "scs")
    with pytest.raises(WorkbenchError, match="interpolator: got 'rbf'"):
        pose_track(wandering, "rbf", "scs")
