"""One figure as PNG, for those who want a picture rather than a report."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from workbench.errors import WorkbenchError
from workbench.reproduction.images import write_pngs

if TYPE_CHECKING:
    import plotly.graph_objects as go


def figure_png(figure: go.Figure) -> bytes:
    """Render a figure as PNG.

    Parameters
    ----------
    figure : plotly.graph_objects.Figure
        Any; one that sets its own height keeps it.

    Returns
    -------
    bytes
        The content of a PNG file, 2000 pixels wide.

    Raises
    ------
    WorkbenchError
        If there is no Chrome or Chromium, or it takes too long.
    """
    with TemporaryDirectory() as folder:
        described = Path(folder) / "figure.json"
        described.write_text(figure.to_json(), encoding="utf-8")
        complaint = write_pngs([described])
        if complaint:
            raise WorkbenchError(f"{complaint} An .svg file needs no browser.")
        return described.with_suffix(".png").read_bytes()
