"""Line charts show what they are given, and lines look alike in all panels."""

from __future__ import annotations

import pytest

from workbench.errors import WorkbenchError
from workbench.figures.lines import LinePanel, line_panels

WALK = LinePanel("walk", {"slerp": {1: 0.9, 2: 0.5}, "t-SNE": {1: 0.8, 2: 0.4}})
RUN = LinePanel("run", {"t-SNE": {3: 0.7, 4: 0.6}})


def _chart(**options):
    return line_panels([WALK, RUN], x_title="keyframes", y_title="error", **options)


def test_lines_pass_through_the_values():
    """Each line holds its values in the panel that it belongs to."""
    figure = _chart()
    found = {
        (trace.xaxis, trace.name): dict(zip(trace.x, trace.y, strict=True)) for trace in figure.data
    }
    assert found == {
        ("x", "slerp"): WALK.lines["slerp"],
        ("x", "t-SNE"): WALK.lines["t-SNE"],
        ("x2", "t-SNE"): RUN.lines["t-SNE"],
    }
    assert [note.text for note in figure.layout.annotations] == ["walk", "run"]


def test_a_line_looks_alike_in_all_panels_and_is_in_the_legend_once():
    """Colour, symbol and dash follow the name."""
    first, second = (trace for trace in _chart(dashed=["slerp"]).data if trace.name == "t-SNE")
    assert first.line == second.line
    assert first.marker == second.marker
    assert (first.showlegend, second.showlegend) == (True, False)


def test_dashed_lines_are_told_apart():
    """Only the named lines are dotted."""
    dashes = {trace.name: trace.line.dash for trace in _chart(dashed=["slerp"]).data}
    assert dashes == {"slerp": "dot", "t-SNE": "solid"}


def test_the_band_is_shaded_in_every_panel():
    """One rectangle per panel, from one end of the band to the other."""
    shapes = _chart(band=(2, 4)).layout.shapes
    assert [(shape.x0, shape.x1) for shape in shapes] == [(2, 4), (2, 4)]
    assert {shape.xref for shape in shapes} == {"x", "x2"}


def test_the_axis_starts_at_zero_and_is_named_at_the_bottom():
    """Errors are compared by their size; the last chart of a column names the x-axis."""
    figure = line_panels([WALK, RUN, RUN], x_title="keyframes", y_title="error")
    assert all(axis.rangemode == "tozero" for axis in figure.select_yaxes())
    named = {axis.anchor for axis in figure.select_xaxes() if axis.title.text}
    assert named == {"y2", "y3"}


def test_nothing_to_draw_is_refused():
    """Panels without a line, and no columns, are errors that name the argument."""
    with pytest.raises(WorkbenchError, match="panels: got none with a line"):
        line_panels([LinePanel("empty", {})], x_title="", y_title="")
    with pytest.raises(WorkbenchError, match="panels: got none with a line"):
        line_panels([], x_title="", y_title="")
    with pytest.raises(WorkbenchError, match="n_columns: got 0"):
        _chart(n_columns=0)
