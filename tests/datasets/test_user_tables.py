"""A user's own tables: what is read, how it is treated, what is refused."""

from __future__ import annotations

import io
from decimal import Decimal
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.datasets import read_table
from workbench.datasets.delimited import detect_layout
from workbench.datasets.treatment import MISSING, table_from_frame
from workbench.errors import DataError

EXPECTED = [[1, 2.5], [3, 4], [5, 6.25]]


def written(folder: Path, content: str | bytes, name: str = "mine.csv") -> Path:
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize(
    ("content", "columns"),
    [
        pytest.param("a,b\n1,2.5\n3,4\n5,6.25\n", ("a", "b"), id="commas"),
        pytest.param("a;b\n1;2.5\n3;4\n5;6.25\n", ("a", "b"), id="semicolons"),
        pytest.param("a;b\n1;2,5\n3;4\n5;6,25\n", ("a", "b"), id="decimal commas"),
        pytest.param('a,b\n1,"2,5"\n3,4\n5,"6,25"\n', ("a", "b"), id="quoted decimal commas"),
        pytest.param("a\tb\n1\t2.5\n3\t4\n5\t6.25\n", ("a", "b"), id="tabs"),
        pytest.param("a|b\n1|2.5\n3|4\n5|6.25\n", ("a", "b"), id="bars"),
        pytest.param("  a  b\n  1 2.5\n  3   4\n  5 6.25\n", ("a", "b"), id="blanks"),
        pytest.param("a, b\n1, 2.5\n3, 4\n5, 6.25\n", ("a", "b"), id="comma and blank"),
        pytest.param('"a, b","c"\n"1","2.5"\n"3","4"\n"5","6.25"\n', ("a, b", "c"), id="quotes"),
        pytest.param("1,2.5\n3,4\n5,6.25\n", ("column 1", "column 2"), id="no header"),
        pytest.param("1 25e-1\n3 4\n5 6.25", ("column 1", "column 2"), id="exponent"),
        pytest.param("# a b\n1 2.5\n3 4\n5 6.25\n", ("a", "b"), id="commented header"),
        pytest.param("# by me\n# a, 2020\na,b\n1,2.5\n3,4\n5,6.25\n", ("a", "b"), id="comments"),
        pytest.param("a,b\r\n1,2.5\r\n\r\n3,4\r\n5,6.25\r\n", ("a", "b"), id="CRLF, blank line"),
        pytest.param("größe,b\n1,2.5\n3,4\n5,6.25\n".encode("utf-16"), ("größe", "b"), id="UTF-16"),
        pytest.param("größe,b\n1,2.5\n3,4\n5,6.25\n".encode("latin-1"), ("größe", "b"), id="L1"),
        pytest.param("a,a\n1,2.5\n3,4\n5,6.25\n", ("a", "a.1"), id="name used twice"),
    ],
)
def test_reads_delimited_text(
    content: str | bytes, columns: tuple[str, ...], tmp_path: Path
) -> None:
    """The same table is read however the file writes it."""
    table = read_table(written(tmp_path, content))
    np.testing.assert_array_equal(table.values, EXPECTED)
    assert table.columns == columns
    assert table.name == "mine.csv"


def test_row_names_of_r_are_left_out(tmp_path: Path) -> None:
    """Row names, above which R writes no column name, are recognised and said."""
    table = read_table(written(tmp_path, "a b\nr1 1 2.5\nr2 3 4\nr3 5 6.25\n"))
    np.testing.assert_array_equal(table.values, EXPECTED)
    assert table.columns == ("a", "b")
    assert any("row name" in note for note in table.notes)


def test_row_numbers_of_pandas_are_left_out(tmp_path: Path) -> None:
    """The row numbers that pandas writes are no feature; an unnamed measurement is."""
    frame = pd.DataFrame(EXPECTED, columns=["a", "b"])
    table = read_table(written(tmp_path, frame.to_csv()))
    np.testing.assert_array_equal(table.values, EXPECTED)
    assert any("counts the rows" in note for note in table.notes)
    kept = read_table(written(tmp_path, ",a\n7,1\n5,2\n9,3\n"))
    np.testing.assert_array_equal(kept.values, [[7, 1], [5, 2], [9, 3]])


@settings(max_examples=40, deadline=None)
@given(
    values=st.lists(
        st.tuples(*[st.floats(-1e9, 1e9, allow_nan=False)] * 3), min_size=3, max_size=12
    ),
    delimiter=st.sampled_from([",", ";", "\t", "|", " "]),
    header=st.booleans(),
)
def test_reads_what_pandas_writes(
    values: list[tuple[float, ...]],
    delimiter: str,
    header: bool,
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    """Numbers written by pandas come back to the bit, whatever the delimiter."""
    frame = pd.DataFrame(values, columns=["x", "y", "z"])
    text = io.StringIO()
    frame.to_csv(text, sep=delimiter, header=header, index=False)
    path = written(tmp_path_factory.mktemp("written"), text.getvalue())
    np.testing.assert_array_equal(read_table(path).values, frame.to_numpy())


@pytest.mark.parametrize(
    ("content", "values", "note"),
    [
        pytest.param(
            "a,who,b\n1,x,2\n3,y,4\n5,x,6\n",
            [[1, 2], [3, 4], [5, 6]],
            r"left out column 'who' \(row 1 holds 'x'\)",
            id="text column",
        ),
        pytest.param(
            "a,b,c\n1,2,3\n3,4,oops\n5,6,7\n",
            [[1, 2], [3, 4], [5, 6]],
            r"left out column 'c' \(row 2 holds 'oops'\)",
            id="one bad cell",
        ),
        pytest.param(
            "t,a,b\n2020-01-01,1,2\n2020-01-02,3,4\n2020-01-03,5,6\n",
            [[1, 2], [3, 4], [5, 6]],
            "left out column 't'",
            id="dates",
        ),
        pytest.param(
            "a,b,c\n1,2,\n3,4,NA\n5,6,\n",
            [[1, 2], [3, 4], [5, 6]],
            r"left out column 'c' \(holds no values\)",
            id="column without values",
        ),
        pytest.param(
            "a,b\n1,2\n,3\nNA,4\n5,6\n7,?\n8,9\n",
            [[1, 2], [5, 6], [8, 9]],
            "dropped 3 of 6 rows, which have missing values",
            id="missing values",
        ),
        pytest.param(
            "a,b,c\n1,2,3\n3,4\n5,6,7\n8,9,1\n",
            [[1, 2, 3], [5, 6, 7], [8, 9, 1]],
            "dropped 1 of 4 rows",
            id="short row",
        ),
        pytest.param(
            "a,b\n1,2\n1,4\n1,6\n",
            [[1, 2], [1, 4], [1, 6]],
            "kept constant column 'a'",
            id="constant column",
        ),
        pytest.param(
            "a,b\n1,2\n3,4\n1,2\n1,2\n",
            [[1, 2], [3, 4], [1, 2], [1, 2]],
            "kept 2 rows that repeat another",
            id="duplicate rows",
        ),
        pytest.param(
            "a,b\n1,True\n3,false\n5,TRUE\n",
            [[1, 1], [3, 0], [5, 1]],
            "truth values of column 'b' became 0 and 1",
            id="truth values",
        ),
        pytest.param(
            "1,2\n3,4\n5,6\n",
            [[1, 2], [3, 4], [5, 6]],
            "no line of column names",
            id="no header",
        ),
    ],
)
def test_treatments_are_stated(
    content: str, values: list[list[float]], note: str, tmp_path: Path
) -> None:
    """Each treatment does what its note says."""
    table = read_table(written(tmp_path, content))
    np.testing.assert_array_equal(table.values, values)
    assert pd.Series(table.notes).str.contains(note).any(), table.notes


@pytest.mark.parametrize("text", sorted(MISSING), ids=repr)
def test_a_missing_value_is_neither_a_name_nor_a_number(text: str, tmp_path: Path) -> None:
    """However it is spelt, in the first line it begins no column names, and its row is dropped."""
    table = read_table(written(tmp_path, f"7,{text.upper()}\n1,2\n3,4\n5,7\n"))
    np.testing.assert_array_equal(table.values, [[1, 2], [3, 4], [5, 7]])
    assert table.columns == ("column 1", "column 2")
    assert "dropped 1 of 4 rows, which have missing values" in table.notes


def test_a_clean_table_needs_no_notes(tmp_path: Path) -> None:
    """Nothing is said where nothing was done."""
    assert read_table(written(tmp_path, "a,b\n1,2\n3,4\n5,7\n")).notes == ()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        pytest.param("", "the file is empty", id="empty"),
        pytest.param("a,b\n", "found no rows", id="header only"),
        pytest.param("a,b\n1,2\n", "got 1 row, want at least 3", id="one row"),
        pytest.param("a,b\n1,2\n,3\n5,\n", "dropped 2 of 3 rows.*at least 3", id="few complete"),
        pytest.param(
            "a,b\n1,\n,3\n,\n2,\n", "every row has a missing value.*'b'", id="none complete"
        ),
        pytest.param("a\n1\n2\n3\n", "found 1 column of numbers, want at least 2", id="one column"),
        pytest.param("a,b\nx,y\nz,w\nq,r\n", "found no columns of numbers.*'a'", id="text"),
        pytest.param("a,b\n1,2\ninf,3\n5,6\n", "found inf in row 2 of column 'a'", id="infinity"),
        pytest.param("a,b\n1,2\n1e400,3\n5,6\n", "found inf in row 2 of column 'a'", id="overflow"),
        pytest.param(
            "a,b\n1,2\n3,-1e200\n5,6\n", r"found -1e\+200 in row 2 of column 'b'", id="huge"
        ),
        pytest.param("a,b\n1,2\n\n3,4,5\n6,7\n", "in line 4, saw 3", id="long row"),
        pytest.param('a,b\n"1,2\n3,4\n5,6\n', "EOF inside string", id="open quote"),
        pytest.param(bytes(range(256)), "not text", id="binary"),
        pytest.param(
            b"PK\x03\x04...", "spreadsheet or an archive; save the table as CSV", id="xlsx"
        ),
        pytest.param(b"\x1f\x8b...", "compressed; unpack it first", id="gzip"),
        pytest.param(b"PAR1 and no more", "not a readable Parquet file", id="broken Parquet"),
        pytest.param("HIERARCHY\nROOT Hips\n{\n", "looks like a BVH motion", id="BVH"),
        pytest.param(
            "<html><body>404, not found</body>\n</html>\n", "columns of numbers|rows", id="web"
        ),
    ],
)
def test_refusals_are_one_line(content: str | bytes, message: str, tmp_path: Path) -> None:
    """What cannot become a table is refused in one line that says where and why."""
    with pytest.raises(DataError, match=message) as error:
        read_table(written(tmp_path, content))
    assert "\n" not in str(error.value)


def test_refuses_what_is_no_file(tmp_path: Path) -> None:
    """A folder, a missing file and text called Parquet are refused."""
    with pytest.raises(DataError, match="is a folder"):
        read_table(tmp_path)
    with pytest.raises(DataError, match="cannot be read"):
        read_table(tmp_path / "absent.csv")
    with pytest.raises(DataError, match="is not a Parquet file"):
        read_table(written(tmp_path, "a,b\n1,2\n", "text.parquet"))


def test_a_wide_table_is_read(tmp_path: Path) -> None:
    """Many more columns than rows are no problem."""
    values = np.random.default_rng(0).normal(size=(5, 3000))
    text = "\n".join(",".join(map(repr, row)) for row in values.tolist())
    np.testing.assert_array_equal(read_table(written(tmp_path, text)).values, values)


LABELLED = "kind,a,b\nx,1,2\ny,3,4\nx,5,6\n"


def test_label_column_gives_the_classes(tmp_path: Path) -> None:
    """The label column is the class of each row and no feature, even if it is a number."""
    table = read_table(written(tmp_path, LABELLED), label="kind")
    assert table.class_counts == {"x": 2, "y": 1}
    assert table.columns == ("a", "b")
    assert table.label_name == "kind"
    numeric = read_table(written(tmp_path, "a,b,n\n1,2,1\n3,4,2\n5,6,1\n"), label="n")
    assert numeric.class_counts == {"1": 2, "2": 1}
    assert numeric.columns == ("a", "b")


def test_unknown_label_lists_the_columns(tmp_path: Path) -> None:
    """A label column that is not there is refused with the columns that are, and a guess."""
    with pytest.raises(
        DataError, match=r"no column 'kinds' among columns kind, a, b; did you mean"
    ):
        read_table(written(tmp_path, LABELLED), label="kinds")


def test_rows_without_label_are_kept(tmp_path: Path) -> None:
    """A row without a class is still a sample."""
    table = read_table(written(tmp_path, "kind,a,b\nx,1,2\n,3,4\nx,5,6\n"), label="kind")
    assert table.class_counts == {"(missing)": 1, "x": 2}
    assert any("without a label" in note for note in table.notes)


def test_labels_follow_their_rows_when_some_are_dropped(tmp_path: Path) -> None:
    """Dropping a row drops its label."""
    content = "kind,a,b\np,1,0\nq,,1\nr,3,2\ns,4,3\n"
    table = read_table(written(tmp_path, content), label="kind")
    assert table.labels is not None
    assert table.labels.tolist() == ["p", "r", "s"]


def test_parquet_is_told_by_content(tmp_path: Path) -> None:
    """Parquet is read with every kind of column treated, whatever the file is called."""
    frame = pd.DataFrame(
        {
            "whole": [1, 2, 3],
            "nullable": pd.array([1, 2, 3], dtype="Int8"),
            "truth": [True, False, True],
            "decimal": [Decimal("1.5"), Decimal("2"), Decimal("3")],
            "day": pd.date_range("2020", periods=3),
            "span": pd.to_timedelta([1, 2, 3], unit="s"),
            "list": [[1], [2], [3]],
            "category": pd.Categorical(["4", "5", "6"]),
            "who": ["x", "y", None],
        }
    )
    frame.to_parquet(tmp_path / "some.csv")
    table = read_table(tmp_path / "some.csv", label="who")
    assert table.columns == ("whole", "nullable", "truth", "decimal", "category")
    first = table.values[0]  # noqa: PD011  # a Table, not a data frame
    np.testing.assert_array_equal(first, [1, 1, 1, 1.5, 4])
    note = next(note for note in table.notes if "left out" in note)
    assert all(repr(name) in note for name in ("day", "span", "list"))
    assert table.class_counts == {"(missing)": 1, "x": 1, "y": 1}


def test_arff_is_read_with_its_names(tmp_path: Path) -> None:
    """A user's ARFF gives its attributes as columns, the nominal one as label."""
    content = "@relation r\n@attribute x real\n@attribute y real\n@attribute c {p,q}\n@data\n"
    path = written(tmp_path, content + "1,2,p\n3,4,q\n5,?,p\n7,8,p\n", "mine.arff")
    table = read_table(path, label="c")
    np.testing.assert_array_equal(table.values, [[1, 2], [3, 4], [7, 8]])
    assert table.class_counts == {"p": 2, "q": 1}


def test_integers_with_a_gap_keep_their_label_names() -> None:
    """A class that a gap turned into a float in pandas is still called 1."""
    frame = pd.DataFrame({"x": [1, 2, 3], "y": [1, 2, 4], "c": [1.0, np.nan, 2.0]})
    assert table_from_frame(frame, "mine", "c").class_counts == {"(missing)": 1, "1": 1, "2": 1}


def test_column_names_used_twice_in_a_frame_keep_both() -> None:
    """Two columns of one name are two features."""
    frame = pd.DataFrame([[1, 2], [3, 4], [5, 6]], columns=["a", "a"])
    np.testing.assert_array_equal(table_from_frame(frame, "mine").values, frame.to_numpy())
    with pytest.raises(DataError, match="2 columns are called 'a'"):
        table_from_frame(frame, "mine", "a")


@pytest.mark.parametrize(
    ("lines", "delimiter"),
    [
        pytest.param(["1,5;2,5", "3,5;4,5"], ";", id="decimal commas are no delimiters"),
        pytest.param(["x y;1", "z w;2"], ";", id="blanks in a text field"),
        pytest.param(["15.2,\t14.8", "14.8,\t14.5"], ",", id="comma before tab"),
        pytest.param(["2020-01-01 12:00,5", "2020-01-02 12:30,6"], ",", id="time with a blank"),
    ],
)
def test_delimiter_is_what_makes_numbers(lines: list[str], delimiter: str) -> None:
    """Where several characters could part the fields, that which gives numbers does."""
    assert detect_layout(lines).delimiter == delimiter
