"""A lesson: its exercises, and how many of them are solved."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

import workbench.teaching
from workbench.errors import WorkbenchError
from workbench.teaching.cell_errors import tell_errors
from workbench.teaching.exercises import Question, Verdict
from workbench.teaching.feedback import Feedback, Progress


class Lesson:
    """Check the answers of a lesson and keep count of what is solved.

    Parameters
    ----------
    number : int
        Number of the lesson; its exercises are in ``workbench.teaching.lesson_<number>``.
    solutions : bool
        Whether an unsolved exercise takes the lesson's own solution, for teachers and for
        runs without a student.

    Raises
    ------
    WorkbenchError
        If there is no such lesson.

    Examples
    --------
    >>> import numpy as np
    >>> lesson = Lesson(1)
    >>> lesson.check("distance", 5.0, samples=np.array([[0.0, 0.0], [3.0, 4.0]]), pair=(0, 1)).state
    'solved'
    >>> lesson.progress().sentence
    '1 of 6 exercises solved'
    """

    def __init__(self, number: int, *, solutions: bool = False) -> None:
        self.number = number
        self.solutions = solutions
        self._exercises = {exercise.key: exercise for exercise in _exercises(number)}
        self._verdicts: dict[str, Verdict] = {}
        tell_errors(self._stopped)

    def check(self, key: str, answer: Any = ..., **given: Any) -> Feedback:
        """Check the answer of an exercise.

        Nothing that a student gives makes it raise: what is wrong is told in the box that it
        returns.

        Parameters
        ----------
        key : str
            Which exercise.
        answer : object
            The student's answer; ``...`` stands for none.
        **given : object
            What the right answer depends on, such as the data.

        Returns
        -------
        Feedback
            Shown by a notebook as the last expression of a cell.

        Raises
        ------
        WorkbenchError
            If the lesson has no such exercise.
        """
        exercise = self._exercise(key)
        return self._told(key, *self._judged(exercise, answer, given))

    def progress(self) -> Progress:
        """Count the exercises that are solved."""
        return Progress(
            tuple(
                (key, key in self._verdicts and self._verdicts[key].state == "solved")
                for key in self._exercises
            )
        )

    def _told(self, key: str, verdict: Verdict, code: str = "") -> Feedback:
        self._verdicts[key] = verdict
        return Feedback(key, verdict, self.progress(), code)

    def _stopped(self, key: str, text: str) -> Feedback:
        """Tell of an exercise whose cell did not come to its check."""
        return self._told(key, Verdict("unreadable", text))

    def _exercise(self, key: str) -> Question:
        if key not in self._exercises:
            known = ", ".join(self._exercises)
            raise WorkbenchError(f"exercise: got {key!r}, want one of {known}")
        return self._exercises[key]

    def _judged(
        self, exercise: Question, answer: Any, given: Mapping[str, Any]
    ) -> tuple[Verdict, str]:
        """Judge an answer, or the solution in its place; give the code that was shown."""
        try:
            verdict = exercise.judge(answer, given)
            if verdict.state == "unsolved" and self.solutions:
                return exercise.judge(exercise.solve(given), given), exercise.solution_code
        except Exception as error:  # what the cell gives was changed; a student must read why
            return Verdict(
                "unreadable",
                "The answer could not be checked with what this cell gives to the check "
                f"({type(error).__name__}: {error}). Run the cells above once more.",
            ), ""
        return verdict, ""


def _exercises(number: int) -> Sequence[Question]:
    """Look up the exercises of a lesson."""
    known = sorted(
        int(module.name.removeprefix("lesson_"))
        for module in iter_modules(workbench.teaching.__path__)
        if module.name.startswith("lesson_")
    )
    if number not in known:
        raise WorkbenchError(f"lesson: got {number!r}, want one of {', '.join(map(str, known))}")
    found: Sequence[Question] = import_module(f"workbench.teaching.lesson_{number}").EXERCISES
    return found
