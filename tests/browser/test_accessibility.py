"""Pages and widgets by the rules of axe-core, in light and dark."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import plotly.graph_objects as go
import pytest

from tests.browser.axe import violations
from tests.browser.chromium import Visit
from tests.browser.test_figure import figures  # noqa: F401 - a fixture
from tests.browser.test_landscape import landscape, reconstruction
from tests.browser.test_player import waving
from tests.notebooks.screenshot_report import open_report
from workbench.experiments.bootstrap import Estimate
from workbench.files import write_atomically
from workbench.reproduction.claims import Evidence
from workbench.reproduction.items import select_items
from workbench.reproduction.outputs import Outputs, write_outcome
from workbench.reproduction.report import write_report
from workbench.widgets import PoseView, SampleDetails, ScatterPanels, StatusLine

pytestmark = pytest.mark.browser

THEMES = ["light", "dark"]


def scatter_panels() -> ScatterPanels:
    """Show two panels with classes, a selection and a panel that failed."""
    points = np.stack([np.eye(2), np.eye(2)[::-1], np.full((2, 2), np.nan)])
    panels = [
        {"title": "A · pca", "detail": "trustworthiness 0.98", "state": "ready"},
        {"title": "B · tsne", "state": "busy", "message": "computing"},
        {"title": "C · lle", "state": "failed", "message": "too few samples"},
    ]
    return ScatterPanels(
        panels=panels,
        points=points,
        classes=[0, 1],
        class_names=["first", "second"],
        color_by="class",
        control_points=[0],
        selection=[1],
        channel="axe",
    )


def sample_details() -> SampleDetails:
    return SampleDetails(
        values=np.arange(6.0).reshape(3, 2),
        columns=["width", "length"],
        classes=[0, 0, 0],
        class_names=["one"],
        channel="axe",
    )


def pose_view() -> PoseView:
    positions = np.zeros((2, 3, 3), dtype=np.float32)
    positions[:, 1:, 1] = [1, 2]
    sides = ["middle", "left", "right"]
    return PoseView(positions=positions, parents=[-1, 0, 1], sides=sides, channel="axe")


def status_line() -> StatusLine:
    return StatusLine(value="150 samples")


WIDGETS = [
    scatter_panels,
    sample_details,
    pose_view,
    status_line,
    landscape,
    reconstruction,
    waving,
]


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("widget", WIDGETS, ids=lambda make: make.__name__)
def test_widgets_break_no_rule(
    mount: Callable[..., Any], visit: Visit, widget: Callable[[], Any], theme: str
) -> None:
    """Each widget by itself has names, roles and contrast."""
    # Without a document type, tables would not take the colour of what is around them.
    visit.page.set_content("<!doctype html><title>A widget</title>")
    visit.page.emulate_media(color_scheme=theme)
    page = mount(widget())
    assert violations(page, ".wb") == []


@pytest.mark.parametrize("theme", THEMES)
def test_figures_break_no_rule(visit: Visit, figures: Any, theme: str) -> None:  # noqa: F811
    """A drawn plotly figure has a description, and its buttons have names."""
    visit.page.emulate_media(color_scheme=theme)
    visit.page.locator(".main-svg").first.wait_for()
    assert violations(visit.page, ".wb") == []


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write a report with a figure, a table, a published value, a claim and a failure."""
    out = tmp_path_factory.mktemp("report")
    items = select_items(["costa2018:fig5.13", "costa2018:fig5.1", "costa2018:fig5.3"])
    outputs = Outputs(out, profile="quick", seed=0)
    line = go.Figure(go.Scatter(x=[1, 2, 3], y=[3, 5, 4], name="line"), layout={"height": 300})
    outputs.figure(items[0].id, line, caption="A line.", alt="A line of three points.")
    table = pd.DataFrame({("group", "ours"): [0.5], ("group", "published"): [0.6]}, index=["row"])
    outputs.table(items[0].id, table, caption="A table with two header rows.")
    evidence = Evidence(Estimate(0.4, 0.3, 0.45, 8), note="On eight clips.")
    outputs.claim("costa2018:steep-then-flat", evidence)
    write_outcome(out, items[2].notebook, items=[items[2].id], seconds=1, error="It failed.")
    run = {"profile": "quick", "seed": 0, "seconds": 3.0, "notices": ["No PNG images."]}
    write_atomically(out / "run.json", json.dumps(run).encode())
    write_report(out, items)
    return out


@pytest.mark.parametrize("theme", THEMES)
def test_the_report_breaks_no_rule(report: Path, browser: Any, theme: str) -> None:
    """The report with its figure drawn and all its details open."""
    page = open_report(browser, report, dark=theme == "dark")
    page.evaluate("document.querySelectorAll('details').forEach((part) => (part.open = true))")
    assert violations(page) == []
    assert page.complaints == []
    page.close()


def test_a_fault_is_found(visit: Visit) -> None:
    """The rules are really applied: a picture without words and pale text are named."""
    visit.page.set_content(
        "<html lang='en'><title>t</title><main><img src='data:,'>"
        "<p style='color:#aaa;background:#fff'>pale</p></main></html>"
    )
    rules = {line.partition(":")[0] for line in violations(visit.page)}
    assert rules == {"image-alt", "color-contrast"}
