"""Answers are read from CSV, Parquet and SQLite alike, and refused in one line."""

from __future__ import annotations

import pandas as pd
import pytest

from workbench.errors import DataError
from workbench.study.answers import Stimulus, check_answers
from workbench.study.database import create_study, enrol_participant
from workbench.study.participation import rate
from workbench.study.reading import read_answers, write_csv

HEAD = "participant,test_case,motion,stimulus,rating"


@pytest.fixture
def answers():
    rows = [
        (1, "methods", "walking", "original", 9, 1, "{}"),
        (1, "methods", "walking", "saliency, k = 7", 7, 2, '{"clip": "cmu/02_01", "k": 7}'),
        (2, "methods", "walking", "original", 10, 2, "{}"),
    ]
    columns = [*HEAD.split(","), "position", "parameters"]
    return check_answers(pd.DataFrame(rows, columns=columns))


def test_csv_reads_back_identically(answers, tmp_path):
    """Export and reading are inverse, quotes and commas included."""
    write_csv(answers, tmp_path / "study.csv")
    pd.testing.assert_frame_equal(read_answers(tmp_path / "study.csv"), answers)


def test_parquet_reads_back_identically(answers, tmp_path):
    """A Parquet file is known by its content, not by its ending."""
    answers.to_parquet(tmp_path / "study.data")
    pd.testing.assert_frame_equal(read_answers(tmp_path / "study.data"), answers)


def test_a_study_reads_as_its_export_does(answers, tmp_path):
    """The three formats hold the same answers."""
    path = tmp_path / "study.sqlite"
    shown = [
        Stimulus("methods", "walking", "original"),
        Stimulus("methods", "walking", "saliency, k = 7", {"k": 7, "clip": "cmu/02_01"}),
    ]
    create_study(path, shown)
    for person, index, rating, position in ((1, 0, 9, 1), (1, 1, 7, 2), (2, 0, 10, 2)):
        if position == 1 or person == 2:
            assert enrol_participant(path) == person
        rate(path, person, shown[index], rating, position)
    pd.testing.assert_frame_equal(read_answers(path), answers)


@pytest.mark.parametrize("delimiter", [",", ";", "\t"], ids=["comma", "semicolon", "tab"])
def test_delimiters_are_told_apart(delimiter, tmp_path):
    """Spreadsheets of other countries export semicolons, a byte order mark and CRLF."""
    text = f"\ufeff{HEAD}\r\n\r\nA,1,walking,original,10\r\n".replace(",", delimiter)
    (tmp_path / "study.csv").write_text(text, encoding="utf-8", newline="")
    assert read_answers(tmp_path / "study.csv").iloc[0].tolist()[:5] == [
        *("A", "1", "walking", "original"),
        10,
    ]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "is empty, want a file of answers"),
        (b"\xff\xfe\x00", "is no SQLite, Parquet or UTF-8 text file of answers"),
        (b"PAR1 and no more", "is not a readable Parquet file"),
        (b"SQLite format 3\0 and no more", "is no study, or damaged"),
        (b"a,b\n1,2\n", "found no column participant, test_case, motion, stimulus, rating, want"),
        (f"{HEAD}\n".encode(), "found no answer"),
        (f"{HEAD},rating\n".encode(), "line 1: found two equal column names"),
        (f"{HEAD}\n\n1,a,b,c\n".encode(), "line 3: found 4 fields, want 5"),
        (f'{HEAD}\n1,a,"b,c,9\n'.encode(), "line 2: is no CSV"),
        (
            f"{HEAD}\n1,a,b,c,9\n\n2,a,b,c,12\n".encode(),
            "line 4: rating: got '12', want a whole number from 1 to 10",
        ),
    ],
    ids=[
        *("empty", "binary", "cut Parquet", "cut SQLite", "other columns", "no rows"),
        *("doubled column", "short row", "open quote", "wrong rating"),
    ],
)
def test_a_wrong_file_is_refused_in_one_line(content, message, tmp_path):
    """The message names the file, the line and what is wanted."""
    path = tmp_path / "study.csv"
    path.write_bytes(content)
    with pytest.raises(DataError) as caught:
        read_answers(path)
    assert str(caught.value).startswith(str(path))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_missing_file_or_a_folder_is_refused(tmp_path):
    """So is the name of what is no file at all."""
    with pytest.raises(DataError, match="there is no such file"):
        read_answers(tmp_path / "none.csv")
    with pytest.raises(DataError, match="is a folder"):
        read_answers(tmp_path)


def test_an_export_that_cannot_be_written_is_refused(answers, tmp_path):
    """A folder in place of the file is an error in one line."""
    with pytest.raises(DataError, match="cannot be written"):
        write_csv(answers, tmp_path)
