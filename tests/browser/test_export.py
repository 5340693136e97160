"""Views in a single HTML file, opened from disk."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ipywidgets
import numpy as np
import plotly.graph_objects as go
import pytest

from tests.browser.axe import violations
from workbench.errors import WorkbenchError
from workbench.widgets import FigureView, SampleDetails, ScatterPanels
from workbench.widgets.export import export_html, html_page

pytestmark = pytest.mark.browser

POINTS = np.stack(np.meshgrid([0.0, 0.5, 1.0], [0.0, 0.5, 1.0]), axis=-1).reshape(-1, 2)
NASTY = "</script><script>document.title = 'broken'</script>"


def panels(**traits: Any) -> ScatterPanels:
    traits = {"classes": [0, 1, 2] * 3, "class_names": [NASTY, "b", "c"], **traits}
    return ScatterPanels(
        panels=[{"title": "A", "state": "ready"}, {"title": "B", "state": "ready"}],
        points=[POINTS, POINTS[:, ::-1]],
        color_by="class",
        channel="c",
        **traits,
    )


def details() -> SampleDetails:
    return SampleDetails(values=np.arange(9.0)[:, None], columns=["number"], channel="c")


@pytest.fixture
def opened(visit: Any, tmp_path: Path) -> Callable[..., Any]:
    """Export views and open the file as a person would."""

    def open_page(views: Any, **words: Any) -> Any:
        path = export_html(views, tmp_path / "page.html", **{"title": "Panels", **words})
        visit.page.goto(path.as_uri())
        visit.page.locator(".wb-plot, .wb-details, .wb-figure").first.wait_for()
        return visit.page

    return open_page


def middle_of(page: Any, panel: int) -> tuple[float, float]:
    box = page.locator(".wb-base").nth(panel).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_an_exported_page_still_selects_and_hovers(opened: Callable) -> None:
    """From a file, a click selects, and hovering is followed by another view."""
    page = opened([[panels(), details()]])
    page.mouse.move(*middle_of(page, 1))
    assert page.locator(".wb-hover").inner_text() == "sample 4 · b"
    assert page.locator(".wb-details td.wb-number").inner_text() == "4"
    page.mouse.click(*middle_of(page, 0))
    assert page.locator(".wb-count").inner_text() == "1 of 9 samples selected"


def test_text_in_a_page_stays_text(opened: Callable) -> None:
    """A class named like the end of a script breaks nothing."""
    page = opened(panels(), title="A & <b>B</b>", text=NASTY)
    assert page.title() == page.locator("h1").inner_text() == "A & <b>B</b>"
    assert page.locator("p.wb-text").inner_text() == NASTY
    assert page.locator(".wb-legend button").first.inner_text() == NASTY


def test_a_page_has_its_figures_and_tables(opened: Callable) -> None:
    """A plotly figure is drawn and the HTML of a table is shown, with no request."""
    figure = FigureView(figure=go.Figure(go.Scatter(y=[1, 2])).to_json(), description="a line")
    page = opened([panels(), [figure, ipywidgets.HTML("<table><td>0.91</td></table>")]])
    page.locator(".js-plotly-plot .scatterlayer").wait_for()
    assert page.locator("td").inner_text() == "0.91"


def test_views_of_one_kind_share_a_module() -> None:
    """Two scatter views bring their module once."""
    content = re.search(
        r'id="wb-content">(.*?)</script>', html_page([panels(), panels()], title="")
    )
    assert content is not None
    packed = json.loads(content[1])
    assert len(packed["modules"]) == 1
    assert [view["module"] for view in packed["views"]] == [0, 0]


def test_what_needs_python_is_not_offered(opened: Callable) -> None:
    """The page does not offer to make itself; the picture and the table are there."""
    page = opened(panels(offers_html=True))
    page.get_by_role("button", name="Save").click()
    assert page.locator(".wb-menu-list button:visible").all_inner_texts() == [
        "Picture (PNG)",
        "Table (CSV)",
    ]


def test_a_page_saves_pictures_and_tables(opened: Callable) -> None:
    """Without a kernel, and under the page's own rules, both downloads come."""
    page = opened(panels())
    for name, ending in (("Picture (PNG)", ".png"), ("Table (CSV)", ".csv")):
        page.get_by_role("button", name="Save").click()
        with page.expect_download() as waiting:
            page.get_by_role("button", name=name).click()
        assert waiting.value.suggested_filename == f"projections{ending}"
        assert waiting.value.path().stat().st_size > 100


def test_hidden_views_are_left_out(opened: Callable) -> None:
    """A view that the dashboard hides is not in the page."""
    hidden = details()
    hidden.layout.display = "none"
    page = opened([[panels(), hidden]])
    assert page.locator(".wb-place").count() == 1


@pytest.mark.parametrize(
    ("scheme", "ground"), [("light", 255), ("dark", 22)], ids=["light", "dark"]
)
def test_a_page_follows_the_theme_of_the_system(
    opened: Callable, visit: Any, scheme: str, ground: int
) -> None:
    """Page and views have the same ground, light or dark, and nothing sticks out at 700 px."""
    visit.page.emulate_media(color_scheme=scheme)
    visit.page.set_viewport_size({"width": 700, "height": 800})
    page = opened([[panels(), details()]])
    for part in ("body", ".wb-scatter"):
        colour = f"getComputedStyle(document.querySelector('{part}')).backgroundColor"
        assert page.evaluate(colour) == f"rgb({ground}, {ground}, {ground})"
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.parametrize(
    ("views", "words"),
    [([], "no view"), (ipywidgets.Button(), "got Button")],
    ids=["none", "another widget"],
)
def test_what_cannot_be_exported_is_refused(views: Any, words: str, tmp_path: Path) -> None:
    """The message says what was given, and no file is left."""
    with pytest.raises(WorkbenchError, match=words):
        export_html(views, tmp_path / "page.html", title="")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_page_breaks_no_rule_of_accessibility(opened: Callable, visit: Any, scheme: str) -> None:
    """Values coloured, a control point moved and the menu open, axe finds nothing."""
    visit.page.emulate_media(color_scheme=scheme)
    values = np.linspace(0, 1, 18).reshape(2, 9)
    values[0, 0] = np.nan
    shown = panels(
        values=values,
        value_name="stress",
        raw_points=[POINTS, POINTS],
        control_points=[0, 8],
        influence=np.stack([np.linspace(1, 0, 9), np.linspace(0, 1, 9)], axis=1),
        movable=True,
    )
    shown.color_by = "value"
    page = opened([[shown, details()]], text="Nine samples.")
    page.get_by_role("button", name="Move control points").click()
    page.locator(".wb-plot").first.focus()
    for key in ("ArrowRight", "Enter", "ArrowUp", "Enter"):
        page.keyboard.press(key)
    page.get_by_role("button", name="Save").click()
    page.wait_for_function("document.querySelector('.wb-tag').textContent === 'moved'")
    assert violations(page) == []
