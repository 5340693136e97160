"""The analysis shows what the answers give, and says what is missing."""

from __future__ import annotations

import base64
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy import stats

from workbench.dashboards import StudyAnalysis, analyse_study
from workbench.errors import WorkbenchError
from workbench.study.analysis import analyse_answers
from workbench.study.answers import Stimulus
from workbench.study.database import create_study, enrol_participant
from workbench.study.participation import rate
from workbench.study.reading import read_answers

NAMES = ("original", "saliency", "uniform")
STIMULI = [Stimulus("methods", motion, name) for motion in ("walk", "jump") for name in NAMES]
#: Ratings of the six stimuli by four participants.
RATINGS = np.array(
    [[9, 8, 4, 10, 7, 5], [7, 7, 5, 9, 9, 3], [8, 5, 6, 8, 6, 6], [10, 9, 7, 9, 5, 2]]
)


@pytest.fixture
def study(tmp_path: Path) -> Path:
    path = tmp_path / "study.sqlite"
    create_study(path, STIMULI)
    for row in RATINGS.tolist():
        person = enrol_participant(path)
        for stimulus, rating in zip(STIMULI, row, strict=True):
            rate(path, person, stimulus, rating)
    return path


def html(analysis: StudyAnalysis) -> str:
    return " ".join(
        part.value
        for part in analysis._results.children
        if isinstance(getattr(part, "value", 0), str)
    )


def cells(text: str) -> list[str]:
    return [re.sub("<[^>]*>", "", cell) for cell in re.findall(r"<td[^>]*>(.*?)</td>", text)]


def test_the_table_is_that_of_the_thesis(study: Path) -> None:
    """Mean difference and one-sided p of each pair, by scipy's paired t test."""
    analysis = analyse_study(study)
    assert [found.title for found in analysis.found] == [
        "methods: walk",
        "methods: jump",
        "methods: mean over 2 motions",
    ]
    walk = RATINGS[:, :3]
    expected = stats.ttest_rel(walk[:, 0], walk[:, 2])
    comparison = analysis.found[0].comparisons[1]
    assert comparison.label == "original − uniform"
    assert comparison.mean_difference == 3.0
    assert comparison.p_one_sided == pytest.approx(expected.pvalue / 2)
    shown = cells(html(analysis))
    assert f"3.00 / {expected.pvalue / 2:.2g}" in shown


def test_the_mean_over_motions_tests_one_number_of_each_participant(study: Path) -> None:
    """It equals the test of their averages."""
    found = analyse_study(study).found[-1]
    means = RATINGS.reshape(4, 2, 3).mean(axis=1)
    np.testing.assert_allclose(found.ratings.to_numpy(), means)
    expected = stats.ttest_rel(means[:, 1], means[:, 2])
    assert found.comparisons[2].t == pytest.approx(expected.statistic)


def test_the_mean_over_motions_has_only_what_all_of_them_have(study: Path) -> None:
    """A difference of stimuli would else be one of motions; with one in common there is none."""
    answers = read_answers(study)
    walk, uniform = answers["motion"] == "walk", answers["stimulus"] == "uniform"
    found = analyse_answers(answers[~(walk & uniform)])[-1]
    assert found.title == "methods: mean over 2 motions (only stimuli that all of them have)"
    means = RATINGS.reshape(4, 2, 3).mean(axis=1)[:, :2]
    np.testing.assert_allclose(found.ratings.to_numpy(), means)
    alone = answers[answers["stimulus"].eq("original") | walk & ~uniform | ~walk & uniform]
    assert [found.title for found in analyse_answers(alone)] == ["methods: walk", "methods: jump"]


def test_stimuli_have_one_order_in_all_motions(study: Path) -> None:
    """So a method has one colour, whatever was answered first; the original leads."""
    answers = read_answers(study)
    mixed = answers.drop(index=[0, 4]).iloc[::-1].reset_index(drop=True)
    columns = [list(found.ratings.columns) for found in analyse_answers(mixed)]
    assert columns[0][0] == "original"
    assert columns == [columns[0]] * 3


def test_a_clip_that_was_rated_by_one_is_told_and_the_others_are_shown(tmp_path: Path) -> None:
    """A sentence stands in the place of the table."""
    path = tmp_path / "study"
    create_study(path, STIMULI)
    person = enrol_participant(path)
    for stimulus in STIMULI[:3]:
        rate(path, person, stimulus, 5)
    analysis = analyse_study(path)
    assert "methods: walk: too few answers to compare" in html(analysis)
    assert "want at least 2" in html(analysis)


def test_answers_that_came_meanwhile_are_read(study: Path) -> None:
    """And a file that is gone leaves what was read before."""
    analysis = analyse_study(study)
    rate(study, enrol_participant(study), STIMULI[0], 1)
    analysis.read.click()
    assert analysis.answers is not None
    assert len(analysis.answers) == RATINGS.size + 1
    study.unlink()
    analysis.read.click()
    assert "There is no study in" in analysis.message
    assert "still shown" in analysis._about.value
    assert len(analysis.found) == 3


@pytest.mark.parametrize("way", ["the link", "Python"])
def test_the_answers_are_exported_as_csv(study: Path, tmp_path: Path, way: str) -> None:
    """They read back identically."""
    analysis = analyse_study(study)
    target = tmp_path / "answers.csv"
    if way == "Python":
        analysis.save_csv(target)
    else:
        text = re.search('base64,([^"]+)', analysis._about.value)
        assert text is not None
        target.write_bytes(base64.b64decode(text[1]))
    pd.testing.assert_frame_equal(read_answers(target), read_answers(study))


@pytest.mark.parametrize(
    ("make", "words"),
    [(None, "no study was prepared"), (STIMULI, "found no answer")],
    ids=["no file", "no answer"],
)
def test_nothing_to_analyse_is_told(
    make: list[Stimulus] | None, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An empty table would look like a result."""
    monkeypatch.setenv("WORKBENCH_STUDIES", str(tmp_path))
    if make:
        create_study(tmp_path / "study.sqlite", make)
    analysis = analyse_study()
    assert re.search(words, analysis.message, re.IGNORECASE)
    assert analysis.found == []
    with pytest.raises(WorkbenchError, match="got none so far"):
        analysis.save_csv(tmp_path / "answers.csv")


def test_each_bar_is_a_rating_with_the_mean_before_them(study: Path) -> None:
    """The mean has its interval, single ratings have none."""
    from workbench.dashboards.study.figures import rating_bars

    found = analyse_study(study).found[0]
    figure = rating_bars(found.ratings, "walk")
    assert [trace.name for trace in figure.data] == list(NAMES)
    assert list(figure.data[0].y) == [8.5, 9, 7, 8, 10]
    low, high = stats.t.interval(0.95, 3, 8.5, stats.sem(RATINGS[:, 0]))
    reach, *others = figure.data[0].error_y.array
    assert reach == pytest.approx((high - low) / 2)
    assert others == [None] * 4
    many = pd.concat([found.ratings] * 7, ignore_index=True)
    assert list(rating_bars(many, "walk").data[0].x) == ["mean"]
