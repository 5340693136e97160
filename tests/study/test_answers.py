"""Answers are refused unless each is one rating of one stimulus by one participant."""

from __future__ import annotations

import pandas as pd
import pytest

from workbench.errors import DataError
from workbench.study.answers import (
    COLUMNS,
    REQUIRED_COLUMNS,
    Stimulus,
    check_answers,
    motions_of,
    ratings_of,
)


def table(*rows):
    return pd.DataFrame(rows, columns=list(COLUMNS))


GOOD = (1, "methods", "walking", "saliency", 7, 3, '{"count": 10}')


def test_columns_get_one_order_and_type():
    """Whatever columns come in whatever order, the answers come out alike."""
    frame = table(GOOD).iloc[:, ::-1].assign(age=23)
    assert check_answers(frame).to_dict("records") == [
        {
            "participant": "1",
            "test_case": "methods",
            "motion": "walking",
            "stimulus": "saliency",
            "rating": 7,
            "position": 3,
            "parameters": '{"count": 10}',
        }
    ]


def test_whole_numbers_may_be_stored_as_floats_and_places_be_missing():
    """Tables with gaps hold 7.0 and NaN where 7 and nothing are meant."""
    frame = table(GOOD, GOOD).astype({"participant": float, "rating": float, "position": float})
    frame.loc[1, ["participant", "position"]] = [2.0, float("nan")]
    frame["parameters"] = None
    checked = check_answers(frame)
    assert checked["participant"].tolist() == ["1", "2"]
    assert checked["position"].tolist() == [3, 0]
    assert checked["parameters"].tolist() == ["{}", "{}"]


@pytest.mark.parametrize(
    ("column", "value", "wanted"),
    [
        ("rating", 0, "rating: got 0, want a whole number from 1 to 10"),
        ("rating", 11, "got 11, want a whole number from 1 to 10"),
        ("rating", 7.5, "got 7.5, want a whole"),
        ("rating", float("nan"), "got nan, want a whole"),
        ("rating", True, "got True, want a whole"),
        ("rating", "seven", "got 'seven', want a whole"),
        ("participant", "", "participant: got '', want a word or a number"),
        ("motion", None, "motion: got None, want a word"),
        ("stimulus", float("nan"), "stimulus: got nan, want a word"),
        ("position", -1, "position: got -1, want a whole number from 1"),
        ("position", "last", "position: got 'last', want a whole number from 1"),
        ("parameters", "{", "parameters: got '{', want a JSON object"),
        ("parameters", "[1]", "want a JSON object"),
    ],
)
def test_a_wrong_value_is_named_with_its_row(column, value, wanted):
    """The message says where, what was found and what is wanted."""
    values = dict(zip(COLUMNS, (2, *GOOD[1:]), strict=True)) | {column: value}
    frame = pd.DataFrame([dict(zip(COLUMNS, GOOD, strict=True)), values], dtype=object)
    with pytest.raises(DataError) as caught:
        check_answers(frame, "study.csv")
    assert str(caught.value).startswith("study.csv, row 2: ")
    assert wanted in str(caught.value)


def test_whole_numbers_may_be_written_with_a_point():
    """Programs export a column of whole numbers with gaps as 7.0."""
    frame = table(GOOD).astype({"rating": object, "position": object})
    frame[["rating", "position"]] = "7.0", ""
    assert check_answers(frame)[["rating", "position"]].iloc[0].tolist() == [7, 0]


def test_two_answers_of_one_participant_are_refused():
    """A second rating of a stimulus would count one participant twice."""
    with pytest.raises(
        DataError, match=r"row 2: participant 1 has rated .*saliency before .*row 1"
    ):
        check_answers(table(GOOD, (*GOOD[:4], 8, 1, GOOD[6])))


def test_a_stimulus_is_the_same_for_all():
    """Ratings of stimuli that were made differently are not compared."""
    with pytest.raises(DataError, match=r"row 2: parameters: got other ones"):
        check_answers(table(GOOD, (2, *GOOD[1:6], '{"count": 11}')))


@pytest.mark.parametrize(
    ("frame", "message"),
    [
        (pd.DataFrame({"rating": [1]}), "no column participant, test_case, motion, stimulus"),
        (table(), "found no answer"),
        ([GOOD], "got list, want a DataFrame"),
        (table(GOOD)[["rating", *COLUMNS]], "two columns of one name"),
    ],
    ids=["missing columns", "no rows", "no table", "doubled column"],
)
def test_a_table_of_another_form_is_refused(frame, message):
    """What is no table of answers is not taken for one."""
    with pytest.raises(DataError, match=message):
        check_answers(frame)


def test_ratings_are_arranged_by_participant_and_stimulus():
    """Participants stand in numerical order, the original first, gaps are NaN."""
    rows = [
        (10, "methods", "walking", "saliency", 4),
        (10, "methods", "walking", "original", 9),
        (2, "methods", "walking", "original", 8),
        (2, "contacts", "walking", "original", 1),
    ]
    answers = check_answers(pd.DataFrame(rows, columns=list(REQUIRED_COLUMNS)))
    ratings = ratings_of(answers, "methods", "walking")
    assert ratings.index.tolist() == ["2", "10"]
    assert ratings.columns.tolist() == ["original", "saliency"]
    assert ratings.loc["10"].tolist() == [9, 4]
    assert ratings.isna().sum().sum() == 1
    assert motions_of(answers) == [("methods", "walking"), ("contacts", "walking")]
    with pytest.raises(DataError, match="methods / jumping: found no answer to it, have methods"):
        ratings_of(answers, "methods", "jumping")


def test_parameters_must_be_json():
    """What cannot be written down cannot be made again."""
    with pytest.raises(DataError, match="parameters that are no JSON"):
        _ = Stimulus("a", "b", "c", {"sigma": float("nan")}).parameters_text
