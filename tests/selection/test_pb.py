"""Tests of workbench.selection.pb."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings

from tests.selection.conftest import random_motion, selections, still_motion
from workbench.errors import WorkbenchError
from workbench.interpolation import interpolators
from workbench.selection.pb import PositionBased, decimated_keyframes
from workbench.spaces import VectorSpace


def naive(space, count, fixed, interpolator):
    """Follow Alg. 2 word by word: rebuild everything without each frame in turn."""
    keys = list(range(len(space)))
    stays = {0, len(space) - 1, *fixed}
    method = interpolators.build(interpolator)
    while len(keys) > count:
        costs = {}
        for frame in set(keys) - stays:
            rebuilt = method.interpolate(space.motion, [k for k in keys if k != frame])
            costs[frame] = space.errors([frame], rebuilt[[frame]])[0]
        keys.remove(min(costs, key=lambda frame: (costs[frame], frame)))
    return keys


@settings(deadline=None, max_examples=20)
@given(drawn=selections(max_frames=14))
def test_selection_follows_the_algorithm(drawn):
    """Keys are those of a plain implementation, with fixed frames among them."""
    space, count, fixed = drawn
    found = PositionBased().select(space, count, fixed=fixed)
    assert found.tolist() == naive(space, count, fixed, "slerp")


def test_selection_with_linear_interpolation_follows_it_too():
    """The interpolator that rebuilds is the one that was asked for."""
    space = random_motion(26, 8)
    found = PositionBased("linear").select(space, 9)
    assert found.tolist() == naive(space, 9, [], "linear")
    assert found.tolist() != naive(space, 9, [], "slerp")


def test_equal_costs_are_settled_by_the_earlier_frame():
    """Of a still motion the first frames are dropped first, the ends never."""
    assert PositionBased().select(still_motion(9), 4).tolist() == [0, 6, 7, 8]


def test_curves_of_numbers_keep_their_corners():
    """A polygon keeps its corners, which linear interpolation cannot do without."""
    corners, frames = [0, 7, 12, 30], np.arange(31)
    curves = np.column_stack(
        [np.interp(frames, corners, heights) for heights in ([0, 5, -3, 1], [2, 2, 9, 0])]
    )
    assert decimated_keyframes(curves, 4).tolist() == corners
    assert decimated_keyframes(curves, 5, fixed=[20]).tolist() == [0, 7, 12, 20, 30]


def test_what_cannot_be_is_refused(wandering):
    """No room for the ends, a table, an unknown interpolator: each is said."""
    with pytest.raises(WorkbenchError, match="count: got 3 keyframes, want at least 5"):
        PositionBased().select(wandering, 3, fixed=[4, 5, 6])
    with pytest.raises(WorkbenchError, match="got the table"):
        PositionBased().select(VectorSpace(np.eye(5)), 3)
    with pytest.raises(WorkbenchError, match="interpolator: got 7"):
        PositionBased(7)
    with pytest.raises(WorkbenchError, match="count: got 5"):
        decimated_keyframes(np.eye(5), 5)
