"""Trade-offs show the points they are given."""

from __future__ import annotations

import pytest

from workbench.errors import WorkbenchError
from workbench.figures.tradeoffs import Curve, trade_off

CURVES = [
    Curve("Slerp & co", [1, 2, 4], [8.0, 4.0, 2.0], ["1 %", "2 %", "4 %"]),
    Curve("t-SNE", [2, 3], [5.0, 3.0], low=[4.0, 2.5], high=[6.0, 3.5]),
]


def test_points_are_where_they_were_given():
    """Each curve has its points in order, and a band only where there is an interval."""
    first, band, second = trade_off(CURVES, x_title="bytes", y_title="error").data
    assert (list(first.x), list(first.y)) == ([1, 2, 4], [8.0, 4.0, 2.0])
    assert (list(second.x), list(second.y)) == ([2, 3], [5.0, 3.0])
    assert (list(band.x), list(band.y)) == ([2, 3, 3, 2], [6.0, 3.5, 2.5, 4.0])
    assert "2 %" in first.customdata
    assert first.name == "Slerp &amp; co"


def test_labels_stand_beside_their_points():
    """Only a curve with labels has text in the picture."""
    curves = [Curve("a", [1, 2], [3, 4], labels=["1 %", "2 %"]), Curve("b", [1], [2])]
    labelled, plain = trade_off(curves, x_title="", y_title="").data
    assert list(labelled.text) == ["1 %", "2 %"]
    assert ("text" in labelled.mode, "text" in plain.mode) == (True, False)


def test_seven_curves_can_be_told_apart_without_colour():
    """Markers differ, for print in grey."""
    many = [Curve(str(i), [1], [1]) for i in range(7)]
    traces = trade_off(many, x_title="", y_title="").data
    assert len({trace.marker.symbol for trace in traces}) == 7


def test_axes_are_as_asked_for():
    """A logarithmic axis has plain numbers where they are wanted, a reference is a line."""
    layout = trade_off(
        CURVES, x_title="share", y_title="gain", log_x=True, x_ticks=[1, 50], reference=1.0
    ).layout
    assert (layout.xaxis.type, list(layout.xaxis.ticktext)) == ("log", ["1", "50"])
    assert layout.yaxis.type != "log"
    assert [line.y0 for line in layout.shapes] == [1.0]


@pytest.mark.parametrize("curves", [[], [Curve("a", [], [])]], ids=["no curve", "no point"])
def test_nothing_to_draw_is_refused(curves):
    """Empty axes would look like a result."""
    with pytest.raises(WorkbenchError, match="no point"):
        trade_off(curves, x_title="", y_title="")
