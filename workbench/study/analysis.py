"""The answers of a study, motion by motion, as the tables of Halit 2010, chapter 5, have them."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from workbench.errors import DegenerateDataWarning, WorkbenchError
from workbench.study.answers import motions_of, ratings_of
from workbench.study.comparisons import PairedComparison, compare_stimuli
from workbench.study.stimuli import ORIGINAL

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False)
class MotionAnalysis:
    """What participants say of one motion.

    Attributes
    ----------
    title : str
        Test case and motion.
    ratings : DataFrame of shape (n_participants, n_stimuli)
        As from :func:`workbench.study.answers.ratings_of`.
    comparisons : tuple of PairedComparison
        Each pair of stimuli, corrected for their number; empty if they cannot be compared.
    missing : str
        Why not; empty if they can.
    """

    title: str
    ratings: pd.DataFrame
    comparisons: tuple[PairedComparison, ...]
    missing: str = ""


def analyse_answers(answers: pd.DataFrame) -> list[MotionAnalysis]:
    """Compare the stimuli of each motion by paired t tests.

    Where a test case has several motions, the mean over its motions follows: the tests are then
    made on one number for each participant and stimulus, over the motions that the participant
    rated completely. It has only stimuli that all motions of the test case have, and is left out
    where there are not two of them.

    Parameters
    ----------
    answers : DataFrame
        As from :func:`workbench.study.answers.check_answers`.

    Returns
    -------
    list of MotionAnalysis
        In the order in which the participant with most answers gave them, means behind the
        motions of their test case. Stimuli have the same order in all motions of a test case.

    Examples
    --------
    >>> import pandas as pd
    >>> from workbench.study.answers import check_answers
    >>> rows = [(1, "a", 7), (1, "b", 5), (2, "a", 9), (2, "b", 8)]
    >>> columns = ["participant", "stimulus", "rating"]
    >>> frame = pd.DataFrame(rows, columns=columns).assign(test_case="methods", motion="walk")
    >>> [found] = analyse_answers(check_answers(frame))
    >>> found.comparisons[0].mean_difference
    1.5
    """
    found: list[MotionAnalysis] = []
    answers = _fullest_first(answers)
    motions = motions_of(answers)
    for case in dict.fromkeys(case for case, _ in motions):
        names = [motion for other, motion in motions if other == case]
        tables = _alike([ratings_of(answers, case, name) for name in names])
        found += [
            _analysis(f"{case}: {name}", table) for name, table in zip(names, tables, strict=True)
        ]
        shared = _shared(tables)
        if len(names) > 1 and len(shared) > 1:
            partly = any(len(table.columns) > len(shared) for table in tables)
            title = f"{case}: mean over {len(names)} motions"
            title += " (only stimuli that all of them have)" if partly else ""
            found.append(_analysis(title, _mean([table[shared] for table in tables])))
    return found


def _fullest_first(answers: pd.DataFrame) -> pd.DataFrame:
    """Move the participant with most answers to the front, where order is taken from."""
    fullest = answers["participant"].value_counts(sort=False).idxmax()
    rank = answers["participant"] != fullest
    return answers.loc[rank.sort_values(kind="stable").index]


def _alike(tables: Sequence[pd.DataFrame]) -> list[pd.DataFrame]:
    """Give the columns of several tables one order."""
    names = list(dict.fromkeys(name for table in tables for name in table.columns))
    names.sort(key=lambda name: name != ORIGINAL)
    return [table[[name for name in names if name in table.columns]] for table in tables]


def _shared(tables: Sequence[pd.DataFrame]) -> list[str]:
    """List the columns that all tables have."""
    first, *others = tables
    return [name for name in first.columns if all(name in table.columns for table in others)]


def _analysis(title: str, ratings: pd.DataFrame) -> MotionAnalysis:
    try:
        with warnings.catch_warnings():
            # The notes of the comparisons say it.
            warnings.simplefilter("ignore", DegenerateDataWarning)
            return MotionAnalysis(title, ratings, tuple(compare_stimuli(ratings)))
    except WorkbenchError as error:
        return MotionAnalysis(title, ratings, (), f"too few answers to compare: {error}")


def _mean(tables: Sequence[pd.DataFrame]) -> pd.DataFrame:
    """Average each participant's ratings over the motions rated completely by them."""
    import pandas as pd  # takes most of a second, and the command line needs none of it

    whole = pd.concat([table.dropna() for table in tables], sort=False)
    order = list(dict.fromkeys(index for table in tables for index in table.index))
    means = whole.groupby(level=0).mean()
    return means.reindex([index for index in order if index in means.index])
