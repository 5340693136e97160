"""Readers of the published formats."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from workbench.datasets import formats
from workbench.errors import DataError


def written(folder: Path, content: str | bytes) -> Path:
    path = folder / "some.data"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize(
    "content",
    [
        pytest.param("1,2.5,a\n3,-4e1,b\n", id="commas"),
        pytest.param("1,\t2.5,\ta\n3,\t-4e1,\tb\n", id="comma and tab"),
        pytest.param("1\t\t2.5\ta\n3\t-4e1\tb\n", id="tabs, some doubled"),
        pytest.param("  1   2.5 a\n\n  3 -4e1 b", id="blanks, no line end"),
        pytest.param("1;2.5;a\r\n3;-4e1;b\r\n", id="semicolons, CRLF"),
        pytest.param("x,y,kind\n1,2.5,a\n3,-4e1,b\n", id="header"),
        pytest.param("1,2,class\n1,2.5,a\n3,-4e1,b\n", id="header of numbers"),
        pytest.param(b"\xef\xbb\xbf1,2.5,a\n3,-4e1,b\n", id="byte order mark"),
    ],
)
def test_reads_labelled_rows_however_delimited(content: str | bytes, tmp_path: Path) -> None:
    """The same rows are read whatever parts their fields, below a header or not."""
    rows = formats.read_labelled(written(tmp_path, content))
    np.testing.assert_array_equal(rows.values, [[1, 2.5], [3, -40]])
    assert rows.codes == ("a", "b")


def test_reads_scikit_learns_format(tmp_path: Path) -> None:
    """The first line announces the counts."""
    rows = formats.read_counted(written(tmp_path, "2,2,no,yes\n1,2,0\n3,4,1\n"))
    np.testing.assert_array_equal(rows.values, [[1, 2], [3, 4]])
    assert rows.codes == ("0", "1")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        pytest.param("3,2,no,yes\n1,2,0\n3,4,1\n", "2 rows of 2 numbers, expected 3", id="row"),
        pytest.param("a,b,c\n1,2,0\n", "expected the numbers of rows and columns", id="header"),
        pytest.param("2,2,no,yes\n1,2,0\n3,4\n", "line 3: found 2 fields, expected 3", id="short"),
        pytest.param("1,2,no\n1,x,0\n", "line 2: found 'x', expected a number", id="text"),
        pytest.param("1,2,no\n1,nan,0\n", "found 'nan', expected a number", id="nan"),
        pytest.param("1,2,no\n", "no rows", id="nothing below"),
    ],
)
def test_refuses_a_damaged_scikit_learn_file(content: str, message: str, tmp_path: Path) -> None:
    """What breaks the announcement is refused with its line."""
    with pytest.raises(DataError, match=message):
        formats.read_counted(written(tmp_path, content))


def test_reads_named_rows(tmp_path: Path) -> None:
    """The sample's name at the start is no number and no class."""
    rows = formats.read_named(written(tmp_path, "ADT1_YEAST  0.5  0.25  MIT\nZUO1 1 2 NUC\n"))
    np.testing.assert_array_equal(rows.values, [[0.5, 0.25], [1, 2]])
    assert rows.codes == ("MIT", "NUC")


ARFF = """% a comment
@RELATION 'two words'
@attribute 'first one' numeric
@attribute second REAL
@attribute class {a, b}
@data
% another
1,2,a

3, 4.5 ,b
"""


def test_reads_arff(tmp_path: Path) -> None:
    """Comments, quoted names, blanks and blank lines of ARFF are understood."""
    path = written(tmp_path, ARFF)
    names, _ = formats.read_arff(path)
    assert names == ["first one", "second", "class"]
    rows = formats.read_arff_rows(path)
    np.testing.assert_array_equal(rows.values, [[1, 2], [3, 4.5]])
    assert rows.codes == ("a", "b")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        pytest.param(ARFF + "{0 1, 2 b}\n", "line 11: found a sparse row", id="sparse"),
        pytest.param(ARFF + "1,2\n", "line 11: found 2 fields, expected 3", id="short row"),
        pytest.param(ARFF + "1,?,a\n", "line 11: found '\\?', expected a number", id="missing"),
        pytest.param("1,2,a\n", "expected an ARFF file", id="no header"),
    ],
)
def test_refuses_a_damaged_arff(content: str, message: str, tmp_path: Path) -> None:
    """A damaged ARFF is refused with its line."""
    with pytest.raises(DataError, match=message):
        formats.read_arff_rows(written(tmp_path, content))


def test_finds_the_first_cloud_table_in_prose(tmp_path: Path) -> None:
    """Of a file with prose and two tables of 1024 rows the first is read."""
    rng = np.random.default_rng(0)
    first, second = rng.normal(size=(2, 1024, 10)).round(4)
    text = [
        "Two tables of clouds, each of 1024 rows",
        "1 2 3 4 5 6 7 8 9 10",
        "the attributes are these",
        *(" ".join(map(str, row)) for row in first),
        "",
        "and the second",
        *(" ".join(map(str, row)) for row in second),
    ]
    rows = formats.read_cloud(written(tmp_path, "\n".join(text)))
    np.testing.assert_array_equal(rows.values, first)
    assert rows.codes is None


def test_cloud_without_rows_is_refused(tmp_path: Path) -> None:
    """Prose alone is refused."""
    with pytest.raises(DataError, match="no row of 10 numbers"):
        formats.read_cloud(written(tmp_path, "nothing here\n"))


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        pytest.param("größe\n".encode(), "größe\n", id="UTF-8"),
        pytest.param("größe\n".encode("utf-8-sig"), "größe\n", id="UTF-8 with mark"),
        pytest.param("größe\n".encode("utf-16"), "größe\n", id="UTF-16"),
        pytest.param("größe\n".encode("latin-1"), "größe\n", id="Latin-1"),
    ],
)
def test_reads_encodings(content: bytes, expected: str, tmp_path: Path) -> None:
    """Text is text in each of the usual encodings."""
    assert formats.read_text(written(tmp_path, content)) == expected


@pytest.mark.parametrize(
    ("content", "message"),
    [
        pytest.param(b"", "empty", id="empty"),
        pytest.param(b" \n\t\n", "empty", id="only blanks"),
        pytest.param(b"1,2\0,3", "not text", id="NUL"),
        pytest.param(b"\xff\xfea", "not text", id="broken UTF-16"),
    ],
)
def test_refuses_what_is_no_text(content: bytes, message: str, tmp_path: Path) -> None:
    """Empty and binary files are refused."""
    with pytest.raises(DataError, match=message):
        formats.read_text(written(tmp_path, content))


def test_missing_file_is_a_data_error(tmp_path: Path) -> None:
    """A file that is not there is a DataError."""
    with pytest.raises(DataError, match="cannot be read"):
        formats.read_text(tmp_path / "absent")
