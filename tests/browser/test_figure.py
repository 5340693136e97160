"""Plotly figures in a page."""

from __future__ import annotations

import base64
from collections.abc import Callable
from typing import Any

import plotly.graph_objects as go
import pytest

from workbench.widgets import FigureView
from workbench.widgets.figure import packed_library

pytestmark = pytest.mark.browser

# Plays Python's part: answers the question for the library, and counts how often it is asked.
_ANSWER = """
(packed) => {
  window.asked = 0;
  window.answer = (receive) => {
    window.asked += 1;
    const bytes = Uint8Array.from(atob(packed), (c) => c.charCodeAt(0));
    receive({kind: "plotly.js"}, [new DataView(bytes.buffer)]);
  };
}
"""


def line() -> FigureView:
    figure = go.Figure(layout={"template": "none", "height": 200})
    figure.add_scatter(x=[1, 2], y=[3, 5], name="rising")
    return FigureView(figure=figure.to_json(), description="a rising line")


@pytest.fixture
def figures(mount: Callable, visit: Any) -> Any:
    """Show two figures of different width in one page."""
    packed = base64.b64encode(packed_library()).decode()
    visit.page.evaluate(_ANSWER, packed)
    mount(line(), width=500)
    visit.page.locator(".js-plotly-plot .main-svg").nth(2).wait_for(state="attached")
    mount(line(), width=350)
    visit.page.locator(".js-plotly-plot .main-svg").nth(5).wait_for(state="attached")
    return visit.page


def test_a_figure_is_as_wide_as_its_place_and_follows_it(figures: Any) -> None:
    """Nothing sticks out, also when the page becomes narrower."""
    width = "[...document.querySelectorAll('.svg-container')].map((e) => e.clientWidth)"
    assert figures.evaluate(width) == [492, 342]
    figures.evaluate("mounted[0].el.style.width = '300px'")
    figures.wait_for_function("document.querySelector('.svg-container').clientWidth === 292")


def test_all_figures_share_one_library(figures: Any) -> None:
    """Python is asked for plotly.js once, whatever the number of figures."""
    assert figures.evaluate("window.asked") == 1


def test_a_figure_is_described_and_follows_the_theme(figures: Any) -> None:
    """A screen reader gets the description; in the dark the text is light."""
    assert figures.get_by_role("img", name="a rising line").count() == 2
    figures.emulate_media(color_scheme="dark")
    figures.wait_for_function(
        "getComputedStyle(document.querySelector('.xtick text')).fill === 'rgb(242, 242, 242)'"
    )


def test_another_figure_replaces_the_first(figures: Any) -> None:
    """A change of the trait is drawn."""
    figure = go.Figure(layout={"template": "none", "title": {"text": "another"}})
    figures.evaluate("(json) => mounted[0].model.set('figure', json)", figure.to_json())
    figures.locator(".gtitle", has_text="another").wait_for()


@pytest.mark.parametrize("fault", ["unanswered", "closed", "failed"])
def test_a_figure_without_an_answer_does_not_disable_the_next(
    mount: Callable, visit: Any, fault: str
) -> None:
    """Whatever became of the first figure's question, the second asks for itself."""
    bad = "(receive) => receive({kind: 'plotly.js'}, [new DataView(new ArrayBuffer(4))])"
    visit.page.evaluate(f"() => {{ window.answer = {bad if fault == 'failed' else '() => {}'} }}")
    mount(line(), width=500)
    if fault == "failed":
        visit.page.get_by_text("The figure cannot be drawn").wait_for()
    if fault == "closed":
        visit.page.evaluate("mounted[0].end()")
    visit.page.evaluate(_ANSWER, base64.b64encode(packed_library()).decode())
    mount(line(), width=350)
    drawn = "(i) => mounted[i].el.querySelectorAll('.main-svg').length > 0"
    visit.page.wait_for_function(drawn, arg=1)
    if fault == "failed":
        visit.page.evaluate("mounted[0].model.set('description', 'once more')")
    if fault != "closed":
        visit.page.wait_for_function(drawn, arg=0)
    assert visit.page.evaluate("window.asked") == 1
