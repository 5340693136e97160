"""Lessons: the count of what is solved, and the boxes that checks show."""

from __future__ import annotations

import numpy as np
import pytest

from workbench import WorkbenchError
from workbench.teaching import Lesson, Verdict
from workbench.teaching.feedback import Feedback, Progress

PAIR = {"samples": np.array([[0.0, 0.0], [3.0, 4.0]]), "pair": (0, 1)}


def test_progress_follows_the_last_answer():
    """A solved exercise counts once, and no more when its answer is spoilt again."""
    lesson = Lesson(1)
    assert lesson.progress().sentence == "0 of 6 exercises solved"
    for _ in range(2):
        assert lesson.check("distance", 5.0, **PAIR).progress.sentence.startswith("1 of 6")
    assert lesson.check("distance", 25.0, **PAIR).progress.sentence.startswith("0 of 6")


def test_solutions_stand_in_for_open_exercises_only():
    """With solutions, an open exercise is solved with code; a wrong answer stays wrong."""
    lesson = Lesson(1, solutions=True)
    open_one = lesson.check("distance", ..., **PAIR)
    assert open_one.state == "solved"
    assert "def distance(" in open_one.code
    assert lesson.check("distance", 25.0, **PAIR).state == "wrong"
    assert Lesson(1).check("distance", ..., **PAIR).code == ""


def test_data_that_were_changed_are_told():
    """If a student has changed what a cell gives, the box says so and nothing is raised."""
    feedback = Lesson(1).check("distance", 5.0, samples=None, pair=(0, 1))
    assert feedback.state == "unreadable"
    assert "Run the cells above once more" in feedback.verdict.text


@pytest.mark.parametrize("number", [0, "one"], ids=["no such lesson", "no number"])
def test_unknown_lessons_are_refused(number):
    """The message names the lessons that there are."""
    with pytest.raises(WorkbenchError, match=r"lesson: got .* want one of 1, 2, 3"):
        Lesson(number)


def test_unknown_exercises_are_refused():
    """The message names the lesson's exercises."""
    with pytest.raises(WorkbenchError, match="want one of distance, false-neighbor"):
        Lesson(1).check("distances", 5.0)


@pytest.mark.parametrize(
    ("state", "word"),
    [("solved", "Solved"), ("wrong", "Not yet"), ("unreadable", "Cannot"), ("unsolved", "To do")],
    ids=lambda value: value,
)
def test_boxes_tell_the_state_by_a_word(state, word):
    """Colour is not all that tells how it went, and a screen reader is told of the box."""
    feedback = Feedback("key", Verdict(state, "text"), Progress((("key", False),)))
    assert word in feedback._repr_html_()
    assert word in repr(feedback)
    assert 'role="status"' in feedback._repr_html_()


def test_what_a_student_writes_is_no_markup():
    """Texts are escaped; what stands between backticks is set as code."""
    box = Feedback("key", Verdict("wrong", "`a < b` & <script>"), Progress(()), "x < y")
    html = box._repr_html_()
    assert "<code>a &lt; b</code> &amp; &lt;script&gt;" in html
    assert "x &lt; y" in html
    assert "<script>" not in html


def test_progress_names_what_is_open():
    """The line at a lesson's end names open exercises, or says that all is done."""
    assert "second" in Progress((("first", True), ("second", False)))._repr_html_()
    assert "complete" in Progress((("first", True),))._repr_html_()
