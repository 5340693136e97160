"""What all figures share."""

from __future__ import annotations

import plotly.graph_objects as go
import plotly.io

from workbench.figures.style import offer_no_upload


def test_figures_in_notebooks_have_no_button_that_uploads_them():
    """Every kind of notebook is told to leave it out."""
    offer_no_upload()
    figure = go.Figure(go.Scatter(y=[1, 2])).to_dict()
    shown = plotly.io.renderers["plotly_mimetype"].to_mimebundle(figure)
    assert shown["application/vnd.plotly.v1+json"]["config"] == {"showSendToCloud": False}
    page = plotly.io.renderers["notebook"].to_mimebundle(figure)["text/html"]
    assert '"showSendToCloud": false' in page
