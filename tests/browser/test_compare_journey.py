"""What a person does with the projection comparison in JupyterLab."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from tests.browser.chromium import Visit
from tests.browser.lab import (
    Lab,
    choose_data,
    in_kernel,
    open_and_run,
    running_lab,
    wait_for_panels,
)
from workbench.resources import bundled

pytestmark = pytest.mark.browser

NOTEBOOK = "compare_projections.ipynb"
_MARKED = """
(places) => {
  const canvas = document.querySelectorAll(".wb-marks")[1];
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  return places.map(([x, y]) => data[4 * (Math.round(y) * canvas.width + Math.round(x)) + 3] > 0);
}
"""


@pytest.fixture(scope="package")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    """Start JupyterLab on a copy of the notebook, with the bundled data only."""
    notebooks = tmp_path_factory.mktemp("notebooks")
    shutil.copy(bundled("notebooks") / NOTEBOOK, notebooks)
    folder: Path = tmp_path_factory.mktemp("lab")
    environment = {"WORKBENCH_DATA": "", "WORKBENCH_CACHE": str(folder / "cache")}
    with running_lab(folder, notebooks, environment) as lab:
        yield lab


def places_in_panel(embedding: np.ndarray, size: float) -> np.ndarray:
    """Compute where samples are drawn: centred, equal units on both axes, a margin of 12."""
    low, high = embedding.min(axis=0), embedding.max(axis=0)
    scaled = (embedding - (low + high) / 2) * (size - 24) / (high - low).max()
    return size / 2 + scaled * [1, -1]


def test_brushed_frames_are_marked_in_the_other_panel_and_known_to_the_kernel(
    lab: Lab, visit: Visit
) -> None:
    """Choose a motion, brush in one panel, find the same frames in the other and in Python."""
    page = visit.page
    open_and_run(page, lab, NOTEBOOK)
    wait_for_panels(page, "sample")
    assert "150 samples" in page.locator(".wb-plot").first.get_attribute("aria-label")
    for name in ("Projector A", "optimized A", "Projector B", "optimized B"):
        assert page.get_by_label(name, exact=True).is_visible()
    status = page.locator(".wb-status").element_handle()

    choose_data(page, "cmu/01_01-jump")
    wait_for_panels(page, "frame")
    # Kept while its text changed, or a screen reader would not have spoken it.
    assert status.evaluate("(line) => line.isConnected")
    page.locator(".wb-quality td.best").nth(5).wait_for()
    page.locator(".js-plotly-plot .scatterlayer .trace").nth(1).wait_for()

    plot = page.locator(".wb-base").first
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    page.mouse.move(box["x"] + 2, box["y"] + 2)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.6, box["y"] + box["height"] * 0.6)
    page.mouse.up()
    shown = page.locator(".wb-count").inner_text()

    page.evaluate(
        """async () => {
          const { content } = jupyterapp.shell.currentWidget;
          content.activeCellIndex = content.widgets.length - 1;
          await jupyterapp.commands.execute("notebook:run-cell");
        }"""
    )
    output = page.locator(".jp-Cell").last.locator(".jp-OutputArea-executeResult")
    output.get_by_text("array([").wait_for()
    answer = in_kernel(
        page,
        "import json; print(json.dumps([comparison.selection.tolist(), "
        "comparison.results['A'].embedding.tolist(), comparison.results['B'].embedding.tolist()]))",
    )
    selection, first, second = json.loads(answer)
    n = len(first)
    assert shown == f"{len(selection)} of {n} frames selected"

    inside = (places_in_panel(np.array(first), box["width"]) <= 0.6 * box["width"]).all(axis=1)
    assert 0 < inside.sum() < n
    assert selection == np.flatnonzero(inside).tolist()

    places = places_in_panel(np.array(second), box["width"])
    marked = np.array(page.evaluate(_MARKED, places.tolist()))
    distances = np.linalg.norm(places[:, None] - places[selection], axis=2).min(axis=1)
    assert marked[selection].all()
    assert not marked[distances > 8].any()

    # The frame that lies furthest from all others, so that the mouse can mean no other.
    between = np.linalg.norm(places[:, None] - places, axis=2)
    np.fill_diagonal(between, np.inf)
    alone = int(between.min(axis=1).argmax())
    other = page.locator(".wb-base").nth(1)
    other.scroll_into_view_if_needed()
    box = other.bounding_box()
    page.mouse.move(box["x"] + places[alone][0], box["y"] + places[alone][1])
    caption = page.locator(".wb-pose .wb-detail")
    assert caption.inner_text().startswith(f"frame {alone} of {n}")

    page.locator(".wb-plot").first.focus()
    page.keyboard.press("Home")
    for _ in range(3):
        page.keyboard.press("ArrowUp")
    assert caption.inner_text().startswith(f"frame 30 of {n}")

    in_kernel(page, "comparison.selection = [5, 3]")
    page.get_by_text(f"2 of {n} frames selected").wait_for()
