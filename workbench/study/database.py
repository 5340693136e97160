"""A study's file: making it, enrolling participants, and reading what is in it.

All of a study is in one SQLite file, see :mod:`workbench.study.study_file`. How answers get
into it tells :mod:`workbench.study.participation`.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from workbench.errors import DataError, WorkbenchError
from workbench.study.answers import COLUMNS, Stimulus, check_rows
from workbench.study.study_file import (
    APPLICATION_ID,
    SCHEMA,
    SCHEMA_VERSION,
    check_schema,
    transaction,
)
from workbench.validation import whole_number

if TYPE_CHECKING:
    import pandas as pd


def create_study(
    path: str | Path, stimuli: Sequence[Stimulus], settings: Mapping[str, Any] | None = None
) -> None:
    """Make the file of a new study.

    Parameters
    ----------
    path : path-like
        The file. One that is there is kept, unless it is empty.
    stimuli : sequence of Stimulus
        Everything that will be rated.
    settings : mapping, optional
        What else belongs to the study: JSON.

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
    with transaction(path, mode="rwc") as database:
        # A creation that was killed leaves an empty file, which may be begun again.
        if database.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]:
            raise DataError(f"{path}: is there already, want the name of a new file")
        for statement in SCHEMA:
            database.execute(statement)
        database.executemany(
            "INSERT INTO stimuli (test_case, motion, stimulus, parameters) VALUES (?, ?, ?, ?)",
            rows,
        )
        database.execute(
            "INSERT INTO study VALUES (?)", (json.dumps(dict(settings or {}), sort_keys=True),)
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
    with transaction(path) as database:
        check_schema(database, path)
        number = database.execute("INSERT INTO participants DEFAULT VALUES").lastrowid
    assert number is not None  # an insertion has one
    return number


def stimulus_of(
    database: sqlite3.Connection, path: Path, participant: int, stimulus: Stimulus
) -> int:
    """Find the row of a stimulus that a participant is about to rate.

    Raises
    ------
    DataError
        If the file is no study, or the participant or the stimulus is unknown to it.
    WorkbenchError
        If the participant is no number.
    """
    check_schema(database, path)
    check_participant(database, path, participant)
    found = database.execute(
        "SELECT id FROM stimuli WHERE test_case = ? AND motion = ? AND stimulus = ?",
        stimulus.key,
    ).fetchone()
    if found is None:
        raise DataError(f"{path}: has no stimulus {' / '.join(stimulus.key)}")
    return int(found[0])


def check_participant(database: sqlite3.Connection, path: Path, participant: int) -> None:
    """Refuse the number of somebody who was not enrolled.

    Raises
    ------
    DataError
        If nobody has it.
    WorkbenchError
        If it is no number.
    """
    number = whole_number("participant", participant)
    known = "SELECT 1 FROM participants WHERE number = ?"
    if database.execute(known, (number,)).fetchone() is None:
        raise DataError(f"{path}: has no participant {participant!r}, want one enrolled")


def study_stimuli(path: str | Path) -> list[Stimulus]:
    """List what a study shows, in the order in which it was made.

    Raises
    ------
    DataError
        If the file is no study or damaged.
    """
    path = Path(path)
    with transaction(path, begin="BEGIN") as database:
        check_schema(database, path)
        rows = database.execute(
            "SELECT test_case, motion, stimulus, parameters FROM stimuli ORDER BY id"
        ).fetchall()
    try:
        return [Stimulus(case, motion, name, json.loads(made)) for case, motion, name, made in rows]
    except (TypeError, ValueError):
        raise DataError(f"{path}: is damaged (parameters that are no JSON)") from None


def study_settings(path: str | Path) -> dict[str, Any]:
    """Read what belongs to a study beside its stimuli.

    Raises
    ------
    DataError
        If the file is no study or damaged.
    """
    path = Path(path)
    with transaction(path, begin="BEGIN") as database:
        check_schema(database, path)
        row = database.execute("SELECT settings FROM study").fetchone()
    try:
        settings = json.loads(row[0])
    except (TypeError, ValueError):
        settings = None
    if not isinstance(settings, dict):
        raise DataError(f"{path}: is damaged (settings that are no JSON object)")
    return settings


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
    with transaction(path, begin="BEGIN") as database:
        check_schema(database, path)
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
