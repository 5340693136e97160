"""A running study in one SQLite file: stimuli, participants and their answers.

Schema, version 1 (``PRAGMA user_version``; ``PRAGMA application_id`` is :data:`APPLICATION_ID`):

- ``stimuli(id, test_case, motion, stimulus, parameters)``: what is rated; ``parameters`` is a
  JSON object from which the stimulus can be made again; each test case, motion and stimulus
  once.
- ``participants(number)``: counted from 1. Nothing else is known of them.
- ``answers(participant, stimulus_id, rating, position)``: one row for each participant and
  stimulus; ``rating`` from 1 to 10, ``position`` the place in the order that this participant
  saw, from 1, or 0 where it is not told. Practice items are not stored.

Each answer is a transaction of its own that is on the disk before the call returns, so that a
killed process loses none; several processes may write at once.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from workbench.errors import DataError, WorkbenchError
from workbench.study.answers import (
    COLUMNS,
    HIGHEST_RATING,
    LOWEST_RATING,
    Stimulus,
    check_position,
    check_rating,
    check_rows,
)
from workbench.validation import whole_number

if TYPE_CHECKING:
    import pandas as pd

SQLITE_MAGIC = b"SQLite format 3\0"
SCHEMA_VERSION = 1
#: Tells a study from any other SQLite file.
APPLICATION_ID = int.from_bytes(b"WBst", "big")

#: How long a writer waits for another one.
_PATIENCE_SECONDS = 30.0

_SCHEMA = (
    """CREATE TABLE stimuli (
        id INTEGER PRIMARY KEY,
        test_case TEXT NOT NULL CHECK (test_case <> ''),
        motion TEXT NOT NULL CHECK (motion <> ''),
        stimulus TEXT NOT NULL CHECK (stimulus <> ''),
        parameters TEXT NOT NULL,
        UNIQUE (test_case, motion, stimulus)
    )""",
    "CREATE TABLE participants (number INTEGER PRIMARY KEY AUTOINCREMENT)",
    f"""CREATE TABLE answers (
        participant INTEGER NOT NULL REFERENCES participants (number),
        stimulus_id INTEGER NOT NULL REFERENCES stimuli (id),
        rating INTEGER NOT NULL CHECK (
            typeof(rating) = 'integer' AND rating BETWEEN {LOWEST_RATING} AND {HIGHEST_RATING}
        ),
        position INTEGER NOT NULL CHECK (typeof(position) = 'integer' AND position >= 0),
        PRIMARY KEY (participant, stimulus_id)
    )""",
)


def create_study(path: str | Path, stimuli: Sequence[Stimulus]) -> None:
    """Make the file of a new study.

    Parameters
    ----------
    path : path-like
        The file. One that is there is kept, unless it is empty.
    stimuli : sequence of Stimulus
        Everything that will be rated.

    Raises
    ------
    DataError
        If there is such a file, or it cannot be written.
    WorkbenchError
        If there is no stimulus, or one comes twice.
    """
    if not stimuli:
        raise WorkbenchError("stimuli: got none, want what participants are to rate")
    rows = [(*stimulus.key, stimulus.parameters_text) for stimulus in stimuli]
    for index, stimulus in enumerate(stimuli):
        if not all(isinstance(word, str) and word.strip() == word != "" for word in stimulus.key):
            raise WorkbenchError(f"stimuli: got {stimulus.key}, want a word for each of them")
        if stimulus in stimuli[:index]:
            raise WorkbenchError(f"stimuli: got {' / '.join(stimulus.key)} twice")
    path = Path(path)
    with _transaction(path, mode="rwc") as database:
        # A creation that was killed leaves an empty file, which may be begun again.
        if database.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]:
            raise DataError(f"{path}: is there already, want the name of a new file")
        for statement in _SCHEMA:
            database.execute(statement)
        database.executemany(
            "INSERT INTO stimuli (test_case, motion, stimulus, parameters) VALUES (?, ?, ?, ?)",
            rows,
        )
        database.execute(f"PRAGMA application_id = {APPLICATION_ID}")
        database.execute(f"PRAGMA user_version = {SCHEMA_VERSION}")


def enrol_participant(path: str | Path) -> int:
    """Give a new participant a number, which no other one gets.

    Raises
    ------
    DataError
        If the file is no study or cannot be written.
    """
    path = Path(path)
    with _transaction(path) as database:
        _check_schema(database, path)
        number = database.execute("INSERT INTO participants DEFAULT VALUES").lastrowid
    assert number is not None  # an insertion has one
    return number


def append_answer(
    path: str | Path, participant: int, stimulus: Stimulus, rating: int, position: int = 0
) -> None:
    """Store one answer; when this returns, it is on the disk.

    The same answer once more changes nothing, so that a page which was reloaded before it
    heard of its answer's arrival may send it again.

    Parameters
    ----------
    path : path-like
        A study.
    participant : int
        Number from :func:`enrol_participant`.
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
        unknown to it, the rating is out of range, or this participant has rated the stimulus
        differently before.
    WorkbenchError
        If the participant is no number.
    """
    path = Path(path)
    rating, position = check_rating(rating), check_position(position)
    participant = whole_number("participant", participant)
    what = " / ".join(stimulus.key)
    with _transaction(path) as database:
        _check_schema(database, path)
        found = database.execute(
            "SELECT id FROM stimuli WHERE test_case = ? AND motion = ? AND stimulus = ?",
            stimulus.key,
        ).fetchone()
        if found is None:
            raise DataError(f"{path}: has no stimulus {what}")
        known = "SELECT 1 FROM participants WHERE number = ?"
        if database.execute(known, (participant,)).fetchone() is None:
            raise DataError(f"{path}: has no participant {participant!r}, want one enrolled")
        before = database.execute(
            "SELECT rating FROM answers WHERE participant = ? AND stimulus_id = ?",
            (participant, found[0]),
        ).fetchone()
        if before is None:
            database.execute(
                "INSERT INTO answers VALUES (?, ?, ?, ?)", (participant, found[0], rating, position)
            )
        elif before[0] != rating:
            raise DataError(
                f"{path}: participant {participant} has rated {what} with {before[0]} before, "
                f"got {rating}"
            )


def study_stimuli(path: str | Path) -> list[Stimulus]:
    """List what a study shows, in the order in which it was made.

    Raises
    ------
    DataError
        If the file is no study or damaged.
    """
    path = Path(path)
    with _transaction(path, begin="BEGIN") as database:
        _check_schema(database, path)
        rows = database.execute(
            "SELECT test_case, motion, stimulus, parameters FROM stimuli ORDER BY id"
        ).fetchall()
    try:
        return [Stimulus(case, motion, name, json.loads(made)) for case, motion, name, made in rows]
    except (TypeError, ValueError):
        raise DataError(f"{path}: is damaged (parameters that are no JSON)") from None


def read_study(path: str | Path) -> pd.DataFrame:
    """Read the answers of a study, by participant and stimulus.

    Returns
    -------
    DataFrame
        As from :func:`workbench.study.answers.check_answers`.

    Raises
    ------
    DataError
        If the file is no study, of another version, damaged, or has no answer yet.
    """
    path = Path(path)
    with _transaction(path, begin="BEGIN") as database:
        _check_schema(database, path)
        verdict = database.execute("PRAGMA integrity_check(1)").fetchone()[0]
        if verdict != "ok":
            raise DataError(f"{path}: is damaged ({' '.join(verdict.split())})")
        orphans = database.execute("PRAGMA foreign_key_check").fetchall()
        if orphans:
            raise DataError(f"{path}: is damaged (an answer of nobody or to nothing)")
        rows = database.execute(
            f"SELECT {', '.join(COLUMNS)} FROM answers "  # noqa: S608 - names of our own
            "JOIN stimuli ON stimuli.id = stimulus_id ORDER BY participant, stimulus_id"
        ).fetchall()
    return check_rows(
        (dict(zip(COLUMNS, row, strict=True)) for row in rows),
        place=lambda index: f"{path}, answer {index + 1}",
        source=str(path),
    )


@contextmanager
def _transaction(
    path: Path, mode: str = "rw", begin: str = "BEGIN IMMEDIATE"
) -> Iterator[sqlite3.Connection]:
    """Open a file for one transaction, which is kept whole or not at all.

    A plain ``BEGIN`` only reads: it waits for no writer and needs no right to write.
    """
    if mode == "rw" and not path.is_file():
        raise DataError(f"{path}: there is no such file")
    try:
        with closing(
            sqlite3.connect(
                f"{path.absolute().as_uri()}?mode={mode}",
                uri=True,
                timeout=_PATIENCE_SECONDS,
                isolation_level=None,
            )
        ) as database:
            # The journal's removal reaches the disk too: a power cut undoes no answer.
            database.execute("PRAGMA synchronous = EXTRA")
            database.execute("PRAGMA foreign_keys = ON")
            database.execute(begin)
            try:
                yield database
            except BaseException:
                # SQLite itself has undone what failed for lack of space.
                if database.in_transaction:
                    database.execute("ROLLBACK")
                raise
            database.execute("COMMIT")
    except sqlite3.OperationalError as error:
        raise DataError(f"{path}: cannot be used ({error})") from None
    except sqlite3.DatabaseError as error:
        raise DataError(f"{path}: is no study, or damaged ({error})") from None


def _check_schema(database: sqlite3.Connection, path: Path) -> None:
    application = database.execute("PRAGMA application_id").fetchone()[0]
    version = database.execute("PRAGMA user_version").fetchone()[0]
    if application != APPLICATION_ID:
        raise DataError(f"{path}: is no file of a user study")
    if version != SCHEMA_VERSION:
        raise DataError(f"{path}: has version {version} of the format, want {SCHEMA_VERSION}")
