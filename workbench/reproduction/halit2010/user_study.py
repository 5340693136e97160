"""Figures and Tables 5.1 to 5.9 of Halit 2010: what participants rated, compared in pairs.

The raw answers were not published. Without a study file the figures show the published mean
differences with the intervals that the printed p values imply.
"""

from __future__ import annotations

import json
import math
import warnings
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import pandas as pd

from workbench.errors import DataError, DegenerateDataWarning, WorkbenchError
from workbench.experiments.bootstrap import bootstrap
from workbench.reproduction.claims import Evidence
from workbench.reproduction.published import published
from workbench.study.answers import motions_of, ratings_of
from workbench.study.comparisons import PairedComparison, compare_stimuli
from workbench.study.published_tests import implied_comparisons
from workbench.study.reading import read_answers

#: Participants of each of the published tests.
N_PARTICIPANTS = 20

#: Between the names of two stimuli whose ratings are subtracted.
MINUS = " \N{MINUS SIGN} "


@dataclass(frozen=True)
class RatedMotion:
    """A motion that participants rated, in one figure and one table of the thesis.

    Attributes
    ----------
    number : int
        5.``number`` is that of its figure and its table.
    test_case, motion : str
        As in a study file.
    setting : str
        How the rated motions were made, as far as the thesis tells.
    """

    number: int
    test_case: str
    motion: str
    setting: str

    @property
    def figure_id(self) -> str:
        """Id of the figure."""
        return f"halit2010:fig5.{self.number}"

    @property
    def table_id(self) -> str:
        """Id of the table."""
        return f"halit2010:tab5.{self.number}"

    @property
    def title(self) -> str:
        """Test case and motion: "methods, basketball"."""
        return f"{self.test_case}, {self.motion}"


#: In a study file these are the test cases and motions; the stimuli are called as in the rows of
#: the published tables, in lower case: "original", "saliency", "contact handling", …
RATED = (
    RatedMotion(1, "methods", "basketball", "559 keyframes of 4905 frames for each method"),
    RatedMotion(2, "methods", "boxing", "305 keyframes of 3000 frames for each method"),
    RatedMotion(3, "methods", "walking", "23 keyframes of 800 frames for each method"),
    RatedMotion(4, "parameters", "basketball", "σ and k as suggested, or both outside of it"),
    RatedMotion(5, "parameters", "flip", "σ as suggested, or outside of it"),
    RatedMotion(6, "parameters", "walking", "σ and k as suggested, or both outside of it"),
    RatedMotion(7, "contact handling", "basketball", "300 keyframes with it, 390 without"),
    RatedMotion(8, "contact handling", "dancing", "126 keyframes with it, 143 without"),
    RatedMotion(9, "contact handling", "walking", "23 keyframes with it and without"),
)


@dataclass(frozen=True)
class Result:
    """What was rated of one motion, by participants of ours and of the thesis.

    Attributes
    ----------
    rated : RatedMotion
        Which motion.
    theirs : tuple of PairedComparison
        As printed, and what that implies.
    ours : tuple of PairedComparison
        From the study file; empty if it has no answers to this motion.
    ratings : DataFrame or None
        Those answers, by participant and stimulus.
    missing : str
        Why there are none of ours.
    """

    rated: RatedMotion
    theirs: tuple[PairedComparison, ...]
    ours: tuple[PairedComparison, ...] = ()
    ratings: pd.DataFrame | None = None
    missing: str = ""


def read_study_file(study: str | Path | None) -> pd.DataFrame | None:
    """Read the answers of a study, or give None where there is no study file.

    Raises
    ------
    DataError
        If the file cannot be read, or has no answer to any motion of the thesis.
    """
    if study is None:
        return None
    answers = read_answers(study)
    wanted = [(rated.test_case, rated.motion) for rated in RATED]
    if not set(motions_of(answers)) & set(wanted):
        raise DataError(
            f"{study}: has no answer to a test case and motion of the thesis, want some of "
            f"{'; '.join(' / '.join(pair) for pair in wanted)}"
        )
    return answers


def printed_table(rated: RatedMotion) -> dict[tuple[str, str], tuple[float, float]]:
    """Give the mean difference and the p value that are printed for each pair of stimuli."""
    rows = published(rated.table_id).rows or {}
    table = {}
    for label, (mean, p) in rows.items():
        first, second = label.split(MINUS)
        table[first, second] = mean, p
    return table


def results(answers: pd.DataFrame | None) -> list[Result]:
    """Gather what is known of each motion of the thesis.

    Parameters
    ----------
    answers : DataFrame or None
        From :func:`read_study_file`.

    Returns
    -------
    list of Result
        In the order of the thesis.
    """
    return [_result(rated, answers) for rated in RATED]


def rated_better_evidence(answers: pd.DataFrame | None) -> Evidence:
    """Look for a motion that is rated better although its error is higher.

    The errors are those that the study file tells: the number ``error`` in the parameters of
    a stimulus. Of all pairs of one motion with different errors, the one whose rating speaks
    most for the claim is taken, and its interval widened for the number of pairs
    (Bonferroni), because it was chosen after looking.

    Parameters
    ----------
    answers : DataFrame or None
        From :func:`read_study_file`.

    Returns
    -------
    Evidence
        Over participants.
    """
    if answers is None:
        return Evidence(
            None,
            units="participants",
            note="The raw answers were not published. Table 5.9 prints 0.75 points for contact "
            "handling at an error of 0.0015 against 0.0001 (one-sided p = 0.039, two-sided "
            "0.078), but its p values contradict each other.",
        )
    found: list[tuple[str, pd.Series]] = []
    for test_case, motion in motions_of(answers):
        ratings = ratings_of(answers, test_case, motion)
        errors = _errors(answers, test_case, motion)
        for low, high in combinations(sorted(errors, key=errors.__getitem__), 2):
            difference = (ratings[high] - ratings[low]).dropna()
            if errors[low] < errors[high] and len(difference) > 1:
                found.append((f"{test_case}, {motion}: {high}{MINUS}{low}", difference))
    if not found:
        return Evidence(
            None,
            units="participants",
            note="The study file tells no different errors of two stimuli of one motion (the "
            "number 'error' in their parameters).",
        )
    label, difference = max(found, key=lambda pair: float(pair[1].mean()))
    estimate = bootstrap(
        difference.to_numpy(), lambda values: float(values.mean()), level=1 - 0.05 / len(found)
    )
    return Evidence(
        estimate, units="participants", note=f"{label}; the largest of {len(found)} pairs."
    )


def _result(rated: RatedMotion, answers: pd.DataFrame | None) -> Result:
    theirs = tuple(implied_comparisons(printed_table(rated), N_PARTICIPANTS))
    if answers is None:
        return Result(rated, theirs, missing="The raw answers were not published.")
    try:
        ratings = ratings_of(answers, rated.test_case, rated.motion)
    except DataError:
        return Result(rated, theirs, missing="The study file has no answers to this motion.")
    try:
        with warnings.catch_warnings():
            # The notes of the comparisons say it, in the caption.
            warnings.simplefilter("ignore", DegenerateDataWarning)
            ours = tuple(compare_stimuli(ratings))
    except WorkbenchError as error:
        return Result(rated, theirs, ratings=ratings, missing=f"No comparison of ours: {error}.")
    return Result(rated, theirs, ours, ratings)


def _errors(answers: pd.DataFrame, test_case: str, motion: str) -> dict[str, float]:
    """Find the errors that a study file tells of the stimuli of a motion."""
    chosen = answers[(answers["test_case"] == test_case) & (answers["motion"] == motion)]
    made = chosen.drop_duplicates("stimulus").set_index("stimulus")["parameters"]
    told = {str(name): json.loads(text).get("error") for name, text in made.items()}
    return {
        name: float(error)
        for name, error in told.items()
        if isinstance(error, (int, float)) and math.isfinite(error)
    }
