"""Reading answers, whatever a student gives."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.teaching import Array, Choice, Number, Samples, UnreadableAnswerError

WORD = Choice(("yes", "no"))

UNREADABLE = {
    "a text for a number": (Number(), "0.5", "without quotation marks"),
    "nothing for a number": (Number(), None, "no `return`"),
    "a truth value for a number": (Number(), True, "truth value"),
    "several values for a number": (Number(), np.ones((2, 3)), "6 values, of shape (2, 3)"),
    "no value for a number": (Number(), [], "0 values"),
    "a complex number": (Number(), 1j, "complex"),
    "not a number": (Number(), float("nan"), "not a number (nan)"),
    "an infinite number": (Number(), np.inf, "infinite"),
    "a function for a number": (Number(), abs, "call it"),
    "rows of different lengths": (Array(), [[1.0], [1.0, 2.0]], "differ in length"),
    "an array with a hole": (Array(), [1.0, np.nan], "1 of its values are not a number"),
    "a list of texts": (Array(), ["a"], "array of numbers is wanted"),
    "an unknown word": (WORD, "perhaps", '"yes", "no"'),
    "a number for a word": (WORD, 1, "in quotation marks"),
    "half an index": (Samples(), [1, 2.5], "2.5"),
    "an index below 0": (Samples(), -1, "from 0"),
    "an index twice": (Samples(), [3, 3], "twice"),
}


@pytest.mark.parametrize(("kind", "given", "told"), UNREADABLE.values(), ids=UNREADABLE)
def test_unreadable_answers_are_told_in_words(kind, given, told):
    """Whatever is no answer of the kind is refused with what was given and what is wanted."""
    with pytest.raises(UnreadableAnswerError) as refusal:
        kind.read(given)
    assert told in str(refusal.value)


@pytest.mark.parametrize(
    "given", [2, 2.0, np.float32(2), np.int64(2), np.array(2), [2.0]], ids=lambda given: repr(given)
)
def test_numbers_of_all_types_are_read(given):
    """Python's and NumPy's numbers count, and arrays that hold just one."""
    assert Number().same(Number().read(given), 2.0)


def test_numbers_are_compared_relative_to_their_size():
    """The tolerance is a share, so that rounding is forgiven for small and large numbers."""
    kind = Number(tolerance=0.01)
    assert kind.same(1.005e6, 1e6)
    assert not kind.same(1.02e-6, 1e-6)


def test_arrays_are_the_same_by_shape_and_value():
    """A column is no row, even of equal numbers."""
    kind = Array(tolerance=1e-6)
    assert kind.same(np.array([1.0, 2.0 + 1e-7]), np.array([1.0, 2.0]))
    assert not kind.same(np.array([[1.0], [2.0]]), np.array([1.0, 2.0]))
    assert not kind.same(np.array([1.0, 2.1]), np.array([1.0, 2.0]))


def test_words_are_read_whatever_their_capitals():
    """Spaces around a word and its capitals do not matter."""
    assert WORD.read(" Yes ") == "yes"


def test_samples_are_compared_as_sets():
    """The order of indices does not count; a single one is a set of one."""
    kind = Samples()
    assert kind.same(kind.read([3, 1]), kind.read(np.array([1, 3])))
    assert not kind.same(kind.read(3), kind.read([1, 3]))
