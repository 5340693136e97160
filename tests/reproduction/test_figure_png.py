"""One figure as PNG."""

from __future__ import annotations

import os
from io import BytesIO

import plotly.graph_objects as go
import pytest
from PIL import Image

from tests.browser.chromium import chromium_path
from workbench.errors import WorkbenchError
from workbench.reproduction import figure_png as module
from workbench.reproduction.figure_png import figure_png


@pytest.mark.browser
def test_a_figure_keeps_its_height() -> None:
    """Two pixels for each that the figure asks for."""
    if chromium_path() is None:
        assert os.environ.get("CI") != "true", "no chromium in CI"
        pytest.skip("no chromium on this machine: no PNG can be made")
    figure = go.Figure(go.Scatter(x=[1, 2], y=[1, 2]), layout={"height": 240})
    with Image.open(BytesIO(figure_png(figure))) as image:
        assert (image.format, image.size) == ("PNG", (2000, 480))


def test_a_missing_browser_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """The message says why, and what would do without one."""
    monkeypatch.setattr(module, "write_pngs", lambda figures: "No PNG images: no browser.")
    with pytest.raises(WorkbenchError, match=r"no browser\. An \.svg file needs no browser\."):
        figure_png(go.Figure())
