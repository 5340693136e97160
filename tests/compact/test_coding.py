"""Tests of workbench.compact.coding."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from workbench.compact.coding import Coded, decode, encode

WHOLE = st.one_of(st.integers(-300, 300), st.integers(-(2**63), 2**63 - 1))
COUNTS = arrays(
    np.int64, array_shapes(min_dims=2, max_dims=2, min_side=0, max_side=6), elements=WHOLE
)


@given(COUNTS)
def test_any_whole_numbers_come_back(counts):
    """Decoding undoes encoding, the largest 64-bit numbers included."""
    assert np.array_equal(decode(encode(counts), counts.shape), counts)


@given(COUNTS)
def test_bytes_are_as_documented(counts):
    """A plain reading of the documented bytes, number by number, gives the same."""
    coded = encode(counts)
    n_rows, n_columns = counts.shape
    for column in range(n_columns):
        changes = []
        for row in range(n_rows):
            places = [(b * n_columns + column) * n_rows + row for b in range(coded.width)]
            code = sum(coded.content[place] << 8 * b for b, place in enumerate(places))
            changes.append(code // 2 if code % 2 == 0 else -(code + 1) // 2)
        for _ in range(coded.differences):
            changes = [sum(changes[: row + 1]) for row in range(n_rows)]
        wrapped = [(change + 2**63) % 2**64 - 2**63 for change in changes]
        assert wrapped == counts[:, column].tolist()


def test_smooth_curves_become_few_bytes():
    """A parabola of 16-bit numbers takes one byte each, nearly all of them alike."""
    frames = np.arange(250)
    coded = encode((frames**2 // 2)[:, None])
    assert (coded.differences, coded.width) == (2, 1)
    assert len(set(coded.content)) <= 3


@pytest.mark.parametrize(
    "coded",
    [
        Coded(b"\0" * 5, 0, 1),
        Coded(b"\0" * 6, 3, 1),
        Coded(b"\0" * 6, -1, 1),
        Coded(b"\0" * 54, 0, 9),
        Coded(b"", 0, 0),
    ],
    ids=["too few bytes", "three differences", "minus one", "nine bytes", "no bytes"],
)
def test_what_no_encoder_gives_is_refused(coded):
    """Bytes, differences and width must fit each other."""
    with pytest.raises(ValueError):
        decode(coded, (2, 3))
