"""The file of a running study: its tables, and how it is read and written.

Schema, version 2 (``PRAGMA user_version``; ``PRAGMA application_id`` is :data:`APPLICATION_ID`):

- ``study(settings)``: one row, a JSON object with what else belongs to the study, see
  :mod:`workbench.study.design`; empty where there is nothing.
- ``stimuli(id, test_case, motion, stimulus, parameters)``: what is rated; ``parameters`` is a
  JSON object from which the stimulus can be made again; each test case, motion and stimulus
  once.
- ``participants(number)``: counted from 1. Nothing else is known of them.
- ``answers(participant, stimulus_id, rating, position, settled)``: one row for each participant
  and stimulus; ``rating`` from 1 to 10, ``position`` the place in the order that this
  participant saw, from 1, or 0 where it is not told; ``settled`` is 0 as long as the
  participant may still change the rating, see :mod:`workbench.study.participation`. Practice
  items are not stored.

Each answer is a transaction of its own that is on the disk before the call returns, so that a
killed process loses none; several processes may write at once.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from workbench.errors import DataError
from workbench.study.answers import HIGHEST_RATING, LOWEST_RATING

SQLITE_MAGIC = b"SQLite format 3\0"
SCHEMA_VERSION = 2
#: Tells a study from any other SQLite file.
APPLICATION_ID = int.from_bytes(b"WBst", "big")

#: How long a writer waits for another one.
_PATIENCE_SECONDS = 30.0

#: Statements that make the tables.
SCHEMA = (
    "CREATE TABLE study (settings TEXT NOT NULL)",
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
        settled INTEGER NOT NULL CHECK (settled IN (0, 1)),
        PRIMARY KEY (participant, stimulus_id)
    )""",
)


@contextmanager
def transaction(
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


def check_schema(database: sqlite3.Connection, path: Path) -> None:
    """Refuse a file that is no study, or one of another version.

    Raises
    ------
    DataError
        If it is.
    """
    application = database.execute("PRAGMA application_id").fetchone()[0]
    version = database.execute("PRAGMA user_version").fetchone()[0]
    if application != APPLICATION_ID:
        raise DataError(f"{path}: is no file of a user study")
    if version != SCHEMA_VERSION:
        raise DataError(f"{path}: has version {version} of the format, want {SCHEMA_VERSION}")
