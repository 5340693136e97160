"""Answers that students come up with when they are lost, in all exercises of lessons 1 to 3."""

from __future__ import annotations

import pytest

from workbench.teaching import Lesson

LOST = {
    "nothing": None,
    "a text": "I do not know",
    "not a number": float("nan"),
    "a mixed list": [1, "a", None],
    "a truth value": True,
    "an object": object(),
    "a function that raises": lambda *_: 1 / 0,
    "a function without arguments": lambda: 1.0,
    "an exception": ValueError("no"),
}


@pytest.mark.parametrize("answer", LOST.values(), ids=LOST)
@pytest.mark.parametrize("number", [1, 2, 3])
def test_no_answer_makes_a_check_raise(number, answer, given):
    """Whatever is given as an answer, the box tells in words what is wanted."""
    for key, arguments in given(number).items():
        feedback = Lesson(number).check(key, answer, **arguments)
        assert feedback.state == "unreadable"
        assert feedback.verdict.text.endswith((".", "zero"))
        assert "Run the cells above" not in feedback.verdict.text
