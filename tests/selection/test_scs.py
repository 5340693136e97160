"""Tests of workbench.selection.scs."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings

from tests.selection.conftest import random_motion, selections, still_motion
from workbench.errors import WorkbenchError
from workbench.interpolation import interpolators
from workbench.selection.scs import SimpleCurveSimplification
from workbench.spaces import VectorSpace


def naive(space, count, fixed, interpolator):
    """Follow Alg. 1 word by word: rebuild everything for every key."""
    keys = {0, len(space) - 1, *fixed}
    while len(keys) < count:
        rebuilt = interpolators.build(interpolator).interpolate(space.motion, sorted(keys))
        errors = space.errors(np.arange(len(space)), rebuilt)
        errors[list(keys)] = -1.0
        keys.add(int(np.argmax(errors)))
    return sorted(keys)


@settings(deadline=None, max_examples=25)
@given(drawn=selections())
def test_selection_follows_the_algorithm(drawn):
    """Keys are those of a plain implementation, with fixed frames among them."""
    space, count, fixed = drawn
    found = SimpleCurveSimplification().select(space, count, fixed=fixed)
    assert found.tolist() == naive(space, count, fixed, "slerp")


def test_selection_with_linear_interpolation_follows_it_too():
    """The interpolator that rebuilds is the one that was asked for."""
    space = random_motion(80, 5)
    found = SimpleCurveSimplification("linear").select(space, 12)
    assert found.tolist() == naive(space, 12, [], "linear")
    assert found.tolist() != naive(space, 12, [], "slerp")


def test_keys_are_nested(wandering):
    """More keys are the same and others."""
    few, many = (set(SimpleCurveSimplification().select(wandering, n)) for n in (7, 20))
    assert few < many


def test_equal_errors_are_settled_by_the_earlier_frame():
    """A still motion gives the first frames and the last."""
    assert SimpleCurveSimplification().select(still_motion(9), 5).tolist() == [0, 1, 2, 3, 8]


def test_what_cannot_be_is_refused(wandering):
    """No room for the ends, a table, an unknown interpolator: each is said."""
    with pytest.raises(WorkbenchError, match="count: got 3 keyframes, want at least 5"):
        SimpleCurveSimplification().select(wandering, 3, fixed=[4, 5, 6])
    with pytest.raises(WorkbenchError, match="got the table"):
        SimpleCurveSimplification().select(VectorSpace(np.eye(5)), 3)
    with pytest.raises(WorkbenchError, match="interpolator: got 'hermite'"):
        SimpleCurveSimplification("hermite")
