"""Interval plots show the estimates they are given."""

from __future__ import annotations

import pytest

from workbench.errors import WorkbenchError
from workbench.experiments.bootstrap import Estimate
from workbench.figures.intervals import interval_plot

FIRST = {
    "before": {"A": Estimate(0.8, 0.7, 1.0, 9), "B": Estimate(0.5, 0.4, 0.9, 9)},
    "after": {"B": Estimate(0.6, 0.5, 0.7, 9)},
}
SECOND = {"after": {"C": Estimate(2.0, 1.0, 4.0, 7)}}


def test_dots_and_lines_are_the_estimates():
    """Values, ends of intervals and rows are those given, series by series."""
    before, after, other = interval_plot({"one": FIRST, "two": SECOND}, x_title="ratio").data
    assert list(before.x) == [0.8, 0.5]
    assert list(before.error_x.array) == pytest.approx([0.2, 0.4])
    assert list(before.error_x.arrayminus) == pytest.approx([0.1, 0.1])
    assert (list(after.x), list(other.x)) == ([0.6], [2.0])
    assert [trace.name for trace in (before, after, other)] == ["before", "after", "after"]


def test_series_of_one_row_do_not_hide_each_other():
    """They lie around the middle of their row; one that is alone lies in it."""
    before, after, other = interval_plot({"one": FIRST, "two": SECOND}, x_title="ratio").data
    assert before.y[0] == 0
    assert before.y[1] < 1 < after.y[0]
    assert other.y[0] == 0


def test_panels_share_series_and_axis():
    """A series is named once and keeps its colour; the reference stands in every panel."""
    figure = interval_plot(
        {"one": FIRST, "two": SECOND}, x_title="ratio", reference=1.0, logarithmic=True
    )
    _, after, other = figure.data
    assert [trace.showlegend for trace in figure.data] == [True, True, False]
    assert after.marker.color == other.marker.color
    assert after.marker.symbol == other.marker.symbol
    assert [line.x0 for line in figure.layout.shapes] == [1.0, 1.0]
    assert {axis.type for axis in figure.select_xaxes()} == {"log"}
    assert [title.text for title in figure.layout.annotations] == ["<b>one</b>", "<b>two</b>"]
    assert list(figure.layout.yaxis.ticktext) == ["A", "B"]


def test_a_series_alone_needs_no_legend():
    """What all dots are is said by the axis."""
    (trace,) = interval_plot({"two": SECOND}, x_title="ratio").data
    assert trace.showlegend is False


def test_nothing_to_draw_is_refused():
    """A panel without estimates is left out; none at all is an error."""
    assert len(interval_plot({"none": {"before": {}}, "two": SECOND}, x_title="ratio").data) == 1
    with pytest.raises(WorkbenchError, match="no estimate to draw"):
        interval_plot({"none": {"before": {}}}, x_title="ratio")
