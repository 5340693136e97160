"""Tests of workbench.selection."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.schemes import choose_control_points
from workbench.selection.random import Random
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
