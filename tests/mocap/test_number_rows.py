"""Tests of the fast reader of number rows."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
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


@settings(deadline=None)  # the first call may compile
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


def _long_text(end="\n", n_rows=20_000):
    """Give more rows than one thread reads at once."""
    values = np.random.default_rng(0).integers(-9999, 9999, size=(n_rows, 3)) / 64
    return values, end.join(" ".join(map(repr, row)) for row in values.tolist()).encode()


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", "\n\n", " \n \n\t"], ids=repr)
def test_parts_of_a_long_file_join_without_a_seam(end):
    """However lines end, and with blank lines between them, all numbers arrive in order."""
    values, text = _long_text(end)
    np.testing.assert_array_equal(scan_numbers(text, 0, values.shape), values)


@pytest.mark.parametrize("row", [0, 5000, 19_999])
@pytest.mark.parametrize(
    ("fault", "expected"),
    [("1 2", "found 2 numbers"), ("1 2 3 4", "found 4 numbers"), ("1 x 3", "found 'x'")],
    ids=["short", "long", "word"],
)
def test_faults_of_a_long_file_are_found_where_they_are(row, fault, expected):
    """The error names the line in whichever part it is."""
    values, text = _long_text()
    lines = text.split(b"\n")
    lines[row] = fault.encode()
    with pytest.raises(MotionFormatError, match=expected) as caught:
        read_number_rows("f", b"\n".join(lines), 0, 0, values.shape, "Frames:")
    assert caught.value.line == row + 1


@pytest.mark.parametrize("change", [-1, 1], ids=["too-few", "too-many"])
def test_wrong_numbers_of_rows_of_a_long_file_are_refused(change):
    """A row more or less than announced is no motion of that length."""
    values, text = _long_text()
    with pytest.raises(MotionFormatError, match="rows"):
        read_number_rows("f", text, 0, 0, (len(values) + change, 3), "Frames:")


def test_hard_numbers_of_a_long_file_are_correctly_rounded():
    """One number that the fast path hands back does not keep the others from being read."""
    values, text = _long_text()
    lines = text.split(b"\n")
    lines[7] = b"123456789012345678901234567890 1e-320 3"
    found = scan_numbers(b"\n".join(lines), 0, values.shape)
    values[7] = [123456789012345678901234567890.0, 1e-320, 3]
    np.testing.assert_array_equal(found, values)


def test_agrees_with_loadtxt_on_real_rows(real_mocap):
    """The rows of a real clip are those that numpy reads."""
    data = (real_mocap / "bvh" / "05_10.bvh").read_bytes()
    start = data.index(b"\n", data.index(b"Frame Time")) + 1
    expected = np.loadtxt(data[start:].decode().splitlines())
    values = scan_numbers(data, start, expected.shape)
    np.testing.assert_array_equal(values, expected)
