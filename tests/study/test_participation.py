"""Ratings are stored as they are given, and can be changed until their item is done."""

from __future__ import annotations

from pathlib import Path

import pytest

from workbench.errors import DataError
from workbench.study.answers import Stimulus
from workbench.study.database import append_answer, create_study, enrol_participant, read_study
from workbench.study.participation import Given, participants, rate, ratings_given, settle

PAIR = [Stimulus("methods", "walk", name) for name in ("original", "uniform")]


@pytest.fixture
def study(tmp_path: Path) -> Path:
    path = tmp_path / "study.sqlite"
    create_study(path, PAIR)
    enrol_participant(path)
    return path


def test_a_rating_may_be_changed_until_it_is_settled(study: Path) -> None:
    """The last one counts; afterwards the same one changes nothing and another is refused."""
    rate(study, 1, PAIR[0], 4, 1)
    rate(study, 1, PAIR[0], 9, 1)
    rate(study, 1, PAIR[1], 5, 2)
    assert ratings_given(study, 1)[PAIR[0].key] == Given(9, settled=False)
    settle(study, 1, PAIR)
    rate(study, 1, PAIR[0], 9, 1)
    with pytest.raises(DataError, match=r"has settled on 9 for methods / walk / original, got 3"):
        rate(study, 1, PAIR[0], 3, 1)
    assert ratings_given(study, 1) == {
        PAIR[0].key: Given(9, settled=True),
        PAIR[1].key: Given(5, settled=True),
    }
    assert read_study(study)[["rating", "position"]].values.tolist() == [[9, 1], [5, 2]]


def test_an_item_is_settled_as_a_whole_or_not_at_all(study: Path) -> None:
    """As long as one rating is missing, the others can still be changed."""
    rate(study, 1, PAIR[0], 4)
    with pytest.raises(DataError, match="has not rated methods / walk / uniform"):
        settle(study, 1, PAIR)
    assert ratings_given(study, 1) == {PAIR[0].key: Given(4, settled=False)}


def test_an_unsettled_rating_is_an_answer_too(study: Path) -> None:
    """Who leaves in the middle of an item has still given it."""
    rate(study, 1, PAIR[0], 4, 1)
    assert read_study(study)["rating"].tolist() == [4]


def test_participants_are_counted_with_what_they_settled(study: Path) -> None:
    """Who enrolled and gave nothing is there as well."""
    enrol_participant(study)
    append_answer(study, 2, PAIR[0], 7)
    rate(study, 2, PAIR[1], 7)
    assert participants(study) == {1: 0, 2: 1}


@pytest.mark.parametrize(
    ("participant", "stimulus", "rating", "message"),
    [
        (9, PAIR[0], 5, "has no participant 9"),
        (1, Stimulus("methods", "walk", "none"), 5, "has no stimulus"),
        (1, PAIR[0], 11, "rating: got 11"),
    ],
    ids=["unknown participant", "unknown stimulus", "too high"],
)
def test_a_wrong_rating_is_not_stored(
    study: Path, participant: int, stimulus: Stimulus, rating: int, message: str
) -> None:
    """The refusal says what is wrong and leaves the file as it was."""
    before = study.read_bytes()
    with pytest.raises(DataError, match=message):
        rate(study, participant, stimulus, rating)
    assert study.read_bytes() == before
    with pytest.raises(DataError, match="has no participant 9"):
        ratings_given(study, 9)
