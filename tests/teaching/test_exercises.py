"""Judging answers: right, wrong in a known way, wrong, unreadable, none."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.teaching import (
    Exercise,
    FunctionExercise,
    Mistake,
    Number,
    OpenExercise,
)


def _twice(numbers):
    return 2.0 * numbers.sum()


TWICE = FunctionExercise(
    key="twice",
    task="Do it.",
    solution=_twice,
    praise="Right.",
    hint="Think.",
    kind=Number(),
    cases=lambda numbers: ((numbers,), (numbers[:1],)),
    mistakes=(
        Mistake(lambda numbers: 1.0 / (numbers.sum() - numbers.sum()), "never made"),
        Mistake(lambda numbers: numbers.sum(), "That is once."),
    ),
)
HALF = Exercise(
    key="half",
    task="Do it.",
    solution=lambda number: number / 2,
    praise="Right.",
    hint="Think.",
    kind=Number(),
    mistakes=(
        Mistake(lambda number: 1 / (number - number), "never made"),
        Mistake(lambda number: 2 * number, "That is twice."),
    ),
)
BELOW = OpenExercise(
    key="below",
    task="Do it.",
    solution=lambda limit: limit - 1,
    praise="Right.",
    hint="Think.",
    kind=Number(),
    fault=lambda answer, limit: None if answer < limit else f"{answer:g} is not below {limit}.",
)
NUMBERS = {"numbers": np.array([1.0, 2.0])}


def _raises(numbers):
    total = numbers.sum()
    return float(total) / len(numbers[:0])


def _spoils(numbers):
    total = 2.0 * numbers.sum()
    numbers[:] = 0.0
    return total


FUNCTIONS = {
    "right": (lambda numbers: sum(numbers) * 2, "solved", "Right."),
    "right, and changes its argument": (_spoils, "solved", "Right."),
    "a known mistake": (np.sum, "wrong", "That is once."),
    "an unknown mistake": (lambda numbers: 7.0, "wrong", "Think."),
    "right in the first case only": (lambda numbers: 6.0, "wrong", "Think."),
    "left as it is": (lambda numbers: ..., "unsolved", "Do it."),
    "no function yet": (..., "unsolved", "Do it."),
    "called, not given": (6.0, "unreadable", "without parentheses"),
    "returns nothing": (lambda numbers: None, "unreadable", "The function returns `None`"),
    "returns a text": (lambda numbers: "6", "unreadable", "The function returns the text '6'"),
    "returns nan": (lambda numbers: np.nan, "unreadable", "The function returns not a number"),
    "takes too much": (lambda numbers, more: 6.0, "unreadable", "must take 1 argument,"),
    "raises": (_raises, "unreadable", "at its line 3 with"),
    "runs for ever in circles": (
        lambda numbers: FUNCTIONS["runs for ever in circles"][0](numbers),
        "unreadable",
        "RecursionError",
    ),
}


@pytest.mark.parametrize(("function", "state", "told"), FUNCTIONS.values(), ids=FUNCTIONS)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_functions_are_judged_by_what_they_return(function, state, told):
    """A function is tried on all cases, and whatever it does is told in words."""
    verdict = TWICE.judge(function, NUMBERS)
    assert verdict.state == state
    assert told in verdict.text


def test_a_function_cannot_change_what_the_lesson_goes_on_with():
    """It gets a copy of its arguments."""
    numbers = np.array([1.0, 2.0])
    TWICE.judge(_spoils, {"numbers": numbers})
    assert numbers.tolist() == [1.0, 2.0]


VALUES = {
    "right": (3, "solved", "Right."),
    "a known mistake": (12.0, "wrong", "That is twice."),
    "an unknown mistake": (7, "wrong", "Think."),
    "none": (..., "unsolved", "Do it."),
    "unreadable": ("3", "unreadable", "text"),
}


@pytest.mark.parametrize(("answer", "state", "told"), VALUES.values(), ids=VALUES)
def test_values_are_judged_by_the_data_at_hand(answer, state, told):
    """The right value and those of mistakes are computed from what is given."""
    verdict = HALF.judge(answer, {"number": 6})
    assert verdict.state == state
    assert told in verdict.text


@pytest.mark.parametrize(
    ("answer", "state", "told"),
    [(4, "solved", "Right."), (6, "wrong", "6 is not below 5."), (..., "unsolved", "Do it.")],
    ids=["fulfilled", "not fulfilled", "none"],
)
def test_open_exercises_are_judged_by_their_condition(answer, state, told):
    """Any answer that fulfils the condition is right; the others read what is missing."""
    verdict = BELOW.judge(answer, {"limit": 5})
    assert (verdict.state, verdict.text) == (state, told)


def test_the_solution_can_be_read():
    """The code of a solution is shown as it stands in the package, indented as it should be."""
    assert TWICE.solution_code == "def _twice(numbers):\n    return 2.0 * numbers.sum()"
