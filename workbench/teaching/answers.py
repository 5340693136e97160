"""Kinds of answers: how to read what a student gives, and when two answers are the same."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from workbench.errors import WorkbenchError


class UnreadableAnswerError(WorkbenchError):
    """Signal an answer that is not of the kind the exercise asks for, in words for a student."""


class Answer(ABC):
    """The base of the kinds of answers."""

    @abstractmethod
    def read(self, given: Any) -> Any:
        """Take what a student gives as an answer of this kind.

        Raises
        ------
        UnreadableAnswerError
            If it is not one; the message says what was given and what is wanted.
        """

    @abstractmethod
    def same(self, first: Any, second: Any) -> bool:
        """Tell whether two answers that were read are the same."""

    def misshaped(self, given: Any, right: Any) -> str:  # noqa: ARG002 - for those with a shape
        """Say what shape is wanted; empty if it is that of the right answer."""
        return ""


@dataclass(frozen=True)
class Number(Answer):
    """A finite number.

    Parameters
    ----------
    tolerance : float
        How far two numbers may differ, relative to the larger one, and still be the same.
        Wide enough for a student's rounding, narrower than the effect of a mistake.
    near_zero : float
        How far they may differ in any case.

    Examples
    --------
    >>> Number(tolerance=0.01).same(0.501, 0.5)
    True
    >>> Number().read("0.5")
    Traceback (most recent call last):
    workbench.teaching.answers.UnreadableAnswerError: The answer is the text '0.5'. A number is
    wanted: write it without quotation marks.
    """

    tolerance: float = 1e-3
    near_zero: float = 1e-9

    def read(self, given: Any) -> float:
        """Take a Python or NumPy number, or an array that holds nothing but one."""
        if isinstance(given, str):
            raise UnreadableAnswerError(
                f"The answer is the text {given!r}. A number is wanted: write it without "
                "quotation marks."
            )
        array = _numbers(given, "A number is wanted.")
        if array.size != 1:
            raise UnreadableAnswerError(
                f"The answer has {array.size} values, of shape {array.shape}. One number is "
                "wanted: is a mean or a sum missing?"
            )
        _check_finite(array)
        return float(array.ravel()[0])

    def same(self, first: float, second: float) -> bool:
        """Compare up to the tolerance."""
        return math.isclose(first, second, rel_tol=self.tolerance, abs_tol=self.near_zero)


@dataclass(frozen=True)
class Array(Answer):
    """An array of finite numbers, of the right answer's shape.

    Parameters
    ----------
    tolerance : float
        How far values may differ, relative to the largest of the right answer.
    """

    tolerance: float = 1e-6

    def read(self, given: Any) -> np.ndarray:
        """Take what NumPy can make an array of numbers of."""
        array = _numbers(given, "An array of numbers is wanted.")
        _check_finite(array)
        return array

    def misshaped(self, given: np.ndarray, right: np.ndarray) -> str:
        """Compare the shapes."""
        if given.shape == right.shape:
            return ""
        return f"The answer has shape {given.shape}. An array of shape {right.shape} is wanted."

    def same(self, first: np.ndarray, second: np.ndarray) -> bool:
        """Compare shapes, and values up to the tolerance."""
        if first.shape != second.shape:
            return False
        largest = float(np.abs(second).max(initial=0.0))
        return bool(np.all(np.abs(first - second) <= self.tolerance * largest + 1e-12))


@dataclass(frozen=True)
class Choice(Answer):
    """One of several words.

    Parameters
    ----------
    options : sequence of str
        The words; capitals do not matter.
    """

    options: Sequence[str]

    def read(self, given: Any) -> str:
        """Take one of the words, however it is capitalised."""
        wanted = ", ".join(f'"{option}"' for option in self.options)
        if not isinstance(given, str):
            raise UnreadableAnswerError(
                f"The answer is {_described(given)}. One of these words is wanted, in quotation "
                f"marks: {wanted}."
            )
        by_lower = {option.lower(): option for option in self.options}
        if given.strip().lower() not in by_lower:
            raise UnreadableAnswerError(
                f'The answer is "{given.strip()}". One of these words is wanted: {wanted}.'
            )
        return by_lower[given.strip().lower()]

    def same(self, first: str, second: str) -> bool:
        """Compare the words."""
        return first == second


@dataclass(frozen=True)
class Samples(Answer):
    """Indices of samples, in any order."""

    def read(self, given: Any) -> frozenset[int]:
        """Take one index or several; an index that stands twice is refused."""
        array = np.atleast_1d(_numbers(given, "Indices of samples are wanted.")).ravel()
        _check_finite(array)
        if np.any(array != np.round(array)) or np.any(array < 0):
            raise UnreadableAnswerError(
                "Indices of samples are wanted: whole numbers, from 0. "
                f"The answer has {array[(array != np.round(array)) | (array < 0)][0]:g}."
            )
        indices = frozenset(int(index) for index in array)
        if len(indices) < len(array):
            raise UnreadableAnswerError("An index stands in the answer twice.")
        return indices

    def same(self, first: frozenset[int], second: frozenset[int]) -> bool:
        """Compare as sets."""
        return first == second


def _numbers(given: Any, wanted: str) -> np.ndarray:
    """Take numbers of any shape; truth values, texts and others are refused."""
    try:
        array = np.asarray(given)
    except (TypeError, ValueError):
        raise UnreadableAnswerError(f"The answer's rows differ in length. {wanted}") from None
    if array.dtype.kind not in "iuf":
        raise UnreadableAnswerError(f"The answer is {_described(given)}. {wanted}")
    return array.astype(np.float64)


def _check_finite(array: np.ndarray) -> None:
    bad = array[~np.isfinite(array)]
    if bad.size:
        what = "not a number (nan)" if np.isnan(bad[0]) else "infinite"
        which = "The answer is" if array.size == 1 else f"{bad.size} of its values are"
        raise UnreadableAnswerError(
            f"{which} {what}. Look for a division by zero or a missing value."
        )


def _described(given: Any) -> str:
    """Say in words what a student gave."""
    if given is None:
        return "`None`, which a function gives that has no `return`"
    if isinstance(given, bool | np.bool_):
        return f"the truth value `{given}`"
    if isinstance(given, str):
        return f"the text {given!r}"
    if callable(given):
        return "a function; call it with its arguments in parentheses"
    return f"of type `{type(given).__name__}`"
