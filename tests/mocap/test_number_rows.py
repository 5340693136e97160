"""Tests of the fast reader of number rows."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from workbench.errors import MotionFormatError
from workbench.mocap.number_rows import read_number_rows, scan_numbers
from workbench.mocap.textfile import parse_number

_WRITTEN = st.one_of(
    st.floats(allow_nan=False, allow_infinity=False).map(repr),
    st.from_regex(
        r"[+-]?([0-9]{1,25}\.?[0-9]{0,25}|\.[0-9]{1,25})([eE][+-]?[0-9]{1,2})?", fullmatch=True
    ),
)


@given(text=_WRITTEN)
@example("9007199254740993")
@example("9007199254740992e22")
@example("123456789012345678901234567890")
@example("0.000000000000000000000000000000000000001")
@example("-0.0")
@example("1.7976931348623157e308")
@example("5e-324")
@example("1e-400")
@example("000000000000000000000000000001.5")
def test_numbers_are_correctly_rounded(text):
    """Every decimal number is read to the last bit as Python reads it."""
    values = scan_numbers(f"{text} 1\n".encode(), 0, (1, 2))
    assert values is not None
    assert values[0, 0].hex() == float(text).hex()
    assert values[0, 1] == 1


@given(word=st.text("0123456789+-.eE,xnai_#", min_size=1, max_size=8))
def test_fast_and_slow_path_agree_on_what_a_number_is(word):
    """The scanner refuses exactly the words that the fault finder names."""
    values = scan_numbers(f"1 {word}\n".encode(), 0, (1, 2))
    assert (values is None) == (parse_number(word) is None)


@given(
    rows=st.integers(1, 5),
    columns=st.integers(1, 5),
    lengths=st.lists(st.integers(0, 6), max_size=7),
    end=st.sampled_from(["\n", "\r\n", "\r"]),
)
def test_every_wrong_shape_is_described(rows, columns, lengths, end):
    """Text has the announced shape, or an error says where it has not."""
    text = end.join(" ".join(["1.5"] * length) for length in lengths)
    if [length for length in lengths if length] == [columns] * rows:
        values = read_number_rows("f", text.encode(), 0, 7, (rows, columns), "Frames:")
        np.testing.assert_array_equal(values, np.full((rows, columns), 1.5))
    else:
        with pytest.raises(MotionFormatError) as caught:
            read_number_rows("f", text.encode(), 0, 7, (rows, columns), "Frames:")
        assert 7 <= caught.value.line <= 7 + max(len(lengths), 1)


def test_agrees_with_loadtxt_on_real_rows(real_mocap):
    """The rows of a real clip are those that numpy reads."""
    data = (real_mocap / "bvh" / "05_10.bvh").read_bytes()
    start = data.index(b"\n", data.index(b"Frame Time")) + 1
    expected = np.loadtxt(data[start:].decode().splitlines())
    values = scan_numbers(data, start, expected.shape)
    np.testing.assert_array_equal(values, expected)
