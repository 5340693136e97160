"""Tests of workbench.selection."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.schemes import choose_control_points
from workbench.selection.chord import chord_keyframes
from workbench.selection.pb import decimated_keyframes
from workbench.selection.random import Random
from workbench.selection.rols import RegularizedOrthogonalLeastSquares
from workbench.selection.uniform import Uniform
from workbench.spaces import PoseSpace, VectorSpace


@pytest.fixture
def table():
    """Give 80 rows of 5 numbers."""
    return VectorSpace(np.random.default_rng(0).random((80, 5)))


def test_uniform_selection_includes_both_ends(waving):
    """Keyframes are evenly spaced to within one frame."""
    keys = choose_control_points(PoseSpace(waving), "uniform", count=7)
    assert (keys[0], keys[-1], len(keys)) == (0, 59, 7)
    assert np.ptp(np.diff(keys)) <= 1


def test_random_selection_depends_on_the_seed_only(table):
    """One seed, one sample; another seed, another sample."""
    first, again, other = (
        choose_control_points(table, "random", ratio=0.2, random_state=seed).tolist()
        for seed in (1, 1, 2)
    )
    assert first == again != other
    assert len(set(first)) == 16


@pytest.mark.parametrize("seed", ["one", -1, 1.5], ids=["word", "negative", "fraction"])
@pytest.mark.parametrize("selector", [Random, RegularizedOrthogonalLeastSquares])
def test_what_is_no_seed_is_refused(table, selector, seed):
    """The message says what a seed may be."""
    with pytest.raises(WorkbenchError, match=r"random_state: got .*, want a whole"):
        selector(random_state=seed).select(table, 5)


def test_a_selector_object_gets_the_seed_too(table):
    """An object that leaves its seed open selects as the name does, and is not changed."""
    selector = Random()
    found = choose_control_points(table, selector, count=9, random_state=4)
    assert np.array_equal(found, choose_control_points(table, "random", count=9, random_state=4))
    assert selector.random_state is None


def test_a_selector_that_gives_too_few_is_refused(table):
    """Asked for 9, a selector may not give 2."""

    class Lazy:
        def select(self, space, count):
            return np.array([0, 1])

    with pytest.raises(WorkbenchError, match="gave 2 samples, want 9"):
        choose_control_points(table, Lazy(), count=9)


@pytest.mark.parametrize("name", ["uniform", "random"])
def test_fixed_samples_stay(table, name):
    """Samples that the user fixes are selected, and the number is what was asked for."""
    found = choose_control_points(table, name, count=9, fixed=[33, 5], random_state=0)
    assert {5, 33} <= set(found.tolist())
    assert len(found) == 9


def test_uniform_selection_spreads_around_fixed_frames(waving):
    """With a fixed frame off the grid, no interval is longer than it must be."""
    keys = choose_control_points(PoseSpace(waving), "uniform", count=7, fixed=[3])
    assert {0, 3, 59} <= set(keys.tolist())
    assert np.diff(keys).max() == 12  # 56 frames in five parts


@pytest.mark.parametrize(
    ("fixed", "message"),
    [
        ([80], "fixed: got 80"),
        ([4, 4], "fixed: .*repeated"),
        (range(10), "at most count=9"),
        (5, "fixed: got 5, want a list"),
        ([None, 1], r"fixed: got \[None, 1\], want a list"),
        ([[1, 2], [3]], "fixed: got .*want a list"),
    ],
    ids=["outside", "twice", "too many", "number", "missing", "ragged"],
)
def test_bad_fixed_samples_are_refused(table, fixed, message):
    """The message names the argument."""
    with pytest.raises(WorkbenchError, match=message):
        Uniform().select(table, 9, fixed=fixed)
    for of_curves in (chord_keyframes, decimated_keyframes):
        with pytest.raises(WorkbenchError, match=message):
            of_curves(table.samples, 9, fixed=fixed)


def test_a_selector_that_knows_no_fixed_samples_says_so(table):
    """A user's own selector with ``select(space, count)`` alone serves until some are fixed."""

    class Start:
        def select(self, space, count):
            return np.arange(count)

    assert len(choose_control_points(table, Start(), count=4)) == 4
    with pytest.raises(WorkbenchError, match="cannot keep samples"):
        choose_control_points(table, Start(), count=4, fixed=[1])
