"""The participant's page: what it asks, what it stores, and what it must not tell."""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Iterator
from pathlib import Path

import ipywidgets
import numpy as np
import pytest

from workbench.dashboards.study import item_motions, item_view
from workbench.dashboards.study.participation import StudyParticipation, take_part_in_study
from workbench.datasets import load
from workbench.errors import DataError, WorkbenchError
from workbench.study.database import read_study
from workbench.study.design import StudyDesign, load_design, store_design
from workbench.study.participation import participants
from workbench.study.stimuli import Clip, make_stimuli, practice_stimuli, stimulus_motion
from workbench.widgets.player import motion_traits

CLIPS = ("cmu/01_01-jump", "cmu/01_03-walk")


@pytest.fixture(scope="module")
def design() -> StudyDesign:
    parts = [Clip.from_start(name, load(name), seconds=0.5) for name in CLIPS]
    stimuli = [s for part in parts for s in make_stimuli(part, ["uniform", "pb"], count=3)]
    turn = Clip.from_start("cmu/01_01-turn", load("cmu/01_01-turn"), seconds=0.5)
    return StudyDesign(tuple(stimuli), practice_stimuli(turn), seed=11)


@pytest.fixture
def study(design: StudyDesign, tmp_path: Path) -> Path:
    path = tmp_path / "study.sqlite"
    store_design(path, design)
    return path


@pytest.fixture
def page(study: Path) -> Iterator[StudyParticipation]:
    page = take_part_in_study(study)
    yield page
    page.close()


#: A clock that stands still until it is moved.
CLOCK = [0.0]


@pytest.fixture(autouse=True)
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    monkeypatch.setattr(item_view, "monotonic", lambda: CLOCK[0])
    return CLOCK


def watch(page: StudyParticipation) -> None:
    """Let the motions play to their end, as the browser does."""
    CLOCK[0] += 0.5
    page.player.ends += 1


def give(page: StudyParticipation, *ratings: int) -> None:
    """Rate what is on the screen from left to right, as the browser does."""
    page.form.chosen = [*ratings, *page.form.stored[len(ratings) :]]


def finish(page: StudyParticipation) -> None:
    page.form.finished += 1


def practise(page: StudyParticipation) -> None:
    page.begin.click()
    watch(page)
    give(page, 9, 2)
    finish(page)


def test_a_participant_rates_everything(page: StudyParticipation, study: Path) -> None:
    """Each rating goes with the stimulus at its place in this participant's order."""
    practise(page)
    for expected in ([8, 3, 10], [1, 2, 3]):
        watch(page)
        give(page, *expected)
        assert page.form.stored == expected
        finish(page)
    assert "Thank you" in page.root.children[-1].children[0].value
    answers = read_study(study).sort_values("position")
    shown = [s.key for item in load_design(study).shown_to(1) for s in item]
    stored = answers[["test_case", "motion", "stimulus"]].itertuples(index=False)
    assert [tuple(row) for row in stored] == shown
    assert answers["rating"].tolist() == [8, 3, 10, 1, 2, 3]
    assert answers["position"].tolist() == [1, 2, 3, 4, 5, 6]


def test_the_exercise_is_not_stored(page: StudyParticipation, study: Path) -> None:
    """It looks like an item, and leaves nothing in the file."""
    page.begin.click()
    assert page.form.letters == ["A", "B"]
    watch(page)
    give(page, 9, 2)
    assert page.form.stored == [9, 2]
    finish(page)
    assert page.index == 0
    assert participants(study) == {1: 0}


def test_nothing_can_be_rated_before_it_was_seen_once(
    page: StudyParticipation, study: Path
) -> None:
    """A rating that comes earlier, however, is refused in words and stored nowhere."""
    practise(page)
    assert not page.form.ready
    give(page, 5)
    assert "Watch the figures to the end" in page.form.message
    assert page.form.stored == [0, 0, 0]
    watch(page)
    assert page.form.ready
    give(page, 5)
    assert page.form.message == ""
    assert len(read_study(study)) == 1


def test_a_leap_to_the_end_does_not_count_as_seen(
    page: StudyParticipation, clock: list[float]
) -> None:
    """The end counts once as much time has passed as the motions take."""
    practise(page)
    clock[0] += 0.2
    page.player.ends += 1
    assert not page.form.ready
    clock[0] += 0.3
    page.player.ends += 1
    assert page.form.ready


def test_a_rating_may_be_changed_while_its_item_is_shown(
    page: StudyParticipation, study: Path
) -> None:
    """The last one is stored; an item with a missing rating is not left."""
    practise(page)
    watch(page)
    give(page, 5, 6)
    give(page, 7)
    assert page.form.stored == [7, 6, 0]
    finish(page)
    assert page.index == 0
    assert page.form.message == "Please rate all figures first."


def test_a_failure_names_no_method(page: StudyParticipation, study: Path) -> None:
    """What is told does not unblind the study; whoever leads it finds the details."""
    practise(page)
    watch(page)
    with sqlite3.connect(study) as database:
        database.execute("UPDATE stimuli SET stimulus = stimulus || ' edited'")
    database.close()
    give(page, 5)
    assert page.form.message.startswith("That did not work")
    assert "has no stimulus methods / cmu" in page.failure


def test_another_kernel_goes_on_where_the_page_was(page: StudyParticipation, study: Path) -> None:
    """By what the tab remembers, or by the code; half an item is shown with its ratings."""
    practise(page)
    watch(page)
    give(page, 5, 6, 7)
    finish(page)
    watch(page)
    give(page, 2)
    for way in ("recalled", "typed"):
        other = take_part_in_study(study)
        assert other.memory.name == page.memory.name
        if way == "recalled":
            other.memory.recalled = page.memory.word
        else:
            assert page.run is not None
            other.code.value = page.run.code.lower()
            other.go_on.click()
        assert other.index == 1
        assert other.form.stored == [2, 0, 0]
        assert other.form.ready  # it was seen before
        np.testing.assert_array_equal(other.player.positions, page.player.positions)
        other.close()


def test_a_wrong_code_is_told_and_stores_nothing(page: StudyParticipation, study: Path) -> None:
    """The page stays as it was."""
    page.code.value = "3-XYZ"
    page.go_on.click()
    assert "want the number and the three letters" in page.message
    assert page.run is None
    assert participants(study) == {}


def test_the_next_participant_starts_at_the_beginning(
    page: StudyParticipation, study: Path
) -> None:
    """On one screen, one after the other, each with a number of their own."""
    practise(page)
    for _ in range(2):
        watch(page)
        give(page, 5, 5, 5)
        finish(page)
    page.next_person.click()
    assert page.memory.word == ""
    page.begin.click()
    assert page.run is not None
    assert page.run.participant == 2
    assert page.index == -1


def test_motions_stand_in_the_order_of_the_letters(page: StudyParticipation) -> None:
    """What is rated as A is the left motion, and so on."""
    practise(page)
    assert page.run is not None
    motions = {s.name: stimulus_motion(s) for s in page.run.items[0]}
    expected = motion_traits(motions)["positions"]
    np.testing.assert_array_equal(np.asarray(page.player.positions).ravel(), expected.ravel())
    assert page.player.motions == page.form.letters == ["A", "B", "C"]


def test_no_state_of_any_widget_tells_a_method(page: StudyParticipation, study: Path) -> None:
    """Neither a name nor a clip nor keyframes nor the path of the study reach the browser."""
    practise(page)
    told = []
    for widget in _below(page.root):
        state = widget.get_state()
        told.append(json.dumps({k: v for k, v in state.items() if k[0] != "_"}, default=repr))
    words = " ".join(told).lower()
    assert len(told) > 8
    for secret in ("original", "uniform", "'pb'", '"pb"', "cmu", "methods", "saliency", str(study)):
        assert secret.lower() not in words
    assert not len(page.player.keyframes)


def _below(widget: ipywidgets.Widget) -> Iterator[ipywidgets.Widget]:
    yield widget
    yield widget.layout
    for child in getattr(widget, "children", ()):
        yield from _below(child)


@pytest.mark.parametrize(
    ("name", "words"),
    [("", "No study was prepared yet"), ("none", "This study cannot be opened")],
    ids=["none at all", "a missing one"],
)
def test_a_missing_study_is_told(
    name: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The page says so without a path, and offers nothing that cannot work."""
    monkeypatch.setenv("WORKBENCH_STUDIES", str(tmp_path))
    page = take_part_in_study(name)
    assert words in page.message
    assert str(tmp_path) not in page.message
    if name:
        assert f"{tmp_path / 'none.sqlite'}: there is no such file" in page.failure
    page.close()


@pytest.fixture
def two_studies(design: StudyDesign, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Store two studies in the folder; the first one is older."""
    monkeypatch.setenv("WORKBENCH_STUDIES", str(tmp_path))
    monkeypatch.delenv("QUERY_STRING", raising=False)
    paths = [tmp_path / "first.sqlite", tmp_path / "second.sqlite"]
    for age, path in enumerate(paths):
        made = StudyDesign(design.stimuli, design.practice, seed=1, title=f"The {path.stem} one")
        store_design(path, made)
        os.utime(path, (1e9 + age, 1e9 + age))
    return paths


@pytest.mark.parametrize(
    ("query", "title"),
    [("study=first&token=x", "The first one"), ("token=x", "The second one")],
    ids=["asked for", "latest"],
)
def test_the_page_finds_the_study_of_its_address(
    two_studies: list[Path], query: str, title: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A name in the address comes first, else the study that was prepared last."""
    monkeypatch.setenv("QUERY_STRING", query)
    page = take_part_in_study()
    assert title in page.root.children[-1].children[0].value
    page.close()


@pytest.mark.parametrize("asked", ["", "second"], ids=["none asked for", "another asked for"])
def test_a_reloaded_page_goes_on_in_its_own_study(two_studies: list[Path], asked: str) -> None:
    """Though another was prepared meanwhile; but not in the place of one that is asked for."""
    page = take_part_in_study("first")
    practise(page)
    os.utime(two_studies[1], (4e9, 4e9))  # later than what was just enrolled in the first one
    other = take_part_in_study(asked)
    assert "The second one" in other.root.children[-1].children[0].value
    assert other.memory.name == page.memory.name
    other.memory.recalled = page.memory.word
    if asked:
        assert other.run is None
    else:
        assert other.run is not None
        assert other.run.design.title == "The first one"
        assert other.run.participant == 1
    page.close()
    other.close()


def test_a_tab_of_a_pilot_is_nobody_in_a_file_that_was_made_anew(
    page: StudyParticipation, study: Path, design: StudyDesign
) -> None:
    """Its participant 1 does not become the real one."""
    practise(page)
    study.unlink()
    store_design(study, design)
    real = take_part_in_study(study)
    real.begin.click()
    again = take_part_in_study(study)
    again.memory.recalled = page.memory.word
    assert again.run is None
    assert again.message == ""
    for one in (real, again):
        one.close()


@pytest.mark.parametrize("practice", [True, False], ids=["with", "without"])
def test_an_exercise_is_announced_if_there_is_one(
    design: StudyDesign, tmp_path: Path, practice: bool
) -> None:
    """Without one the page begins with what counts, and says nothing else."""
    made = StudyDesign(design.stimuli, design.practice if practice else ())
    store_design(tmp_path / "study", made)
    page = take_part_in_study(tmp_path / "study")
    assert ("exercise" in page.root.children[-1].children[0].value) == practice
    page.begin.click()
    assert page.index == (-1 if practice else 0)
    page.close()


def test_a_reload_does_not_lead_back_to_the_exercise(page: StudyParticipation, study: Path) -> None:
    """Who has done it goes on with the first movement; who has not does it."""
    page.begin.click()
    for index in (-1, 0):
        assert page.index == index
        other = take_part_in_study(study)
        other.memory.recalled = page.memory.word
        assert other.index == index
        other.close()
        if index < 0:
            watch(page)
            give(page, 9, 2)
            finish(page)


def test_only_ratings_that_were_seen_are_settled(page: StudyParticipation, study: Path) -> None:
    """What another page of the same person changed is shown before it counts."""
    practise(page)
    watch(page)
    give(page, 5, 6, 7)
    other = take_part_in_study(study)
    other.memory.recalled = page.memory.word
    give(other, 9)
    finish(page)
    assert "changed in another window" in page.form.message
    assert page.index == 0
    assert page.form.stored == page.form.chosen == [9, 6, 7]
    assert participants(study) == {1: 0}
    finish(page)
    assert page.index == 1
    assert page.form.message == ""
    assert participants(study) == {1: 3}
    other.close()


def test_a_page_says_who_it_remembers_and_lets_others_begin(
    page: StudyParticipation, study: Path
) -> None:
    """A duplicated tab has a copy of the memory, and may be another person's."""
    practise(page)
    assert page.run is not None
    assert not page._recalled.children
    copy = take_part_in_study(study)
    copy.memory.recalled = page.memory.word
    assert f"You go on as {page.run.code}." in copy._recalled.children[0].value
    copy.somebody_else.click()
    assert copy.memory.word == ""
    assert not copy._recalled.children
    copy.begin.click()
    assert copy.run is not None
    assert copy.run.participant == 2
    copy.close()


def test_a_failure_makes_nobody_somebody_else(
    page: StudyParticipation, study: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Who begins after somebody's code or memory failed is new."""
    practise(page)
    assert page.run is not None

    def fail(_: object) -> None:
        raise DataError("cmu/01_01-jump: is not the motion with which the study was prepared")

    for number, way in enumerate(("recalled", "typed"), 2):
        other = take_part_in_study(study)
        with monkeypatch.context() as patch:
            patch.setattr(item_motions, "stimulus_motion", fail)
            if way == "recalled":
                other.memory.recalled = page.memory.word
            else:
                other.code.value = page.run.code
                other.go_on.click()
            assert "That did not work" in other.message
        other.begin.click()
        assert other.run is not None
        assert other.run.participant == number
        other.close()


def test_a_memory_that_cannot_be_looked_up_is_told(page: StudyParticipation, study: Path) -> None:
    """A file that is gone for the moment is not taken for one without this participant."""
    practise(page)
    other = take_part_in_study(study)
    study.unlink()
    other.memory.recalled = page.memory.word
    assert "That did not work" in other.message
    assert "there is no such file" in other.failure
    other.close()


def test_an_item_that_cannot_be_shown_is_told(
    page: StudyParticipation, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What was on the screen stays, and the same button goes on once the clip is back."""

    def fail(_: object) -> None:
        raise DataError("cmu/01_01-jump: is not the motion with which the study was prepared")

    with monkeypatch.context() as patch:
        patch.setattr(item_motions, "stimulus_motion", fail)
        page.begin.click()
        assert "That did not work" in page.message
        assert page.begin in page.root.children[-1].children[1].children
    page.begin.click()
    assert page.run is not None
    assert page.run.participant == 1
    watch(page)
    give(page, 9, 2)
    with monkeypatch.context() as patch:
        patch.setattr(item_motions, "stimulus_motion", fail)
        finish(page)
        assert page.form.message.startswith("That did not work")
        assert page.player.positions.size
        assert "is not the motion" in page.failure
    finish(page)
    assert page.index == 0
    assert page.form.message == ""


def test_a_study_that_is_gone_loses_nothing_on_the_page(
    page: StudyParticipation, study: Path
) -> None:
    """A rating that cannot be stored is told, and not shown as stored."""
    practise(page)
    watch(page)
    give(page, 4)
    content = study.read_bytes()
    study.unlink()
    give(page, 9)
    assert page.form.message.startswith("That did not work")
    assert "there is no such file" in page.failure
    assert page.form.stored == [4, 0, 0]
    study.write_bytes(content)
    give(page, 9)
    assert page.form.message == ""
    assert page.form.stored == [9, 0, 0]
    with pytest.raises(WorkbenchError, match="place: got 3"):
        page.run.rate(0, 3, 5)
