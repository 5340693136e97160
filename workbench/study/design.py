"""A study as it was prepared: what is shown together, what is asked, and from which seed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from secrets import token_hex
from typing import Any

from workbench.errors import DataError, WorkbenchError
from workbench.study.answers import HIGHEST_RATING, LOWEST_RATING, Stimulus
from workbench.study.database import create_study, study_settings, study_stimuli
from workbench.study.order import presentations
from workbench.validation import whole_number

#: What is asked of each motion (Halit 2010, chapter 5, asks for its quality).
QUESTION = (
    f"How good is the quality of each motion? {LOWEST_RATING} is the lowest, "
    f"{HIGHEST_RATING} the highest."
)

#: What the estimate of a study's length takes: seconds to read and practise, plays of each
#: item, and seconds for each rating.
_INTRODUCTION, _PLAYS, _RATING = 90.0, 2.0, 6.0


@dataclass(frozen=True)
class StudyDesign:
    """Everything that decides what a participant sees.

    Attributes
    ----------
    stimuli : tuple of Stimulus
        What is rated. Those of one test case and motion are shown side by side.
    practice : tuple of Stimulus
        What is shown side by side first, of which no rating is stored; may be empty.
    seed : int
        Decides each participant's order.
    title : str
        What participants are told that it is about. They must not learn of methods from it.
    question : str
        What is asked.
    study_id : str
        Tells the file from those of all other studies, copies of the same design among them;
        empty as long as it is not stored.

    Examples
    --------
    >>> made = [Stimulus("methods", "walk", name) for name in ("original", "uniform")]
    >>> [[stimulus.name for stimulus in item] for item in StudyDesign(tuple(made)).items]
    [['original', 'uniform']]
    """

    stimuli: tuple[Stimulus, ...]
    practice: tuple[Stimulus, ...] = ()
    seed: int = 0
    title: str = "How motions look"
    question: str = QUESTION
    # No part of equality: two studies may show the same.
    study_id: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        whole_number("seed", self.seed, at_least=0)
        for item in (*self.items, *([self.practice] if self.practice else [])):
            if len(item) < 2:
                raise WorkbenchError(
                    f"stimuli: got only {item[0].name!r} for {item[0].motion!r}, "
                    "want at least two to compare"
                )

    @property
    def items(self) -> tuple[tuple[Stimulus, ...], ...]:
        """The stimuli by what is shown together, in order of appearance."""
        together: dict[tuple[str, str], list[Stimulus]] = {}
        for stimulus in self.stimuli:
            together.setdefault((stimulus.test_case, stimulus.motion), []).append(stimulus)
        return tuple(tuple(item) for item in together.values())

    @property
    def minutes(self) -> float:
        """How long a participant will take, roughly.

        Each item plays twice, each rating takes 6 s, the introduction a minute and a half.
        """
        played = sum(float(item[0].parameters.get("seconds", 0.0)) for item in self.items)
        return (_INTRODUCTION + _PLAYS * played + _RATING * len(self.stimuli)) / 60

    def shown_to(self, participant: int) -> list[tuple[Stimulus, ...]]:
        """Give the items in the order of one participant, each from left to right.

        Parameters
        ----------
        participant : int
            Number, from 1.

        Returns
        -------
        list of tuple of Stimulus
        """
        items = self.items
        return [
            tuple(items[shown.item][stimulus] for stimulus in shown.order)
            for shown in presentations([len(item) for item in items], participant, self.seed)
        ]


def store_design(path: str | Path, design: StudyDesign) -> None:
    """Make the file of a study, in which answers are then gathered, with an id of its own.

    Parameters
    ----------
    path : path-like
        The file. One that is there is kept.
    design : StudyDesign
        The study.

    Raises
    ------
    DataError
        If there is such a file, it cannot be written, or parameters are no JSON.
    WorkbenchError
        If there is no stimulus, or one comes twice.
    """
    settings = {
        # Drawn anew each time, whatever the seed: codes must not fit another file.
        "id": token_hex(8),
        "title": design.title,
        "question": design.question,
        "seed": design.seed,
        "practice": [_as_json(stimulus) for stimulus in design.practice],
    }
    create_study(path, design.stimuli, settings)


def load_design(path: str | Path) -> StudyDesign:
    """Read how a study was prepared.

    Raises
    ------
    DataError
        If the file is no study, is damaged, or was not made by :func:`store_design`.
    """
    stimuli, settings = study_stimuli(path), study_settings(path)
    try:
        return StudyDesign(
            tuple(stimuli),
            practice=_practice(settings["practice"]),
            seed=settings["seed"],
            title=str(settings["title"]),
            question=str(settings["question"]),
            study_id=str(settings["id"]),
        )
    except (KeyError, TypeError, WorkbenchError) as error:
        raise DataError(f"{path}: tells no design of a study ({error})") from None


def _as_json(stimulus: Stimulus) -> dict[str, Any]:
    test_case, motion, name = stimulus.key
    return {
        "test_case": test_case,
        "motion": motion,
        "stimulus": name,
        "parameters": dict(stimulus.parameters),
    }


def _practice(rows: Sequence[Any]) -> tuple[Stimulus, ...]:
    return tuple(
        Stimulus(row["test_case"], row["motion"], row["stimulus"], row["parameters"])
        for row in rows
    )
