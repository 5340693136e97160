"""Scatter panels in a page without a kernel."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from traitlets import TraitError

from workbench.widgets import ScatterPanels

pytestmark = pytest.mark.browser

SIDE = 5
MARGIN = 12  # of a panel, in pixels
GRID = np.stack(np.meshgrid(np.linspace(0, 1, SIDE), np.linspace(0, 1, SIDE)), axis=-1)
ROWS_UP = GRID.reshape(-1, 2)  # sample 0 lower left, 4 lower right, 24 upper right
MIRRORED = ROWS_UP * [-1, 1]

_SELECTED = """
() => { const view = mounted[0].model.get("selection");
        const end = view.byteOffset + view.byteLength;
        return [...new Int32Array(view.buffer.slice(view.byteOffset, end))] }
"""
_ALPHA = """
([layer, panel, x, y]) => {
  const canvas = document.querySelectorAll(layer)[panel];
  return canvas.getContext("2d").getImageData(Math.round(x), Math.round(y), 1, 1).data[3];
}
"""


def two_panels(**traits: Any) -> ScatterPanels:
    panels = [{"title": "A", "state": "ready"}, {"title": "B", "state": "ready"}]
    points = np.stack([ROWS_UP, MIRRORED])
    return ScatterPanels(panels=panels, points=points, channel="test", **traits)


def selected(page: Any) -> list[int]:
    return page.evaluate(_SELECTED)


def box_of(page: Any, panel: int) -> dict[str, float]:
    # The drawing lies within a border of one pixel.
    return page.locator(".wb-base").nth(panel).bounding_box()


def place(page: Any, panel: int, sample: int) -> tuple[float, float]:
    """Compute where a sample is drawn, in pixels of its panel."""
    size = box_of(page, panel)["width"]
    x, y = ROWS_UP[sample]
    x = 1 - x if panel == 1 else x
    return MARGIN + x * (size - 2 * MARGIN), MARGIN + (1 - y) * (size - 2 * MARGIN)


def point(page: Any, panel: int, sample: int) -> tuple[float, float]:
    box = box_of(page, panel)
    x, y = place(page, panel, sample)
    return box["x"] + x, box["y"] + y


def drag(page: Any, path: list[tuple[float, float]]) -> None:
    page.mouse.move(*path[0])
    page.mouse.down()
    for x, y in path[1:]:
        page.mouse.move(x, y)
    page.mouse.up()


def drag_around(page: Any, panel: int, first: int, last: int) -> None:
    """Draw a rectangle just around two samples that are its corners."""
    (x0, y0), (x1, y1) = point(page, panel, first), point(page, panel, last)
    aside, along = np.sign(x1 - x0) * 6, np.sign(y1 - y0) * 6
    drag(page, [(x0 - aside, y0 - along), (x1 + aside, y1 + along)])


def is_marked(page: Any, panel: int, sample: int) -> bool:
    return page.evaluate(_ALPHA, [".wb-marks", panel, *place(page, panel, sample)]) > 0


def test_a_rectangle_selects_what_is_inside_and_tells_python_once(mount: Callable) -> None:
    """A finished drag sets the selection to the samples inside and saves it once."""
    page = mount(two_panels())
    drag_around(page, 0, 0, 6)
    assert selected(page) == [0, 1, 5, 6]
    assert page.evaluate("mounted[0].model.saved") == 1


@pytest.mark.parametrize("panel", [0, 1], ids=["first panel", "second panel"])
def test_what_is_brushed_in_one_panel_is_marked_in_the_other(mount: Callable, panel: int) -> None:
    """The same samples are marked in both panels, wherever they lie there."""
    page = mount(two_panels())
    drag_around(page, panel, 0, 6)
    for shown in (0, 1):
        marked = [i for i in range(SIDE**2) if is_marked(page, shown, i)]
        assert marked == [0, 1, 5, 6]


def test_samples_are_marked_while_the_mouse_still_drags(mount: Callable) -> None:
    """The other panel follows before the button is released, and Python is not told yet."""
    page = mount(two_panels())
    (x0, y0), (x1, y1) = point(page, 0, 0), point(page, 0, 6)
    page.mouse.move(x0 - 6, y0 + 6)
    page.mouse.down()
    page.mouse.move(x1 + 6, y1 - 6)
    assert is_marked(page, 1, 0)
    assert selected(page) == []
    page.mouse.up()
    assert selected(page) == [0, 1, 5, 6]


def test_shift_adds_to_the_selection(mount: Callable) -> None:
    """A second drag with Shift keeps what was selected."""
    page = mount(two_panels())
    drag_around(page, 0, 0, 6)
    page.keyboard.down("Shift")
    drag_around(page, 0, 18, 24)
    page.keyboard.up("Shift")
    assert selected(page) == [0, 1, 5, 6, 18, 19, 23, 24]


def test_escape_clears_the_selection(mount: Callable) -> None:
    """Escape in a focused panel selects nothing."""
    page = mount(two_panels(selection=[1, 2]))
    page.locator(".wb-plot").first.focus()
    page.keyboard.press("Escape")
    assert selected(page) == []
    assert page.locator(".wb-dimmed").count() == 0


def test_escape_during_a_drag_brings_the_old_selection_back(mount: Callable) -> None:
    """A drag that is given up changes nothing."""
    page = mount(two_panels(selection=[7]))
    x, y = point(page, 0, 12)
    page.mouse.move(x - 8, y - 8)
    page.mouse.down()
    page.mouse.move(x + 8, y + 8)
    page.keyboard.press("Escape")
    page.mouse.up()
    assert selected(page) == [7]
    assert not is_marked(page, 1, 12)


def test_a_lasso_selects_inside_its_outline_only(mount: Callable) -> None:
    """A triangle around the lower left half takes no sample of the upper right half."""
    page = mount(two_panels())
    page.get_by_role("button", name="Lasso").click()
    (x0, y0), (x1, y1) = point(page, 0, 0), point(page, 0, 24)
    drag(page, [(x0 - 8, y0 + 8), (x0 - 8, y1 - 20), (x1 + 20, y0 + 8), (x0, y0 + 8)])
    expected = [i for i, (x, y) in enumerate(ROWS_UP) if x + y <= 1 + 1e-9]
    assert selected(page) == expected


def test_a_click_selects_the_sample_and_a_click_beside_clears(mount: Callable) -> None:
    """Without a drag, the sample under the mouse is meant, or none."""
    page = mount(two_panels())
    page.mouse.click(*point(page, 0, 12))
    assert selected(page) == [12]
    x, y = point(page, 0, 12)
    page.mouse.click(x + 25, y + 25)
    assert selected(page) == []


def test_a_selection_from_python_is_marked(mount: Callable) -> None:
    """Setting the trait marks the samples in all panels."""
    page = mount(two_panels())
    page.evaluate("mounted[0].model.set('selection', new DataView(Int32Array.of(3, 21).buffer))")
    for panel in (0, 1):
        assert [i for i in range(SIDE**2) if is_marked(page, panel, i)] == [3, 21]
    assert "2 of 25 samples selected" in page.locator(".wb-count").inner_text()


def test_the_keyboard_moves_and_selects(mount: Callable) -> None:
    """Arrow keys step through the samples, Enter and Space select, and a reader is told."""
    page = mount(two_panels(control_points=[11]))
    page.locator(".wb-plot").nth(1).focus()
    for key in ("ArrowRight", "ArrowUp", "ArrowRight"):
        page.keyboard.press(key)
    assert page.locator(".wb-live").inner_text() == "sample 11 · control point"
    page.keyboard.press("Enter")
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("Space")
    assert selected(page) == [10, 11]
    page.keyboard.press("Space")
    assert selected(page) == [11]
    page.keyboard.press("End")
    assert page.locator(".wb-hover").inner_text() == "sample 24"


@pytest.mark.parametrize("key", ["Home", "End", "ArrowRight"])
def test_without_samples_no_key_names_one(mount: Callable, key: str) -> None:
    """Before there are data, nothing is hovered or spoken."""
    page = mount(ScatterPanels(panels=[{"title": "A", "state": "busy"}], points=[]))
    page.locator(".wb-plot").first.focus()
    page.keyboard.press(key)
    assert page.locator(".wb-live").inner_text() == ""
    assert page.locator(".wb-hover").inner_text() == ""


def test_the_legend_selects_a_class(mount: Callable) -> None:
    """A click on a class selects its samples."""
    classes = (ROWS_UP[:, 0] > 0.6).astype(int)
    page = mount(two_panels(classes=classes, class_names=["left", "right"], color_by="class"))
    page.get_by_role("button", name="right").click()
    assert selected(page) == np.flatnonzero(classes).tolist()


def test_a_hovered_sample_is_ringed_in_all_panels_without_a_message(mount: Callable) -> None:
    """The mouse over a sample draws a ring in both panels and saves nothing."""
    page = mount(two_panels())
    saved = page.evaluate("mounted[0].model.saved")
    page.mouse.move(*point(page, 0, 12))
    assert page.locator(".wb-hover").inner_text() == "sample 12"
    for panel in (0, 1):
        x, y = place(page, panel, 12)
        ring = [page.evaluate(_ALPHA, [".wb-top", panel, x + dx, y]) for dx in (6, 7, 8)]
        assert max(ring) > 0
    assert page.evaluate("mounted[0].model.saved") == saved


def test_a_panel_without_positions_says_why_and_the_others_work(mount: Callable) -> None:
    """A busy and a failed panel show their message; brushing in the third works."""
    panels = [
        {"title": "A", "state": "ready"},
        {"title": "B", "state": "busy", "message": "computing …"},
        {"title": "C", "state": "failed", "message": "no <b>luck</b>"},
    ]
    empty = np.full_like(ROWS_UP, np.nan)
    page = mount(ScatterPanels(panels=panels, points=[ROWS_UP, empty, empty]), width=1000)
    assert page.locator(".wb-message").all_inner_texts() == ["", "computing …", "no <b>luck</b>"]
    drag_around(page, 0, 0, 6)
    assert selected(page) == [0, 1, 5, 6]


def test_more_classes_than_colours_still_look_different(mount: Callable) -> None:
    """The ninth class has the colour of the first and another shape."""
    names = [f"class {i}" for i in range(10)]
    classes = np.arange(SIDE**2) % 10
    page = mount(two_panels(classes=classes, class_names=names, color_by="class"))
    looks = page.evaluate(
        "[...document.querySelectorAll('.wb-legend button canvas')].map((c) => c.toDataURL())"
    )
    assert len(set(looks)) == 10


@pytest.mark.parametrize(
    ("count", "width", "columns"),
    [(4, 1250, 4), (4, 680, 2), (4, 380, 1), (5, 1250, 3), (6, 1250, 3), (6, 680, 2)],
    ids=lambda value: str(value),
)
def test_panels_fit_the_width(mount: Callable, count: int, width: int, columns: int) -> None:
    """Up to six panels fill their rows, in line with each other, and nothing sticks out."""
    panels = [{"title": t * (40 if t == "B" else 1), "state": "ready"} for t in "ABCDEF"[:count]]
    page = mount(ScatterPanels(panels=panels, points=[ROWS_UP] * count), width=width)
    boxes = [box_of(page, i) for i in range(count)]
    assert len({round(box["x"]) for box in boxes}) == columns
    assert len({round(box["y"]) for box in boxes}) == -(-count // columns)
    assert page.evaluate("mounted[0].el.scrollWidth <= mounted[0].el.clientWidth")
    page.locator(".wb-plot").last.scroll_into_view_if_needed()
    drag_around(page, count - 1, 0, 6)
    assert selected(page) == [0, 1, 5, 6]


def test_more_than_six_panels_are_refused() -> None:
    """The trait takes six."""
    with pytest.raises(TraitError):
        ScatterPanels(panels=[{}] * 7)


def test_what_is_hovered_elsewhere_is_ringed(mount: Callable) -> None:
    """Another view on the channel can say which sample is hovered."""
    page = mount(two_panels())
    page.evaluate("""() => document.dispatchEvent(
        new CustomEvent("workbench-hover", { detail: { channel: "test", sample: 12 } }))""")
    assert page.locator(".wb-hover").inner_text() == "sample 12"
    x, y = place(page, 1, 12)
    assert any(page.evaluate(_ALPHA, [".wb-top", 1, x + dx, y]) for dx in (6, 7, 8))


def test_hovering_moves_nothing(mount: Callable) -> None:
    """The panels stay where they are when there is something to say about samples."""
    page = mount(two_panels(selection=[]), width=500)
    before = box_of(page, 0)
    page.mouse.click(*point(page, 0, 12))
    assert page.locator(".wb-hover").inner_text() == "sample 12"
    assert page.locator(".wb-count").inner_text() == "1 of 25 samples selected"
    assert box_of(page, 0) == before


@pytest.mark.parametrize(
    ("scheme", "lightness"), [("light", 255), ("dark", 22)], ids=["light", "dark"]
)
def test_without_jupyterlab_the_system_theme_decides(
    mount: Callable, visit: Any, scheme: str, lightness: int
) -> None:
    """The ground and the marks are those of the theme."""
    visit.page.emulate_media(color_scheme=scheme)
    page = mount(two_panels())
    ground = page.evaluate("getComputedStyle(document.querySelector('.wb')).backgroundColor")
    assert ground == f"rgb({lightness}, {lightness}, {lightness})"
    before = page.evaluate("document.querySelector('.wb-base').toDataURL()")
    visit.page.emulate_media(color_scheme="dark" if scheme == "light" else "light")
    page.wait_for_function(
        "(before) => document.querySelector('.wb-base').toDataURL() !== before", arg=before
    )


def test_a_change_of_theme_redraws(mount: Callable) -> None:
    """JupyterLab's switch to dark is followed without a reload."""
    page = mount(two_panels())
    before = page.evaluate("document.querySelector('.wb-base').toDataURL()")
    page.evaluate("""() => {
        document.body.style.setProperty("--jp-layout-color0", "#111111");
        document.body.dataset.jpThemeName = "JupyterLab Dark"; }""")
    page.wait_for_function(
        "(before) => document.querySelector('.wb-base').toDataURL() !== before", arg=before
    )


def test_a_closed_view_listens_no_more(mount: Callable) -> None:
    """After its end, changes of the model draw nothing and raise nothing."""
    page = mount(two_panels())
    page.evaluate("mounted[0].end()")
    page.evaluate("mounted[0].model.set('selection', new DataView(Int32Array.of(3).buffer))")
    assert not is_marked(page, 0, 3)
