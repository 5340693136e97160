"""Ratings while a participant gives them: stored at once, changed until an item is done.

Motions that are shown together are judged against each other, so a participant may change a
rating as long as the item is on the screen. Each change is on the disk before the call
returns; when the participant goes on, the item's ratings are settled.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from workbench.errors import DataError
from workbench.study.answers import Stimulus, check_position, check_rating
from workbench.study.database import check_participant, stimulus_of
from workbench.study.study_file import check_schema, transaction


class RatingChangedError(DataError):
    """A rating is another one than the participant saw, as when two pages are open."""


@dataclass(frozen=True)
class Given:
    """A rating that a participant has given.

    Attributes
    ----------
    rating : int
        From 1 to 10.
    settled : bool
        Whether it can no longer be changed.
    """

    rating: int
    settled: bool


def rate(
    path: str | Path, participant: int, stimulus: Stimulus, rating: int, position: int = 0
) -> None:
    """Store a rating, or change one that is not settled; when this returns, it is on the disk.

    The same rating once more changes nothing, so that a page which was reloaded before it
    heard of its arrival may send it again.

    Parameters
    ----------
    path : path-like
        A study.
    participant : int
        Number from :func:`workbench.study.database.enrol_participant`.
    stimulus : Stimulus
        One of the study's; its names are what counts.
    rating : int
        From 1 to 10.
    position : int
        Place in the order that this participant sees, from 1; 0: not told.

    Raises
    ------
    DataError
        If the file is no study or cannot be written, the participant or the stimulus is
        unknown to it, the rating is out of range, or a different one is settled.
    WorkbenchError
        If the participant is no number.
    """
    path = Path(path)
    rating, position = check_rating(rating), check_position(position)
    with transaction(path) as database:
        row = participant, stimulus_of(database, path, participant, stimulus)
        settled = database.execute(
            "SELECT rating FROM answers WHERE participant = ? AND stimulus_id = ? AND settled",
            row,
        ).fetchone()
        if settled is not None and settled[0] != rating:
            raise DataError(
                f"{path}: participant {participant} has settled on {settled[0]} for "
                f"{' / '.join(stimulus.key)}, got {rating}"
            )
        if settled is None:
            database.execute(
                "INSERT INTO answers VALUES (?, ?, ?, ?, 0) "
                "ON CONFLICT DO UPDATE SET rating = excluded.rating, position = excluded.position",
                (*row, rating, position),
            )


def settle(path: str | Path, participant: int, ratings: Mapping[Stimulus, int]) -> None:
    """Keep a participant's ratings of an item as they are, all of them or none.

    Parameters
    ----------
    path : path-like
        A study.
    participant : int
        Number from :func:`workbench.study.database.enrol_participant`.
    ratings : mapping of Stimulus to int
        What the participant sees of the item and agrees to.

    Raises
    ------
    RatingChangedError
        If something else is stored.
    DataError
        If the file is no study or cannot be written, the participant or a stimulus is unknown
        to it, or one is not rated.
    WorkbenchError
        If the participant is no number.
    """
    path = Path(path)
    with transaction(path) as database:
        for stimulus, seen in ratings.items():
            row = participant, stimulus_of(database, path, participant, stimulus)
            stored = database.execute(
                "SELECT rating FROM answers WHERE participant = ? AND stimulus_id = ?", row
            ).fetchone()
            about = f"{path}: participant {participant} has"
            if stored is None:
                raise DataError(f"{about} not rated {' / '.join(stimulus.key)}")
            if stored[0] != seen:
                raise RatingChangedError(
                    f"{about} rated {' / '.join(stimulus.key)} with {stored[0]}, but sees {seen}"
                )
            database.execute(
                "UPDATE answers SET settled = 1 WHERE participant = ? AND stimulus_id = ?", row
            )


def ratings_given(path: str | Path, participant: int) -> dict[tuple[str, str, str], Given]:
    """Read what a participant has rated so far, by the stimuli's keys.

    Raises
    ------
    DataError
        If the file is no study, or the participant is unknown to it.
    WorkbenchError
        If the participant is no number.
    """
    path = Path(path)
    with transaction(path, begin="BEGIN") as database:
        check_schema(database, path)
        check_participant(database, path, participant)
        rows = database.execute(
            "SELECT test_case, motion, stimulus, rating, settled FROM answers "
            "JOIN stimuli ON stimuli.id = stimulus_id WHERE participant = ?",
            (participant,),
        ).fetchall()
    return {
        (case, motion, name): Given(rating, bool(done)) for case, motion, name, rating, done in rows
    }


def participants(path: str | Path) -> dict[int, int]:
    """Count the settled ratings of each participant who was enrolled.

    Raises
    ------
    DataError
        If the file is no study.
    """
    path = Path(path)
    with transaction(path, begin="BEGIN") as database:
        check_schema(database, path)
        rows = database.execute(
            "SELECT number, coalesce(sum(settled), 0) FROM participants "
            "LEFT JOIN answers ON participant = number GROUP BY number ORDER BY number"
        ).fetchall()
    return dict(rows)
