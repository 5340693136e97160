"""Keyframes of curves of numbers."""

from __future__ import annotations

from itertools import combinations, pairwise

import numpy as np
import pytest

from workbench import load_space
from workbench.errors import WorkbenchError
from workbench.mocap.channels import motion_to_euler
from workbench.selection import selectors
from workbench.selection.curves import (
    CURVE_SELECTORS,
    curve_keyframes,
    least_squares_keyframes,
    rebuilt_linearly,
)


def squared_error(values, keys):
    """Sum the squared errors frame by frame, without any closed form."""
    total = 0.0
    for first, last in pairwise(keys):
        for frame in range(first, last):
            share = (frame - first) / (last - first)
            straight = (1 - share) * values[first] + share * values[last]
            total += np.sum((values[frame] - straight) ** 2)
    return total


@pytest.fixture
def walk_of_numbers():
    """Give three random walks of 12 frames."""
    return np.cumsum(np.random.default_rng(3).normal(size=(12, 3)), axis=0)


@pytest.mark.parametrize("count", [2, 3, 5, 8, 11, 12])
def test_exact_keyframes_beat_every_other_choice(walk_of_numbers, count):
    """Of all choices of as many frames with both ends, none has a smaller error."""
    keys = least_squares_keyframes(walk_of_numbers, count)
    choices = [(0, *inner, 11) for inner in combinations(range(1, 11), count - 2)]
    best = min(squared_error(walk_of_numbers, choice) for choice in choices)
    assert len(keys) == count
    assert squared_error(walk_of_numbers, keys) == pytest.approx(best, abs=1e-12)


def test_the_error_is_that_of_the_rebuilt_curves(walk_of_numbers):
    """Linear reconstruction and the errors that are minimised belong together."""
    keys = least_squares_keyframes(walk_of_numbers, 5)
    rebuilt = rebuilt_linearly(walk_of_numbers, keys)
    assert np.sum((rebuilt - walk_of_numbers) ** 2) == pytest.approx(
        squared_error(walk_of_numbers, keys)
    )
    assert np.array_equal(rebuilt[keys], walk_of_numbers[keys])


def test_beyond_the_keyframes_the_nearest_holds():
    """A motion whose ends are no keyframes is rebuilt there too."""
    values = np.arange(6.0)[:, None]
    assert rebuilt_linearly(values, np.array([1, 4])).ravel().tolist() == [1, 1, 2, 3, 4, 4]


@pytest.mark.parametrize("selector", CURVE_SELECTORS[1:])
def test_every_selector_meets_the_count_and_keeps_the_ends(selector):
    """Sorted frames, each once, as many as asked for."""
    values = np.cumsum(np.random.default_rng(0).normal(size=(60, 4)), axis=0)
    keys = curve_keyframes(values, selector, 9)
    assert (keys[0], keys[-1], len(np.unique(keys)), len(keys)) == (0, 59, 9, 9)


def test_saliency_on_angles_is_the_selector_on_poses():
    """A table of a clip's joint angles gets the keyframes of the clip."""
    space = load_space("cmu/01_01-two-jumps")
    angles = motion_to_euler(space.motion, unwrap=True)
    for name, value in (("sigma", 5.0), ("n_components", 4), ("cluster_width", 2.0)):
        keys = curve_keyframes(angles, "saliency", None, **{name: value})
        expected = selectors.create("saliency", **{name: value}).select(space)
        assert np.array_equal(keys, expected)


@pytest.mark.parametrize(
    ("selector", "count"), [("optimal", 5), ("pb", None), ("saliency", 5)], ids=str
)
def test_what_curves_do_not_allow_is_refused(selector, count):
    """The message lists what they allow."""
    with pytest.raises(WorkbenchError, match="want one of pb, chord, scs, uniform, exact"):
        curve_keyframes(np.eye(8), selector, count)
