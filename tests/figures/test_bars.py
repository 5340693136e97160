"""Grouped bars have the heights that they are given, on one scale."""

from __future__ import annotations

import pytest

from workbench.errors import WorkbenchError
from workbench.figures.bars import Reference, bar_panels

PANELS = {
    "raw": {"US": {"PCA": 0.5, "MDS": 0.4}, "SCS": {"PCA": 0.6, "MDS": 0.7}},
    "optimized": {"US": {"PCA": 0.2}},
}


def test_bars_have_the_heights_given():
    """Each series stands in its panel with its values in order."""
    raw_us, raw_scs, optimized = bar_panels(PANELS, y_title="error").data
    assert (list(raw_us.x), list(raw_us.y)) == (["PCA", "MDS"], [0.5, 0.4])
    assert list(raw_scs.y) == [0.6, 0.7]
    assert (optimized.xaxis, list(optimized.y)) == ("x2", [0.2])


def test_panels_share_one_scale_from_zero():
    """Heights can be compared across panels, and above the highest bar there is room."""
    ranges = {axis.range for axis in bar_panels(PANELS, y_title="error").select_yaxes()}
    ((low, high),) = ranges
    assert low == 0
    assert 0.7 < high < 0.8


def test_a_series_has_one_colour_and_one_entry_in_the_legend():
    """A colour that is given replaces that of the palette in every panel."""
    figure = bar_panels(PANELS, y_title="error", colors={"US": "#123456"})
    series = [trace for trace in figure.data if trace.name == "US"]
    assert [trace.marker.color for trace in series] == ["#123456", "#123456"]
    assert [trace.showlegend for trace in series] == [True, False]


def test_a_reference_crosses_all_panels_and_is_in_range():
    """It is drawn once per panel, named in the legend, and the axis reaches it."""
    figure = bar_panels(PANELS, y_title="error", reference=Reference(1.0, "before"))
    assert [shape.y0 for shape in figure.layout.shapes] == [1.0, 1.0]
    assert figure.data[-1].name == "before"
    assert figure.layout.yaxis.range[1] > 1.0


@pytest.mark.parametrize("panels", [{}, {"raw": {}}, {"raw": {"US": {}}}], ids=str)
def test_no_bar_is_refused(panels):
    """There is no chart without a bar."""
    with pytest.raises(WorkbenchError, match="panels: got no bar"):
        bar_panels(panels, y_title="error")
