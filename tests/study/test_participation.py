"""Ratings are stored as they are given, and can be changed until their item is done."""

from __future__ import annotations

from pathlib import Path

import pytest

from workbench.errors import DataError, WorkbenchError
from workbench.study.answers import Stimulus
from workbench.study.database import create_study, enrol_participant, read_study
from workbench.study.participation import (
    Given,
    RatingChangedError,
    participants,
    rate,
    ratings_given,
    settle,
)

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
    settle(study, 1, {PAIR[0]: 9, PAIR[1]: 5})
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
        settle(study, 1, dict.fromkeys(PAIR, 4))
    assert ratings_given(study, 1) == {PAIR[0].key: Given(4, settled=False)}


def test_only_what_the_participant_saw_is_settled(study: Path) -> None:
    """A rating that another page has changed meanwhile is not kept unseen, nor are the others."""
    for stimulus, rating in zip(PAIR, (4, 6), strict=True):
        rate(study, 1, stimulus, rating)
    with pytest.raises(RatingChangedError, match=r"rated methods / walk / uniform with 6.*sees 5"):
        settle(study, 1, {PAIR[0]: 4, PAIR[1]: 5})
    assert participants(study) == {1: 0}
    settle(study, 1, {PAIR[0]: 4, PAIR[1]: 6})
    assert participants(study) == {1: 2}


def test_an_unsettled_rating_is_an_answer_too(study: Path) -> None:
    """Who leaves in the middle of an item has still given it."""
    rate(study, 1, PAIR[0], 4, 1)
    assert read_study(study)["rating"].tolist() == [4]


def test_participants_are_counted_with_what_they_settled(study: Path) -> None:
    """Who enrolled and gave nothing is there as well."""
    enrol_participant(study)
    for stimulus in PAIR:
        rate(study, 2, stimulus, 7)
    settle(study, 2, {PAIR[0]: 7})
    assert participants(study) == {1: 0, 2: 1}


@pytest.mark.parametrize(
    ("participant", "stimulus", "rating", "error", "message"),
    [
        (9, PAIR[0], 5, DataError, "has no participant 9"),
        ("1", PAIR[0], 5, WorkbenchError, "participant: got '1', want a whole number"),
        (1, Stimulus("methods", "walk", "none"), 5, DataError, "has no stimulus"),
        (1, PAIR[0], 11, DataError, "rating: got 11"),
        (1, PAIR[0], 0, DataError, "rating: got 0"),
    ],
    ids=["unknown participant", "no number", "unknown stimulus", "too high", "too low"],
)
def test_a_wrong_rating_is_not_stored(
    study: Path, participant: int, stimulus: Stimulus, rating: int, error: type, message: str
) -> None:
    """The refusal says what is wrong and leaves the file as it was."""
    before = study.read_bytes()
    with pytest.raises(error, match=message):
        rate(study, participant, stimulus, rating)
    assert study.read_bytes() == before
    with pytest.raises(DataError, match="has no participant 9"):
        ratings_given(study, 9)
