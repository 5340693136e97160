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
    append_answer,
    create_study,
    enrol_participant,
    read_study,
    study_stimuli,
)
from workbench.study.reading import read_answers
from workbench.study.study_file import SCHEMA_VERSION

STIMULI = [Stimulus("methods", "walking", f"method {i}", {"count": i}) for i in range(40)]

#: Takes part in the study given, telling of each answer once it is stored.
PARTICIPANT = """
import sys
from pathlib import Path
from workbench.study.database import append_answer, enrol_participant, study_stimuli
path = Path(sys.argv[1])
person = enrol_participant(path)
for position, stimulus in enumerate(study_stimuli(path), 1):
    append_answer(path, person, stimulus, 1 + position % 10, position)
    print(person, position, flush=True)
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
    """After kill -9 every answer that was acknowledged is there, and the study goes on."""
    acknowledged = []
    for after in (1, 4, 9):
        process = take_part(study)
        lines = [process.stdout.readline() for _ in range(after)]
        os.kill(process.pid, signal.SIGKILL)
        lines += process.stdout.readlines()
        process.wait()
        assert process.returncode == -signal.SIGKILL
        acknowledged += [tuple(map(int, line.split())) for line in lines]
    answers = read_answers(study)
    stored = set(zip(answers["participant"].astype(int), answers["position"], strict=True))
    assert stored >= set(acknowledged)
    # At most the one answer that was being acknowledged may be there besides.
    assert len(stored) <= len(acknowledged) + 3
    append_answer(study, enrol_participant(study), STIMULI[0], 5)
    assert len(read_study(study)) == len(stored) + 1


def test_two_write_at_once(study):
    """Participants in two processes get two numbers and lose no answer to each other."""
    processes = [take_part(study) for _ in range(2)]
    assert [process.wait(timeout=120) for process in processes] == [0, 0]
    for process in processes:
        process.stdout.close()
    answers = read_study(study)
    assert answers["participant"].value_counts().to_dict() == {"1": 40, "2": 40}
    assert answers.groupby("participant")["position"].apply(list).tolist() == [
        list(range(1, 41)),
        list(range(1, 41)),
    ]


def test_an_answer_may_be_sent_again_but_not_changed(study):
    """A reloaded page sends its last answer again; a different one is refused."""
    person = enrol_participant(study)
    for _ in range(2):
        append_answer(study, person, STIMULI[3], 6, 1)
    assert len(read_study(study)) == 1
    with pytest.raises(DataError, match=r"has rated .* with 6 before, got 7"):
        append_answer(study, person, STIMULI[3], 7, 1)
    assert read_study(study)["rating"].tolist() == [6]


@pytest.mark.parametrize(
    ("participant", "stimulus", "rating", "error", "message"),
    [
        (2, STIMULI[0], 5, DataError, "has no participant 2"),
        ("1", STIMULI[0], 5, WorkbenchError, "participant: got '1', want a whole number"),
        (1, Stimulus("methods", "walking", "none"), 5, DataError, "has no stimulus methods"),
        (1, STIMULI[0], 11, DataError, "rating: got 11"),
        (1, STIMULI[0], 0, DataError, "rating: got 0"),
    ],
    ids=["unknown participant", "no number", "unknown stimulus", "too high", "too low"],
)
def test_a_wrong_answer_is_not_stored(study, participant, stimulus, rating, error, message):
    """The refusal names what is wrong and leaves the file as it was."""
    enrol_participant(study)
    before = study.read_bytes()
    with pytest.raises(error, match=message):
        append_answer(study, participant, stimulus, rating)
    assert study.read_bytes() == before


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
    append_answer(study, enrol_participant(study), STIMULI[0], 5)
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
    append_answer(study, enrol_participant(study), STIMULI[0], 5)
    changed(study, statement)
    with pytest.raises(DataError, match=message):
        read_study(study)


def test_a_missing_study_is_not_made_by_reading(tmp_path):
    """Only create_study makes a file."""
    with pytest.raises(DataError, match="there is no such file"):
        enrol_participant(tmp_path / "none")
    assert list(tmp_path.iterdir()) == []
