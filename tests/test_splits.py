"""Splits into training and test samples."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.errors import WorkbenchError
from workbench.spaces import PoseSpace, VectorSpace
from workbench.spaces.splits import split, standardized_by


@given(n=st.integers(12, 80), share=st.floats(0.3, 0.7), seed=st.integers(0, 99))
def test_every_sample_is_in_one_part(n: int, share: float, seed: int):
    """Training and test samples are apart, sorted and all, in the share that is asked for."""
    space = VectorSpace(np.arange(2.0 * n).reshape(n, 2))
    training, test = split(space, "random", share, np.random.default_rng(seed))
    assert sorted([*training, *test]) == list(range(n))
    assert np.all(np.diff(training) > 0)
    assert np.all(np.diff(test) > 0)
    assert len(training) == round(share * n)


def test_blocks_are_tenths_of_the_motion(waving):
    """Of 60 frames, three whole runs of six are held out."""
    training, test = split(PoseSpace(waving), "blocks", 0.7, np.random.default_rng(0))
    assert len(training) == 42
    starts = test[::6]
    assert np.array_equal(test.reshape(3, 6), starts[:, None] + np.arange(6))
    assert np.all(starts % 6 == 0)


def test_another_seed_splits_otherwise(waving):
    """The split depends on the generator and on nothing else."""
    space = PoseSpace(waving)
    first, again, other = (
        split(space, "blocks", 0.7, np.random.default_rng(seed))[1] for seed in (1, 1, 2)
    )
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_tables_have_no_blocks_and_few_rows_no_parts():
    """What cannot be split is refused, and the message says why."""
    rng = np.random.default_rng(0)
    with pytest.raises(WorkbenchError, match="no order in time"):
        split(VectorSpace(np.eye(20)), "blocks", 0.7, rng)
    with pytest.raises(WorkbenchError, match="got 5 samples, want enough for 3 to train"):
        split(VectorSpace(np.eye(5)), "random", 0.7, rng)


def test_scaling_is_that_of_the_rows_given(waving):
    """Their columns get zero mean and unit variance; a constant column is shifted only."""
    values = np.column_stack([np.arange(8.0) ** 2, [5.0] * 7 + [6.0]])
    rows = np.arange(5)
    scaled = standardized_by(VectorSpace(values), rows).samples
    assert scaled[rows].mean(axis=0) == pytest.approx([0, 0])
    assert scaled[rows].std(axis=0) == pytest.approx([1, 0])
    assert scaled[7, 1] == 1.0
    with pytest.raises(WorkbenchError, match="got the motion 'waving', want a table"):
        standardized_by(PoseSpace(waving), rows)
