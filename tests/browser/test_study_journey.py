"""A participant's way through a study in JupyterLab, by keyboard, with a reload in the middle."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import nbformat
import pytest

from tests.browser.axe import violations
from tests.browser.chromium import Visit
from tests.browser.lab import Lab, in_kernel, open_and_run
from workbench.datasets import load
from workbench.study.analysis import analyse_answers
from workbench.study.database import read_study
from workbench.study.design import StudyDesign, store_design
from workbench.study.run import StudyRun
from workbench.study.stimuli import Clip, make_stimuli, practice_stimuli

pytestmark = pytest.mark.browser

_ALL_TEXT = "(outputs) => outputs.map((output) => output.outerHTML)"

#: A study that is made within a moment.
SMALL = '["cmu/01_01-jump"], ["uniform", "pb"], count=3, seconds=0.5'


@pytest.fixture
def study(tmp_path: Path) -> Path:
    """Make a study of two clips, half a second each, by two methods."""
    parts = [
        Clip.from_start(name, load(name), seconds=0.5)
        for name in ("cmu/01_01-jump", "cmu/01_03-walk")
    ]
    stimuli = [s for part in parts for s in make_stimuli(part, ["uniform", "pb"], count=3)]
    path = tmp_path / "study.sqlite"
    store_design(path, StudyDesign(tuple(stimuli), practice_stimuli(parts[0]), seed=1))
    return path


@pytest.fixture
def notebook(lab: Lab, study: Path) -> str:
    """Put the participants' notebook with this study among those of JupyterLab."""
    return with_study(lab, "take_part", study)


def with_study(lab: Lab, name: str, study: Path) -> str:
    """Copy a notebook, with the path of a study for its parameter."""
    page = nbformat.read(lab.folder / f"{name}.ipynb", as_version=4)
    for cell in page.cells:
        if cell.id == "parameters":
            cell.source = f"study = {str(study)!r}"
        cell.source = cell.source.replace("prepare_study(file", f"prepare_study({SMALL}, file")
    nbformat.write(page, lab.folder / f"{name}_here.ipynb")
    return f"{name}_here.ipynb"


def rate(page: Any, *digits: str) -> None:
    """Rate figures from the first one on: a digit each, and Tab to the next."""
    page.wait_for_function("document.querySelector('.wb-rating fieldset:not([disabled])')")
    page.wait_for_function("document.activeElement.matches('.wb-rating-heading')")
    for digit in digits:
        page.keyboard.press("Tab")
        page.keyboard.press(digit)


def go_on(page: Any, button: str) -> None:
    """Go to the button behind the last figure, which is there when all is stored, and press it."""
    page.wait_for_function("!document.querySelector('.wb-rating-onward').disabled")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent") == button
    page.keyboard.press("Enter")


def item(page: Any, name: str) -> None:
    """Wait for an item."""
    page.wait_for_function(
        "(name) => document.querySelector('.wb-rating-heading')?.textContent === name", arg=name
    )


def test_a_participant_goes_through_a_study_by_keyboard(
    lab: Lab, notebook: str, study: Path, visit: Visit
) -> None:
    """Exercise, two movements, a reload in the middle of the second: the file has it all."""
    page = visit.page
    open_and_run(page, lab, notebook)
    page.get_by_role("button", name="Begin").focus()
    assert violations(page, ".jp-OutputArea-output") == []
    page.keyboard.press("Enter")
    item(page, "Exercise")
    rate(page, "9", "2")
    go_on(page, "Start")
    item(page, "Movement 1 of 2")
    rate(page, "5", "7", "0")
    go_on(page, "Next movement")
    item(page, "Movement 2 of 2")
    rate(page, "3")
    page.locator(".wb-rating-state[title=stored]").first.wait_for()
    code = StudyRun(study, 1).code
    assert f"Your code is {code}" in page.locator(".wb-rating").inner_text()
    assert violations(page, ".jp-OutputArea-output") == []

    shown = " ".join(page.locator(".jp-OutputArea-output").evaluate_all(_ALL_TEXT))
    assert "Movement 2 of 2" in shown
    assert not re.search("original|uniform|cmu|walk|jump", shown)

    open_and_run(page, lab, notebook)
    item(page, "Movement 2 of 2")
    page.locator(".wb-rating-state[title=stored]").first.wait_for()
    assert page.get_by_text(f"You go on as {code}.").is_visible()
    assert violations(page, ".jp-OutputArea-output") == []
    assert page.locator(".wb-rating input:checked").evaluate_all(
        "(inputs) => inputs.map((input) => input.value)"
    ) == ["3"]
    rate(page, "3", "4", "8")
    go_on(page, "Finish")
    page.get_by_text(f"You took part as {code}").wait_for()

    answers = read_study(study).sort_values("position")
    assert answers["rating"].tolist() == [5, 7, 10, 3, 4, 8]
    shown = [s.name for item in StudyRun(study, 1).items for s in item]
    assert answers["stimulus"].tolist() == shown
    assert in_kernel(page, "print(page.run.participant, page.failure)").split() == ["1"]


def test_a_study_is_prepared_and_analysed(lab: Lab, tmp_path: Path, visit: Visit) -> None:
    """Its file is made by a button; answers that come then are read by another one."""
    page, study = visit.page, tmp_path / "made here.sqlite"
    open_and_run(page, lab, with_study(lab, "user_study", study))
    page.get_by_text("ratings, about").wait_for()
    assert page.get_by_text("There is no study in").is_visible()
    page.get_by_role("button", name="Make the study").click()
    page.get_by_text("Participants open the notebook").wait_for()
    for participant in range(1, 4):
        run = StudyRun.begin(study)
        for index, shown in enumerate(run.items):
            for place, stimulus in enumerate(shown):
                run.rate(index, place, 8 - len(stimulus.name) % 5 + (index + participant) % 3)
            run.settle(index, run.ratings(index))

    page.get_by_role("button", name="Read answers").click()
    page.get_by_text("9 ratings by 3 participants").wait_for()
    # One table of what is shown, and two of the answers.
    page.locator(".wb-study-table").nth(2).wait_for()
    page.locator(".js-plotly-plot").wait_for()
    assert violations(page, ".jp-OutputArea-output") == []
    found = in_kernel(page, "print(*(c.mean_difference for c in analysis.found[0].comparisons))")
    expected = analyse_answers(read_study(study))[0].comparisons
    assert [float(mean) for mean in found.split()] == [c.mean_difference for c in expected]
