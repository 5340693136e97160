"""Box plots show the values they are given."""

from __future__ import annotations

import pytest

from workbench.errors import WorkbenchError
from workbench.figures.boxplots import Box, box_plot

OURS = {"A": Box(1, 2, 3, 4, 5, 2, (0.1, 9.0)), "B": Box(2, 3, 4, 5, 6)}
THEIRS = {"B": Box(0, 1, 2, 3, 4, 3), "C": Box(5, 6, 7, 8, 9)}


def test_quartiles_and_whiskers_are_drawn_as_given():
    """The traces hold the boxes' numbers, so plotly has no quartile to compute."""
    ours, _, theirs = box_plot({"ours": OURS, "published": THEIRS}, y_title="error").data
    assert list(ours.x) == ["A", "B"]
    assert list(theirs.x) == ["B", "C"]
    for trace, boxes in ((ours, OURS), (theirs, THEIRS)):
        assert list(trace.lowerfence) == [box.whisker_bottom for box in boxes.values()]
        assert list(trace.q1) == [box.q1 for box in boxes.values()]
        assert list(trace.median) == [box.median for box in boxes.values()]
        assert list(trace.q3) == [box.q3 for box in boxes.values()]
        assert list(trace.upperfence) == [box.whisker_top for box in boxes.values()]


def test_known_outliers_are_points():
    """Outliers stand at their values over their box; a mere count draws no point."""
    traces = box_plot({"ours": OURS, "published": THEIRS}, y_title="error").data
    points = [trace for trace in traces if trace.type == "scatter"]
    assert len(points) == 1
    assert (list(points[0].x), list(points[0].y)) == (["A", "A"], [0.1, 9.0])


def test_categories_keep_the_order_given():
    """The order of the published table is that of the axis."""
    figure = box_plot({"ours": OURS}, y_title="error", order=("B", "A", "D"))
    assert list(figure.layout.xaxis.categoryarray) == ["B", "A", "D"]
    assert figure.layout.yaxis.title.text == "error"


def test_a_reference_is_a_line_in_the_range_of_the_values():
    """Ratios near 1 are not squeezed against an axis from 0, which errors start at."""
    ratios = box_plot({"ours": OURS}, y_title="ratio", reference=1.0)
    assert [line.y0 for line in ratios.layout.shapes] == [1.0]
    low, high = ratios.layout.yaxis.range
    assert -0.5 < low < 0.1
    assert 9.0 < high < 9.5
    assert box_plot({"ours": OURS}, y_title="error").layout.yaxis.rangemode == "tozero"


def test_nothing_to_draw_is_refused():
    """An empty box plot would look like a result."""
    with pytest.raises(WorkbenchError, match="no box"):
        box_plot({"ours": {}}, y_title="error")
