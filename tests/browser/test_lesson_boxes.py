"""The boxes in which lessons answer, as a reader sees them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.browser.axe import violations
from tests.browser.chromium import Visit
from workbench.teaching import Lesson

pytestmark = pytest.mark.browser

PAIR = {"samples": np.array([[0.0, 0.0], [3.0, 4.0]]), "pair": (0, 1)}

#: Ground and text of both themes of JupyterLab.
THEMES = {"light": ("#ffffff", "rgba(0, 0, 0, 0.87)"), "dark": ("#111111", "#ffffff")}


def _boxes() -> str:
    """Answer an exercise in every way there is, and show the count."""
    lesson, teacher = Lesson(1), Lesson(1, solutions=True)
    answers = [
        lesson.check("distance", answer, **PAIR)
        for answer in (..., "a text <b>in bold</b>", 25.0, 5.0)
    ]
    shown = [*answers, teacher.check("distance", **PAIR), lesson.progress()]
    return "".join(one._repr_html_() for one in shown)


def _show(page: Any, theme: str) -> None:
    ground, text = THEMES[theme]
    page.set_content(
        '<!DOCTYPE html><html lang="en"><title>Boxes</title>'
        f'<body style="background: {ground}; color: {text}; font-family: sans-serif">'
        f"<main>{_boxes()}</main></body></html>"
    )


@pytest.mark.parametrize("theme", THEMES)
def test_boxes_can_be_read_by_everybody(visit: Visit, theme: str):
    """No rule of axe-core is broken, in the light and in the dark theme."""
    _show(visit.page, theme)
    visit.page.locator("summary").click()
    assert violations(visit.page) == []


def test_boxes_say_what_they_mean_without_colour(visit: Visit):
    """Each has a word for its state, and what a student wrote stays text."""
    _show(visit.page, "light")
    boxes = visit.page.get_by_role("status")
    words = [box.locator("strong").inner_text() for box in boxes.all()]
    assert words == [
        "… To do",
        "! Cannot read the answer",
        "✗ Not yet",
        "✓ Solved",
        "✓ Solved",
        "1 of 6 exercises solved",
    ]
    assert "a text <b>in bold</b>" in boxes.nth(1).inner_text()


def test_the_solution_opens_by_keyboard(visit: Visit):
    """A teacher unfolds the code with the Enter key; until then it is not in sight."""
    _show(visit.page, "light")
    code = visit.page.get_by_text("def distance(")
    assert not code.is_visible()
    visit.page.locator("summary").focus()
    visit.page.keyboard.press("Enter")
    assert code.is_visible()


def test_boxes_fit_a_narrow_page(visit: Visit):
    """At 320 pixels nothing sticks out; long code scrolls within its box."""
    visit.page.set_viewport_size({"width": 320, "height": 800})
    _show(visit.page, "light")
    visit.page.locator("summary").click()
    assert visit.page.evaluate("document.documentElement.scrollWidth") <= 320
