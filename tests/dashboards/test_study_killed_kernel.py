"""A study survives kill -9 of its kernel, and takes answers of several kernels at once."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from jupyter_client.manager import start_new_kernel

import workbench
from workbench.datasets import load
from workbench.study.database import read_study
from workbench.study.design import StudyDesign, load_design, store_design
from workbench.study.participation import participants, ratings_given
from workbench.study.run import StudyRun
from workbench.study.stimuli import Clip, make_stimuli

_LIMIT = 120  # seconds

#: Takes part as a person does: sees each item, rates it figure by figure, goes on. Tells of each
#: rating once the page shows it as stored.
TAKE_PART = """
from itertools import count
from workbench.dashboards import take_part_in_study
from workbench.dashboards.study import item_view
item_view.monotonic = count().__next__  # every look at the clock is a second later
page = take_part_in_study({path!r})
if {word!r}:
    page.memory.recalled = {word!r}
else:
    page.begin.click()
print("code", page.run.code, page.index, *page.form.stored, flush=True)
while page.index is not None:
    page.player.ends += 1
    for place in range(len(page.form.letters)):
        chosen = list(page.form.stored)
        if chosen[place]:
            continue
        chosen[place] = 1 + (page.index + place) % 10
        page.form.chosen = chosen
        assert page.form.stored == chosen, page.failure
        print("stored", page.index, place, chosen[place], flush=True)
    page.form.finished += 1
print("done", flush=True)
"""


@dataclass
class Kernel:
    """A kernel, and what it was asked last."""

    manager: Any
    client: Any

    def run(self, code: str) -> None:
        self.client.execute(code)

    def lines(self, word: str, count: int) -> list[list[str]]:
        """Wait for so many printed lines that begin with a word, and give their fields."""
        found: list[list[str]] = []
        while len(found) < count:
            message = self.client.get_iopub_msg(timeout=_LIMIT)
            if message["msg_type"] == "error":
                raise AssertionError("\n".join(message["content"]["traceback"]))
            if message["msg_type"] == "stream":
                rows = [line.split() for line in message["content"]["text"].splitlines()]
                found += [row[1:] for row in rows if row and row[0] == word]
        return found

    def kill(self) -> None:
        process = self.manager.provisioner.process
        os.kill(process.pid, signal.SIGKILL)
        assert process.wait() == -signal.SIGKILL


@pytest.fixture
def study(tmp_path: Path) -> Path:
    """Make a study of 8 items with 3 stimuli each."""
    motion = load("cmu/01_01-jump")
    stimuli = []
    for item in range(8):
        part = Clip("cmu/01_01-jump", motion[:20], name=f"part {item}")
        stimuli += make_stimuli(part, ["uniform", "pb"], count=3)
    path = tmp_path / "study.sqlite"
    store_design(path, StudyDesign(tuple(stimuli), seed=3))
    return path


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Any]:
    """Start kernels that end with the test."""
    kernels: list[Kernel] = []

    def start() -> Kernel:
        root = str(Path(workbench.__file__).parents[1])
        env = {**os.environ, "PYTHONPATH": root, "IPYTHONDIR": str(tmp_path / "ipython")}
        manager, client = start_new_kernel(startup_timeout=_LIMIT, env=env, cwd=str(tmp_path))
        kernels.append(Kernel(manager, client))
        return kernels[-1]

    yield start
    for kernel in kernels:
        kernel.client.stop_channels()
        kernel.manager.shutdown_kernel(now=True)


def test_no_answer_is_lost_when_the_kernel_is_killed(study: Path, start: Any) -> None:
    """Two take part at once; one kernel is killed, and another one goes on for it."""
    first, second = start(), start()
    first.run(TAKE_PART.format(path=str(study), word=""))
    second.run(TAKE_PART.format(path=str(study), word=""))
    [[code, *_]] = first.lines("code", 1)
    acknowledged = first.lines("stored", 8)  # two items and two figures of the third
    first.kill()

    person = int(code.partition("-")[0])
    run = StudyRun.resume(study, code)
    assert run.participant == person
    given = ratings_given(study, person)
    for index, place, rating in (map(int, row) for row in acknowledged):
        assert given[run.items[index][place].key].rating == rating
    # What came between the last line that was read and the signal may be there as well.
    assert len(given) >= len(acknowledged)
    here, ratings = run.current, run.ratings(run.current or 0)

    third = start()
    third.run(TAKE_PART.format(path=str(study), word=f"{load_design(study).study_id} {code}"))
    [[again, index, *stored]] = third.lines("code", 1)
    assert again == code
    assert int(index) == here
    assert [int(rating) for rating in stored] == ratings
    third.lines("done", 1)
    second.lines("done", 1)

    answers = read_study(study)
    assert participants(study) == {1: 24, 2: 24}
    for number, mine in answers.groupby("participant"):
        items = StudyRun(study, int(number)).items
        expected = {
            s.key: 1 + (index + place) % 10
            for index, item in enumerate(items)
            for place, s in enumerate(item)
        }
        stored_now = {
            (row.test_case, row.motion, row.stimulus): row.rating for row in mine.itertuples()
        }
        assert stored_now == expected
        assert sorted(mine["position"]) == list(range(1, 25))
