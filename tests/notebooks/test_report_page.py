"""The report in a real browser, opened from a folder."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pandas as pd
import plotly.graph_objects as go
import pytest

from tests.browser.chromium import open_browser
from tests.notebooks.screenshot_report import open_report
from workbench.files import write_atomically
from workbench.reproduction.items import Item
from workbench.reproduction.outputs import Outputs
from workbench.reproduction.report import write_report

pytestmark = pytest.mark.browser

ITEM = Item("test:fig1", "A line", "Nowhere, Figure 1", "none")


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Start Chromium; a missing one fails in CI and is a reported skip elsewhere."""
    with open_browser() as found:
        if found is None:
            reason = "no chromium on this machine: the report cannot be looked at"
            if os.environ.get("CI") == "true":
                pytest.fail(reason)
            pytest.skip(reason)
        yield found


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Make an output folder with one figure and one table wider than a phone."""
    folder = tmp_path_factory.mktemp("out")
    outputs = Outputs(folder)
    line = go.Figure(go.Scatter(x=[1, 2, 3], y=[3, 5, 4], name="</script>"), layout={"height": 300})
    outputs.figure(ITEM.id, line, caption="A line.", alt="A line of three points.")
    wide = pd.DataFrame({f"column number {i}": [0.5 * i] for i in range(25)}, index=["row"])
    outputs.table(ITEM.id, wide, caption="A wide table.")
    write_atomically(
        folder / "run.json", b'{"profile": "quick", "seed": 0, "seconds": 3.0, "notices": []}'
    )
    write_report(folder, [ITEM])
    return folder


@pytest.mark.parametrize("width", [1280, 700, 390])
def test_the_page_fits_the_window(browser: Any, out: Path, width: int):
    """Figures are drawn, and wide tables scroll in their frame, not the page."""
    page = open_report(browser, out, width=width)
    assert page.complaints == []
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert page.locator(".plot .scatterlayer path.js-line").count() == 1
    drawn = page.locator(".plot .main-svg").first.bounding_box()
    assert 0.6 * width < drawn["width"] <= width
    frame = page.locator(".scroll").first
    assert frame.evaluate("e => e.scrollWidth > e.clientWidth")
    page.close()


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_text_can_be_read(browser: Any, out: Path, dark: bool):
    """Text has a contrast of 4.5 or more to its ground, in light and dark pages."""
    page = open_report(browser, out, dark=dark)
    for selector in (
        "h1",
        ".lead",
        "figcaption",
        ".eyebrow",
        ".badge",
        "thead th",
        "footer p",
        "a",
    ):
        ratio = page.locator(selector).first.evaluate(_CONTRAST)
        assert ratio >= 4.5, (selector, ratio)
    page.close()


_CONTRAST = """
(element) => {
  const channels = (color) => color.match(/[\\d.]+/g).map(Number);
  const luminance = (color) => {
    const [r, g, b] = channels(color).map((c) => {
      const s = c / 255;
      return s <= 0.03928 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  let ground = element;
  while (channels(getComputedStyle(ground).backgroundColor)[3] === 0) ground = ground.parentElement;
  const pair = [
    luminance(getComputedStyle(element).color),
    luminance(getComputedStyle(ground).backgroundColor),
  ].sort((a, b) => b - a);
  return (pair[0] + 0.05) / (pair[1] + 0.05);
}
"""
