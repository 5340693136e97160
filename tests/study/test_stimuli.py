"""What a study shows can be made again exactly from what its file tells."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from workbench.datasets import load, load_space
from workbench.errors import DataError, WorkbenchError
from workbench.interpolation.slerp import Slerp
from workbench.mocap.bvh_writer import write_bvh
from workbench.mocap.motion import Motion
from workbench.selection.saliency import Saliency
from workbench.study import design
from workbench.study.answers import Stimulus
from workbench.study.database import create_study
from workbench.study.design import StudyDesign, load_design, store_design
from workbench.study.order import participant_code
from workbench.study.run import StudyRun
from workbench.study.stimuli import Clip, Method, make_stimuli, practice_stimuli, stimulus_motion

JUMP = "cmu/01_01-jump"


@pytest.fixture(scope="module")
def jump() -> Motion:
    return load(JUMP)


@pytest.fixture(scope="module")
def clip(jump: Motion) -> Clip:
    return Clip.from_start(JUMP, jump)


def test_methods_get_as_many_keyframes_as_saliency_finds(clip: Clip) -> None:
    """Without a count, the saliency method's own rule decides for all, with its settings."""
    methods = [Method("fine", "saliency", {"sigma": 3.0}), "uniform", "scs"]
    _, fine, *others = make_stimuli(clip, methods)
    expected = Saliency(3.0).select(load_space(JUMP))
    assert fine.parameters["keyframes"] == expected.tolist()
    assert {stimulus.parameters["count"] for stimulus in others} == {len(expected)}


def test_a_stimulus_is_made_again_from_its_study_file(
    clip: Clip, jump: Motion, tmp_path: Path
) -> None:
    """Keyframes are the original's, frames between them slerp's, the root's path the original's."""
    made = make_stimuli(clip, ["uniform"], ratio=0.03, random_state=4)
    store_design(tmp_path / "study", StudyDesign(made, practice_stimuli(clip), seed=5))
    stored = load_design(tmp_path / "study")
    assert stored == StudyDesign(made, practice_stimuli(clip), seed=5)
    original, rebuilt = (stimulus_motion(stimulus) for stimulus in stored.stimuli)
    np.testing.assert_array_equal(original.rotations, jump.rotations)
    keyframes = np.linspace(0, len(jump) - 1, 9).round().astype(int)
    expected = Slerp().interpolate(jump, keyframes)
    np.testing.assert_allclose(rebuilt.rotations, expected, atol=1e-12)
    np.testing.assert_array_equal(rebuilt.rotations[keyframes], jump.rotations[keyframes])
    np.testing.assert_array_equal(rebuilt.root_translation, jump.root_translation)


def test_parameters_tell_the_error_of_what_is_shown(clip: Clip, jump: Motion) -> None:
    """It is the mean over frames of the distance of poses per joint, 0 for the original."""
    original, rebuilt = make_stimuli(clip, ["uniform"], count=5)
    space = load_space(JUMP)
    errors = space.errors(np.arange(len(space)), stimulus_motion(rebuilt).rotations)
    assert rebuilt.parameters["error"] == pytest.approx(errors.mean(), rel=1e-9)
    assert original.parameters["error"] == 0.0


def test_only_the_first_seconds_are_shown(jump: Motion) -> None:
    """The part is cut before keyframes are chosen, and made again as the same part."""
    part = Clip.from_start(JUMP, jump, seconds=1.0)
    _, rebuilt = make_stimuli(part, ["uniform"], count=3)
    frames = round(1.0 / jump.frame_time)
    assert rebuilt.parameters["keyframes"][-1] == frames - 1
    assert len(stimulus_motion(rebuilt)) == frames
    with pytest.raises(WorkbenchError, match="got 1 frames to show, want at least 3"):
        Clip.from_start(JUMP, jump, seconds=0.01)


def test_practice_shows_a_clear_difference(clip: Clip) -> None:
    """Its second motion has few keyframes and a large error, and is no stimulus of the study."""
    original, rough = practice_stimuli(clip)
    assert original.parameters["error"] == 0.0
    assert rough.parameters["count"] <= 2 * rough.parameters["seconds"]
    assert rough.test_case == "practice"


@pytest.mark.parametrize(
    ("methods", "message"),
    [
        ([], "got none"),
        (["uniform", "uniform"], "names of their own"),
        ([Method("original", "uniform")], "none of them 'original'"),
        (["unknown"], "selector: got 'unknown'"),
    ],
    ids=["none", "twice", "named as the original", "unknown"],
)
def test_methods_that_cannot_be_compared_are_refused(
    clip: Clip, methods: list[str | Method], message: str
) -> None:
    """The message says what is wrong with them."""
    with pytest.raises(WorkbenchError, match=message):
        make_stimuli(clip, methods, count=4)


@pytest.mark.parametrize("edited", ["the root's path", "the speed"])
def test_a_clip_that_was_edited_is_refused(jump: Motion, tmp_path: Path, edited: str) -> None:
    """Participants would see something else than those before them."""
    path = tmp_path / "own.bvh"
    write_bvh(jump[:60], path)
    original, _ = make_stimuli(Clip.from_start(str(path), load(path)), ["uniform"], count=4)
    changes = {
        "the root's path": {"root_translation": jump.root_translation - [0.0, 1.0, 0.0]},
        "the speed": {"frame_time": 2 * jump.frame_time},
    }
    write_bvh(replace(jump, **changes[edited])[:60], path)
    with pytest.raises(DataError, match="is not the motion with which the study was prepared"):
        stimulus_motion(original)
    write_bvh(jump[:60], path)
    assert len(stimulus_motion(original)) == 60


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"interpolator": "linear"}, "want 'slerp'"),
        ({"clip": "uci/iris"}, "got a table"),
        ({"frames": "many"}, "do not tell how it was made"),
        ({"clip": "/no/such/clip.bvh"}, "no/such/clip"),
    ],
    ids=["interpolator", "table", "frames", "missing clip"],
)
def test_parameters_that_make_no_motion_are_refused(
    clip: Clip, change: dict[str, object], message: str
) -> None:
    """Nothing else is shown in its place."""
    _, stimulus = make_stimuli(clip, ["uniform"], count=4)
    wrong = Stimulus(*stimulus.key, {**stimulus.parameters, **change})
    with pytest.raises(DataError, match=message):
        stimulus_motion(wrong)


def test_a_code_of_one_study_is_nobodys_in_another(
    clip: Clip, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Even if both have the same seed, and number 1 took part in both; orders are the same."""
    ids = iter(["1" * 16, "2" * 16])
    monkeypatch.setattr(design, "token_hex", lambda _: next(ids))
    made = make_stimuli(clip, ["uniform"], count=4)
    runs = []
    for name in ("pilot", "real"):
        store_design(tmp_path / name, StudyDesign(made))
        runs.append(StudyRun.begin(tmp_path / name))
    pilot, real = runs
    assert pilot.items == real.items
    assert StudyRun.resume(tmp_path / "pilot", pilot.code).participant == 1
    with pytest.raises(WorkbenchError, match="code: got"):
        StudyRun.resume(tmp_path / "real", pilot.code)


def test_each_stored_study_has_an_id_of_its_own(clip: Clip, tmp_path: Path) -> None:
    """It is drawn when the file is made, and stays."""
    made = make_stimuli(clip, ["uniform"], count=4)
    for name in ("one", "two"):
        store_design(tmp_path / name, StudyDesign(made))
    one, two = load_design(tmp_path / "one"), load_design(tmp_path / "two")
    assert one == two
    assert one.study_id != two.study_id
    assert one.study_id == load_design(tmp_path / "one").study_id


def test_a_code_that_was_not_given_yet_is_nobodys(clip: Clip, tmp_path: Path) -> None:
    """As of a file that was restored from before somebody began."""
    store_design(tmp_path / "study", StudyDesign(make_stimuli(clip, ["uniform"], count=4)))
    code = participant_code(1, load_design(tmp_path / "study").study_id)
    with pytest.raises(WorkbenchError, match="which nobody was given") as caught:
        StudyRun.resume(tmp_path / "study", code)
    assert not isinstance(caught.value, DataError)


def test_a_study_without_a_design_says_so(tmp_path: Path) -> None:
    """A file of answers that was made elsewhere can be analysed, not taken part in."""
    create_study(tmp_path / "study", [Stimulus("a", "b", "c"), Stimulus("a", "b", "d")])
    with pytest.raises(DataError, match="tells no design of a study"):
        load_design(tmp_path / "study")


def test_one_motion_alone_cannot_be_compared() -> None:
    """An item needs two stimuli."""
    with pytest.raises(WorkbenchError, match="got only 'original' for 'walk'"):
        StudyDesign((Stimulus("methods", "walk", "original"),))
