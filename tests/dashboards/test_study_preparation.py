"""A study is prepared from what is chosen, and what cannot be shown is told."""

from __future__ import annotations

import asyncio
import re
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote

import pytest

from workbench.dashboards import StudyPreparation, prepare_study
from workbench.datasets import load
from workbench.errors import WorkbenchError
from workbench.mocap.bvh_writer import write_bvh
from workbench.selection.saliency import Saliency
from workbench.spaces import PoseSpace
from workbench.study.database import study_stimuli
from workbench.study.design import load_design
from workbench.study.stimuli import Method

CLIPS = ("cmu/01_01-jump", "cmu/01_03-walk")


@pytest.fixture(scope="module")
def shared() -> Iterator[StudyPreparation]:
    preparation = prepare_study(
        CLIPS, ["uniform", "scs"], count=4, seconds=0.5, file="/nowhere/study"
    )
    yield preparation
    preparation.close()


@pytest.fixture
def preparation(shared: StudyPreparation) -> StudyPreparation:
    """Give the dashboard as it was first, whatever the test before did to it."""
    shared.controls.choose(CLIPS)
    shared.controls.methods.value = ["uniform", "scs"]
    shared.controls.set_count(4, None)
    return shared


def test_what_is_chosen_becomes_a_study(preparation: StudyPreparation, tmp_path: Path) -> None:
    """Each clip with its original and each method, an exercise, and what participants read."""
    path = preparation.save(tmp_path / "new folder" / "mine")
    assert path.name == "mine.sqlite"
    design = load_design(path)
    assert [s.key for s in design.stimuli] == [
        ("methods", clip, name) for clip in CLIPS for name in ("original", "uniform", "scs")
    ]
    assert {s.parameters["count"] for s in design.stimuli if s.name != "original"} == {4}
    assert design.practice[0].parameters["clip"] == "cmu/01_01-turn"
    assert design == preparation.design


def test_saliency_decides_the_count_of_all_methods(preparation: StudyPreparation) -> None:
    """By its own rule on the part that is shown, clip by clip."""
    preparation.controls.set_count(None, None)
    for item in preparation.design.items:
        motion = load(item[0].motion)[: item[0].parameters["frames"]]
        expected = len(Saliency().select(PoseSpace(motion)))
        assert {s.parameters["count"] for s in item[1:]} == {expected}


def test_a_method_with_settings_has_a_name_of_its_own() -> None:
    """So the suggested parameters can be compared with others, as in the second test case."""
    loose = Method("loose", "saliency", {"sigma": 15.0, "n_components": 5})
    preparation = prepare_study(CLIPS[:1], ["saliency", loose], count=3, seconds=0.5, exercise=None)
    stimuli = preparation.design.stimuli
    assert [s.name for s in stimuli] == ["original", "saliency", "loose"]
    assert stimuli[2].parameters["settings"] == {"sigma": 15.0, "n_components": 5}
    assert preparation.design.practice == ()
    preparation.close()


def test_clips_and_the_question_may_have_names_of_their_own() -> None:
    """So that answers can be set beside those that the thesis published."""
    preparation = prepare_study(
        {"walking": CLIPS[1]},
        [Method("decimation", "optimal")],
        test_case="contact handling",
        count=3,
        seconds=0.5,
        exercise=None,
    )
    assert [s.key for s in preparation.design.stimuli] == [
        ("contact handling", "walking", "original"),
        ("contact handling", "walking", "decimation"),
    ]
    assert preparation.design.stimuli[0].parameters["clip"] == CLIPS[1]
    preparation.close()


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("/no/such.bvh", "no/such"),
        ("uci/iris", "got a table, want a motion"),
    ],
    ids=["a missing file", "a table"],
)
def test_a_clip_that_cannot_be_shown_is_told(
    preparation: StudyPreparation, name: str, words: str, tmp_path: Path
) -> None:
    """The others stay, nothing is stored, and without it the study is complete again."""
    preparation.controls.choose([*CLIPS, name])
    assert words in preparation.message
    assert words in preparation.view.message.value
    assert preparation.controls.save.disabled
    assert CLIPS[1] in preparation.view.table.value
    with pytest.raises(WorkbenchError, match=r"iris|no/such"):
        preparation.save(tmp_path / "study")
    assert not list(tmp_path.iterdir())
    preparation.controls.choose(CLIPS)
    assert preparation.message == ""
    assert not preparation.controls.save.disabled


@pytest.mark.parametrize("part", ["clips", "methods"])
def test_what_is_still_to_be_chosen_is_told(preparation: StudyPreparation, part: str) -> None:
    """Without a clip or a method there is no study."""
    getattr(preparation.controls, part).value = []
    assert f"Choose at least one {part[:-1]}." in preparation.view.message.value
    assert preparation.controls.save.disabled


def test_a_study_that_is_there_is_kept(preparation: StudyPreparation, tmp_path: Path) -> None:
    """The button says so in words; the file with its answers stays as it is."""
    path = preparation.save(tmp_path / "study")
    before = path.read_bytes()
    preparation.controls.file.value = str(path)
    preparation.controls.seed.value += 1
    preparation.controls.save.click()
    assert "is there already, want the name of a new file" in preparation.view.saved.value
    assert path.read_bytes() == before
    preparation.controls.file.value = str(tmp_path / "another")
    preparation.controls.save.click()
    assert "another.sqlite" in preparation.view.saved.value
    assert len(study_stimuli(tmp_path / "another.sqlite")) == 6


def test_the_preview_shows_what_was_made(preparation: StudyPreparation) -> None:
    """With the methods' names, clip by clip, and anew when the keyframes change."""
    preparation.view.shown.value = CLIPS[0]
    assert preparation.view.player.motions == ["original", "uniform", "scs"]
    before = bytes(preparation.view.player.get_state()["positions"])
    preparation.controls.set_count(3, None)
    assert preparation.view.shown.value == CLIPS[0]
    assert bytes(preparation.view.player.get_state()["positions"]) != before


def test_two_files_of_one_name_are_told_apart_or_refused(
    preparation: StudyPreparation, tmp_path: Path
) -> None:
    """In tables and in the study's file nothing would tell their stimuli apart."""
    files = [tmp_path / folder / "walk.bvh" for folder in ("a", "b")]
    for file in files:
        file.parent.mkdir()
        write_bvh(load(CLIPS[1])[:80], file)
    preparation.controls.choose([str(file) for file in files])
    assert "would both be called walk" in preparation.message
    assert preparation.controls.save.disabled
    other = files[1].rename(tmp_path / "b" / "run.bvh")
    preparation.controls.choose([str(files[0]), str(other)])
    assert preparation.message == ""
    assert [item[0].motion for item in preparation.design.items] == ["walk", "run"]


def test_a_count_and_a_share_together_are_refused() -> None:
    """One of them would be dropped silently."""
    with pytest.raises(WorkbenchError, match=r"count and ratio: got 4 and 0\.05, want at most one"):
        prepare_study(CLIPS[:1], ["uniform"], count=4, ratio=0.05)


def test_the_length_tells_after_how_many_participants_orders_are_balanced(
    preparation: StudyPreparation,
) -> None:
    """Who begins counts, done or not."""
    assert "each 6 participants who begin." in preparation.view.message.value


@pytest.mark.parametrize("folder", ["studies", "elsewhere"])
def test_the_link_for_participants_tells_a_folder_only_if_it_must(
    preparation: StudyPreparation,
    folder: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A study among the others is called by its name."""
    monkeypatch.setenv("WORKBENCH_STUDIES", str(tmp_path / "studies"))
    monkeypatch.setenv("SERVER_SOFTWARE", "voila/0")
    preparation.view.show_saved(tmp_path / folder / "mine.sqlite")
    [asked] = re.findall(r"take_part\.ipynb\?study=([^\"&]*)", preparation.view.saved.value)
    expected = "mine.sqlite" if folder == "studies" else str(tmp_path / folder / "mine.sqlite")
    assert unquote(asked) == expected


def test_the_preparation_says_that_the_files_name_is_seen(preparation: StudyPreparation) -> None:
    """Before the study is made, so that it is not called after a method."""
    parts = list(preparation.view.root.children)
    below = parts[parts.index(preparation.controls.file_row) + 1]
    assert "Participants can read the file's name" in below.value


def test_an_unknown_method_is_refused() -> None:
    """In Python, where whoever wrote it sees the message."""
    with pytest.raises(WorkbenchError, match="selector: got 'none'"):
        prepare_study(CLIPS, ["none"])


def test_making_stimuli_can_be_cancelled_and_begun_again() -> None:
    """Inside a notebook's loop; what is missing then is said, and nothing can be stored."""

    async def prepare() -> None:
        preparation = prepare_study(
            CLIPS[:1], ["uniform"], count=4, seconds=0.5, exercise=None, file="/nowhere/study"
        )
        preparation.view.progress.cancel.click()
        await preparation.finished()
        assert preparation.message == f"{CLIPS[0]}: cancelled"
        assert preparation.controls.save.disabled
        preparation.view.progress.again.click()
        await preparation.finished()
        assert preparation.message == ""
        assert not preparation.controls.save.disabled
        preparation.close()

    asyncio.run(prepare())


def test_what_failed_with_other_settings_does_not_hold_up_a_new_start(
    preparation: StudyPreparation, tmp_path: Path
) -> None:
    """One press of "again" makes everything anew, though another clip could not be shown."""
    preparation.controls.choose([*CLIPS, str(tmp_path / "none.bvh")])
    assert preparation.message
    preparation.controls.choose(CLIPS)
    before = preparation.design.stimuli
    preparation.view.progress.again.click()
    after = preparation.design.stimuli
    assert after == before
    assert all(new is not old for new, old in zip(after, before, strict=True))
