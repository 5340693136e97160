"""What the tests of the scatter panels share: samples whose places are known, and drags."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.widgets import ScatterPanels

MARGIN = 12  # of a panel, in pixels

# Two control points at the ends of a diagonal; the others lie between and beside them.
CONTROLS = np.array([0, 4])
POINTS = np.array([[0.0, 0.0], [0.25, 0.6], [0.5, 0.5], [0.75, 0.4], [1.0, 1.0]])
INFLUENCE = np.array([[1.0, 0.0], [0.75, 0.25], [0.5, 0.5], [0.25, 0.75], [0.0, 1.0]])

_ALPHA = """
([layer, panel, x, y]) => {
  const canvas = document.querySelectorAll(layer)[panel];
  return canvas.getContext("2d").getImageData(Math.round(x), Math.round(y), 1, 1).data[3];
}
"""
_FLOATS = """
(name) => { const view = mounted[0].model.get(name);
            const end = view.byteOffset + view.byteLength;
            return [...new Float32Array(view.buffer.slice(view.byteOffset, end))]; }
"""
_SET_FLOATS = """
([name, values]) => {
  const numbers = Float32Array.from(values, (value) => value ?? NaN);
  mounted[0].model.set(name, new DataView(numbers.buffer));
}
"""


def movable_panels(**traits: Any) -> ScatterPanels:
    """Two panels with the same samples, the second one mirrored."""
    given: dict[str, Any] = {
        "panels": [{"title": "A", "state": "ready"}, {"title": "B", "state": "ready"}],
        "points": [POINTS, POINTS * [-1, 1]],
        "control_points": CONTROLS,
        "influence": INFLUENCE,
        "movable": True,
        "transition": 0,
    }
    return ScatterPanels(**{**given, **traits})


def box_of(page: Any, panel: int) -> dict[str, float]:
    # The drawing lies within a border of one pixel.
    return page.locator(".wb-base").nth(panel).bounding_box()


def place(page: Any, panel: int, position: Any) -> tuple[float, float]:
    """Compute where a position of the unit square is drawn, in pixels of its panel."""
    size = box_of(page, panel)["width"]
    x, y = position
    return MARGIN + x * (size - 2 * MARGIN), MARGIN + (1 - y) * (size - 2 * MARGIN)


def on_screen(page: Any, panel: int, position: Any) -> tuple[float, float]:
    box = box_of(page, panel)
    x, y = place(page, panel, position)
    return box["x"] + x, box["y"] + y


def is_drawn(page: Any, panel: int, position: Any, layer: str = ".wb-base") -> bool:
    return page.evaluate(_ALPHA, [layer, panel, *place(page, panel, position)]) > 0


def floats(page: Any, name: str) -> NDArray[np.float64]:
    """Read an array trait from the page's model."""
    return np.array(page.evaluate(_FLOATS, name), dtype=float)


def set_floats(page: Any, name: str, values: Any) -> None:
    """Set an array trait as Python would."""
    flat = [None if np.isnan(v) else float(v) for v in np.ravel(values)]
    page.evaluate(_SET_FLOATS, [name, flat])
    page.evaluate("new Promise((done) => requestAnimationFrame(done))")


def choose(page: Any, button: str) -> None:
    page.get_by_role("button", name=button, exact=True).click()


def saved_table(page: Any) -> str:
    """Save the table as a person would, and read it."""
    choose(page, "Save")
    with page.expect_download() as waiting:
        choose(page, "Table (CSV)")
    return waiting.value.path().read_text(encoding="utf-8")
