"""What a person does with the projection comparison in JupyterLab."""

from __future__ import annotations

import json

import numpy as np
import pytest

from tests.browser.chromium import Visit
from tests.browser.lab import (
    Lab,
    choose_data,
    in_kernel,
    open_and_run,
    wait_for_panels,
)

pytestmark = pytest.mark.browser

NOTEBOOK = "compare_projections.ipynb"
JUMP, TURN = "cmu/01_01-jump", "cmu/01_01-turn"
_MARKED = """
(places) => {
  const canvas = document.querySelectorAll(".wb-marks")[1];
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  return places.map(([x, y]) => data[4 * (Math.round(y) * canvas.width + Math.round(x)) + 3] > 0);
}
"""


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


def test_panels_are_made_moved_repeated_and_taken_along(lab: Lab, visit: Visit) -> None:
    """Two clips, a third panel, a moved control point, seeds, code, and a page without kernel."""
    page = visit.page
    # Samples that still travel to their places would be missed by the mouse.
    page.emulate_media(reduced_motion="reduce")
    open_and_run(page, lab, NOTEBOOK)
    wait_for_panels(page, "sample")
    choose_data(page, JUMP)
    wait_for_panels(page, "frame")
    page.get_by_role("button", name="Further clips").click()
    page.get_by_label("Further clips", exact=True).select_option([TURN])
    page.get_by_text("frames of 2 clips").wait_for()

    page.get_by_label("Panels", exact=True).select_option("3")
    page.get_by_label("Projector C", exact=True).select_option("lle")
    parameters = page.get_by_label("Parameters C", exact=True)
    parameters.fill("neighbours 3")
    parameters.press("Enter")
    page.get_by_text("want for instance: perplexity=10").wait_for()
    parameters.fill("n_neighbors=9")
    parameters.press("Enter")
    page.get_by_label("optimized C", exact=True).check()
    page.locator(".wb-title", has_text="C · lle (n_neighbors=9), optimized").wait_for()
    wait_for_panels(page, "frame")

    page.wait_for_function("document.querySelector('.wb-status').textContent === ''")

    page.get_by_role("button", name="Move control points").click()
    start = json.loads(
        in_kernel(
            page,
            "import json; r = comparison.results['A']; "
            "print(json.dumps([r.embedding.tolist(), r.control_points.tolist()]))",
        )
    )
    plot = page.locator(".wb-base").first
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    place = places_in_panel(np.array(start[0]), box["width"])[start[1][0]]
    page.mouse.move(box["x"] + place[0], box["y"] + place[1])
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] * 0.1, steps=3)
    page.mouse.up()
    page.locator(".wb-quality th", has_text="A · pca (moved)").wait_for()
    moved = json.loads(
        in_kernel(page, "print(json.dumps({k: v.tolist() for k, v in comparison.moved.items()}))")
    )
    assert list(moved) == ["A"]
    shifts = np.linalg.norm(np.array(moved["A"]) - np.array(start[0])[start[1]], axis=1)
    assert shifts[0] > 0.1
    assert shifts[1:].max() < 1e-6

    page.get_by_label("Seeds", exact=True).fill("2")
    page.get_by_label("Seeds", exact=True).press("Enter")
    page.get_by_role("button", name="Repeat over seeds").click()
    page.locator(".wb-quality small").nth(11).wait_for()
    page.get_by_label("Colour by", exact=True).select_option("trustworthiness")
    page.get_by_role("button", name="Shepard diagram").click()
    page.locator(".js-plotly-plot .heatmaplayer .hm").nth(2).wait_for()

    page.get_by_role("button", name="Copy as code").click()
    code = page.locator(".wb-code-text")
    code.get_by_text("Panel('lle', {'n_neighbors': 9}, optimized=True)").wait_for()
    assert code.inner_text().strip() == in_kernel(page, "print(comparison.code)").strip()

    page.get_by_role("button", name="Save", exact=True).click()
    with page.expect_download() as waiting:
        page.get_by_role("button", name="Interactive page (HTML)").click()
    file = lab.folder / "taken.html"
    waiting.value.save_as(file)
    in_kernel(page, f"comparison.save_html({str(lab.folder / 'saved.html')!r})")
    in_kernel(page, "comparison.close()")
    assert (lab.folder / "saved.html").read_text() == file.read_text()

    page.goto(file.as_uri())
    page.locator("h1", has_text=f"Projections of {JUMP} + {TURN}").wait_for()
    page.locator(".wb-plot").nth(2).focus()
    page.keyboard.press("Home")
    caption = page.locator(".wb-pose .wb-detail")
    page.wait_for_function(
        "document.querySelector('.wb-pose .wb-detail').textContent.startsWith('frame 0 of')"
    )
    page.keyboard.press("ArrowUp")
    assert caption.inner_text().startswith("frame 10 of")
    page.locator(".js-plotly-plot .heatmaplayer .hm").nth(2).wait_for()
