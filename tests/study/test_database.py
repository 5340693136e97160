"""A running study loses no answer and takes none that is wrong."""

from __future__ import annotations

import os
import signal
import sqlite3
import subprocess
import sys
from contextlib import closing

import pytest

from workbench.errors import DataError, WorkbenchError
from workbench.study.answers import Stimulus
from workbench.study.database import (
    create_study,
    enrol_participant,
    read_study,
    study_stimuli,
)
from workbench.study.participation import participants, rate
from workbench.study.reading import read_answers
from workbench.study.study_file import SCHEMA_VERSION

STIMULI = [Stimulus("methods", "walking", f"method {i}", {"count": i}) for i in range(40)]

#: Takes part in the study given, telling of each rating once it is stored and once it is settled.
PARTICIPANT = """
import sys
from pathlib import Path
from workbench.study.database import enrol_participant, study_stimuli
from workbench.study.participation import rate, settle
path = Path(sys.argv[1])
person = enrol_participant(path)
for position, stimulus in enumerate(study_stimuli(path), 1):
    rating = 1 + position % 10
    rate(path, person, stimulus, rating, position)
    print("rated", person, position, flush=True)
    settle(path, person, {stimulus: rating})
    print("settled", person, position, flush=True)
"""


@pytest.fixture
def study(tmp_path):
    path = tmp_path / "a study #1.sqlite"
    create_study(path, STIMULI)
    return path


def take_part(path):
    words = [sys.executable, "-c", PARTICIPANT, str(path)]
    return subprocess.Popen(words, stdout=subprocess.PIPE, text=True)


def changed(path, statement):
    """Change the file as no function of ours does."""
    with closing(sqlite3.connect(path)) as database:
        database.execute("PRAGMA ignore_check_constraints = ON")
        database.execute(statement)
        database.commit()


def test_stimuli_keep_their_order_and_parameters(study):
    """What was to be rated can be made again from the file alone."""
    assert study_stimuli(study) == STIMULI
    assert [stimulus.parameters for stimulus in study_stimuli(study)] == [
        stimulus.parameters for stimulus in STIMULI
    ]


def test_killed_at_any_moment_no_answer_is_lost(study):
    """After kill -9 all that was acknowledged is there, and the study goes on."""
    acknowledged = []
    for after in (1, 4, 9):
        process = take_part(study)
        lines = [process.stdout.readline() for _ in range(after)]
        os.kill(process.pid, signal.SIGKILL)
        lines += process.stdout.readlines()
        process.wait()
        assert process.returncode == -signal.SIGKILL
        acknowledged += [line.split() for line in lines]
    answers = read_answers(study)
    stored = set(zip(answers["participant"], answers["position"].astype(str), strict=True))
    rated = {(person, position) for word, person, position in acknowledged if word == "rated"}
    assert stored >= rated
    # At most the one answer that was being acknowledged may be there besides.
    assert len(stored) <= len(rated) + 3
    for person, n_settled in participants(study).items():
        told = sum(line[:2] == ["settled", str(person)] for line in acknowledged)
        assert told <= n_settled <= told + 1
    rate(study, enrol_participant(study), STIMULI[0], 5)
    assert len(read_study(study)) == len(stored) + 1


def test_two_write_at_once(study):
    """Participants in two processes get two numbers and lose no answer to each other."""
    processes = [take_part(study) for _ in range(2)]
    assert [process.wait(timeout=120) for process in processes] == [0, 0]
    for process in processes:
        process.stdout.close()
    assert participants(study) == {1: 40, 2: 40}
    answers = read_study(study)
    assert answers["participant"].value_counts().to_dict() == {"1": 40, "2": 40}
    assert answers.groupby("participant")["position"].apply(list).tolist() == [
        list(range(1, 41)),
        list(range(1, 41)),
    ]


def test_a_file_that_is_there_is_kept(study, tmp_path):
    """A second study does not replace the first; a creation that was killed is begun again."""
    before = study.read_bytes()
    with pytest.raises(DataError, match="is there already"):
        create_study(study, STIMULI[:2])
    assert study.read_bytes() == before
    (tmp_path / "empty").touch()
    create_study(tmp_path / "empty", STIMULI[:2])
    assert study_stimuli(tmp_path / "empty") == STIMULI[:2]


@pytest.mark.parametrize(
    ("stimuli", "message"),
    [([], "got none"), ([STIMULI[0]] * 2, "twice"), ([Stimulus("a", "", "b")], "want a word")],
    ids=["none", "twice", "without name"],
)
def test_stimuli_that_cannot_be_told_apart_are_refused(stimuli, message, tmp_path):
    """Nothing is written then."""
    with pytest.raises(WorkbenchError, match=message):
        create_study(tmp_path / "study", stimuli)
    assert not (tmp_path / "study").exists()


def test_a_study_without_answers_says_so(study):
    """An empty table would look like a result."""
    with pytest.raises(DataError, match="found no answer"):
        read_study(study)


def test_a_file_that_is_no_longer_whole_is_refused(study):
    """A page overwritten anywhere in the tables is noticed."""
    rate(study, enrol_participant(study), STIMULI[0], 5)
    content = bytearray(study.read_bytes())
    content[4096:4296] = b"\xa5" * 200
    study.write_bytes(content)
    with pytest.raises(DataError, match="damaged"):
        read_study(study)


@pytest.mark.parametrize(
    ("statement", "message"),
    [
        (f"PRAGMA user_version = {SCHEMA_VERSION + 1}", "has version 3 of the format, want 2"),
        ("PRAGMA application_id = 0", "is no file of a user study"),
        ("UPDATE answers SET rating = 11", "damaged"),
        ("UPDATE stimuli SET parameters = 'none'", "want a JSON object"),
        ("DELETE FROM participants", "damaged .an answer of nobody"),
    ],
    ids=["later version", "other program", "wrong rating", "wrong parameters", "nobody's answer"],
)
def test_a_file_of_another_kind_is_refused(study, statement, message):
    """Nothing is read from a file whose meaning is not certain."""
    rate(study, enrol_participant(study), STIMULI[0], 5)
    changed(study, statement)
    with pytest.raises(DataError, match=message):
        read_study(study)


def test_a_missing_study_is_not_made_by_reading(tmp_path):
    """Only create_study makes a file."""
    with pytest.raises(DataError, match="there is no such file"):
        enrol_participant(tmp_path / "none")
    assert list(tmp_path.iterdir()) == []
