"""Exercises: what is asked, what is right, and which mistakes are often made."""

from __future__ import annotations

import copy
import inspect
import textwrap
import traceback
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from workbench.teaching.answers import Answer, UnreadableAnswerError

State = Literal["solved", "wrong", "unreadable", "unsolved"]


@dataclass(frozen=True)
class Verdict:
    """What a check finds.

    Attributes
    ----------
    state : {"solved", "wrong", "unreadable", "unsolved"}
        "unreadable" is an answer of another kind than was asked for, such as a text in place
        of a number, or a function that raises.
    text : str
        What to tell the student; code stands between backticks.
    """

    state: State
    text: str


@dataclass(frozen=True)
class Mistake:
    """A wrong answer that is often given, and the hint that helps.

    Parameters
    ----------
    answer : callable
        Makes the wrong answer of what the solution gets.
    hint : str
        What to think about; it does not give the solution away.
    """

    answer: Callable[..., Any]
    hint: str


@dataclass(frozen=True)
class Question(ABC):
    """The base of all exercises.

    Attributes
    ----------
    key : str
        What the notebook calls the exercise.
    task : str
        What to do, in a sentence, for a student who has not begun.
    solution : callable
        Makes a right answer from what the cell gives.
    praise : str
        What the right answer means.
    hint : str
        For an answer that is wrong in no known way.
    """

    key: str
    task: str
    solution: Callable[..., Any]
    praise: str
    hint: str

    @abstractmethod
    def judge(self, answer: Any, given: Mapping[str, Any]) -> Verdict:
        """Judge an answer, whatever it is.

        Parameters
        ----------
        answer : object
            The student's answer.
        given : mapping of str to object
            What the cell gives: data, embeddings, settings.

        Returns
        -------
        Verdict
        """

    @abstractmethod
    def solve(self, given: Mapping[str, Any]) -> Any:
        """Make the right answer."""

    @property
    def solution_code(self) -> str:
        """The solution as Python code."""
        return textwrap.dedent(inspect.getsource(self.solution)).strip()


@dataclass(frozen=True)
class Exercise(Question):
    """An exercise with one right value, computed from what the cell gives.

    Parameters
    ----------
    key, task, solution, praise, hint
        See :class:`Question`; the solution takes what the cell gives by name.
    kind : Answer
        What the answer is.
    mistakes : sequence of Mistake
        Looked through in order, after the right answer.

    Examples
    --------
    >>> from workbench.teaching.answers import Number
    >>> doubled = Exercise(
    ...     key="double",
    ...     task="Double the number.",
    ...     solution=lambda number: 2 * number,
    ...     praise="Yes.",
    ...     hint="Add the number to itself.",
    ...     kind=Number(),
    ...     mistakes=(Mistake(lambda number: number**2, "That is the square."),),
    ... )
    >>> doubled.judge(9, {"number": 3})
    Verdict(state='wrong', text='That is the square.')
    """

    kind: Answer
    mistakes: Sequence[Mistake] = ()

    def judge(self, answer: Any, given: Mapping[str, Any]) -> Verdict:
        """Compare the answer with the right one, then with those of known mistakes."""
        if answer is ...:
            return Verdict("unsolved", self.task)
        try:
            read = self.kind.read(answer)
        except UnreadableAnswerError as error:
            return Verdict("unreadable", str(error))

        def fits(make: Callable[..., Any]) -> bool:
            return self.kind.same(read, self.kind.read(make(**given)))

        if fits(self.solution):
            return Verdict("solved", self.praise)
        shape = self.kind.misshaped(read, self.kind.read(self.solution(**given)))
        return Verdict("wrong", _hint_for(self.mistakes, fits) or shape or self.hint)

    def solve(self, given: Mapping[str, Any]) -> Any:
        """Make the right answer."""
        return self.solution(**given)


@dataclass(frozen=True)
class FunctionExercise(Question):
    """An exercise that asks for a function, which is tried on several cases.

    Parameters
    ----------
    key, task, solution, praise, hint
        See :class:`Question`; the solution is such a function itself.
    kind : Answer
        What the function returns.
    cases : callable
        Makes the cases, each a tuple of arguments, from what the cell gives by name.
    mistakes : sequence of Mistake
        Functions too; one fits if it returns the same as the student's in every case.
    """

    kind: Answer
    cases: Callable[..., Sequence[tuple[Any, ...]]]
    mistakes: Sequence[Mistake] = ()

    def judge(self, answer: Any, given: Mapping[str, Any]) -> Verdict:
        """Compare what the function returns with what the right one does."""
        if answer is ...:
            return Verdict("unsolved", self.task)
        if not callable(answer):
            return Verdict(
                "unreadable", "A function is wanted: give its name, without parentheses."
            )
        cases = self.cases(**given)
        try:
            results = [_call(answer, case) for case in cases]
            if any(result is ... for result in results):
                return Verdict("unsolved", self.task)
            read = [self.kind.read(result) for result in results]
        except UnreadableAnswerError as error:
            return Verdict("unreadable", _of_a_function(str(error)))

        def fits(function: Callable[..., Any]) -> bool:
            return all(
                self.kind.same(one, self.kind.read(function(*case)))
                for one, case in zip(read, cases, strict=True)
            )

        if fits(self.solution):
            return Verdict("solved", self.praise)
        shape = self.kind.misshaped(read[0], self.kind.read(self.solution(*cases[0])))
        hint = _hint_for(self.mistakes, fits) or _of_a_function(shape) or self.hint
        return Verdict("wrong", hint)

    def solve(self, given: Mapping[str, Any]) -> Any:  # noqa: ARG002 - the same for all data
        """Give the function."""
        return self.solution


@dataclass(frozen=True)
class OpenExercise(Question):
    """An exercise with many right answers, judged by what they bring about.

    Parameters
    ----------
    key, task, solution, praise, hint
        See :class:`Question`; the solution is one right answer of many.
    kind : Answer
        What the answer is.
    fault : callable
        ``fault(answer, **given)`` says in words what is not right yet, or gives None.
    """

    kind: Answer
    fault: Callable[..., str | None]

    def judge(self, answer: Any, given: Mapping[str, Any]) -> Verdict:
        """Look for a fault in the answer."""
        if answer is ...:
            return Verdict("unsolved", self.task)
        try:
            found = self.fault(self.kind.read(answer), **given)
        except UnreadableAnswerError as error:
            return Verdict("unreadable", str(error))
        return Verdict("solved", self.praise) if found is None else Verdict("wrong", found)

    def solve(self, given: Mapping[str, Any]) -> Any:
        """Make one right answer."""
        return self.solution(**given)


def _hint_for(
    mistakes: Sequence[Mistake], fits: Callable[[Callable[..., Any]], bool]
) -> str | None:
    """Find the first mistake that makes the same answer."""
    for mistake in mistakes:
        try:
            with np.errstate(all="ignore"):
                if fits(mistake.answer):
                    return mistake.hint
        except (ArithmeticError, UnreadableAnswerError):
            continue  # these data do not let one make that mistake
    return None


def _call(function: Callable[..., Any], case: tuple[Any, ...]) -> Any:
    """Call a student's function, telling in words what goes wrong."""
    try:
        inspect.signature(function).bind(*case)
    except TypeError:
        raise UnreadableAnswerError(
            f"The function must take {len(case)} argument{'s' * (len(case) > 1)}, "
            "as in the cell that you were given."
        ) from None
    except ValueError:
        pass  # a built-in function that does not tell what it takes
    try:
        # A copy, so that a function that changes its arguments harms no later cell.
        return function(*copy.deepcopy(case))
    except Exception as error:
        where = _line_of(function, error)
        raise UnreadableAnswerError(
            f"The function stops{where} with {type(error).__name__}: {error}"
        ) from None


def _line_of(function: Callable[..., Any], error: Exception) -> str:
    """Say at which line of a function an error came up, where that can be told."""
    code = getattr(function, "__code__", None)
    if code is None:
        return ""
    lines = [
        frame.lineno
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.filename == code.co_filename and frame.name == code.co_name
    ]
    if not lines or lines[-1] is None:
        return ""
    return f" at its line {lines[-1] - code.co_firstlineno + 1}"


def _of_a_function(message: str) -> str:
    returned = message.replace("The answer is", "The function returns", 1)
    return returned.replace("The answer has", "What the function returns has", 1)
