"""Lessons: exercises whose answers a cell of a notebook checks in plain words.

A lesson is a notebook beside a module of this package, ``lesson_1`` and so on, which holds
its exercises with their solutions, the mistakes that are often made and a hint for each. The
notebook keeps what a student reads and does::

    lesson = Lesson(1, solutions=solutions)

    answer = ...
    lesson.check("kept-neighbours", answer, distances=distances, embedding=embedding)

Right answers are computed from what the cell gives, so a check holds for other data and other
seeds too. ``solutions=True`` takes the lesson's own solution wherever an exercise is unsolved,
and shows its code.
"""

from __future__ import annotations

from workbench.teaching.answers import Array, Choice, Number, Samples, UnreadableAnswerError
from workbench.teaching.exercises import (
    Exercise,
    FunctionExercise,
    Mistake,
    OpenExercise,
    Question,
    Verdict,
)
from workbench.teaching.feedback import Feedback, Progress
from workbench.teaching.lesson import Lesson

__all__ = [
    "Array",
    "Choice",
    "Exercise",
    "Feedback",
    "FunctionExercise",
    "Lesson",
    "Mistake",
    "Number",
    "OpenExercise",
    "Progress",
    "Question",
    "Samples",
    "UnreadableAnswerError",
    "Verdict",
]
