"""Figures of the keyframe experiments show the values that they are given."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from workbench.errors import WorkbenchError
from workbench.figures.parameter_curves import ParameterPanel, parameter_curves
from workbench.figures.reading_points import reading_points
from workbench.figures.salient_curves import candidate_figure, candidate_rows, saliency_figure
from workbench.figures.strips import strip_plot
from workbench.figures.time_growth import time_growth

SECONDS = np.arange(6) / 10
CURVE = [3.0, 1.0, 4.0, 1.0, 5.0, 9.0]


def named(figure):
    """Give the traces by their names."""
    return {trace.name: trace for trace in figure.data}


def test_saliency_colours_the_curve():
    """The points are coloured by saliency, which is drawn below with its mean."""
    figure = saliency_figure(SECONDS, CURVE, [0, 1, 2, 1, 0, 2], y_title="angle")
    points, line = figure.data
    assert list(points.y) == CURVE
    assert list(points.marker.color) == list(line.y) == [0, 1, 2, 1, 0, 2]
    assert [shape.y0 for shape in figure.layout.shapes] == [1.0]


def test_candidates_are_marked():
    """Only frames that are candidates have a dot."""
    chosen = [False, True, True, False, False, True]
    dots = candidate_figure(SECONDS, CURVE, chosen, y_title="angle").data[1]
    assert list(dots.x) == [0.1, 0.2, 0.5]
    assert list(dots.y) == [1.0, 4.0, 9.0]


def test_candidate_rows_are_runs_of_frames():
    """A bar covers each run of candidates, a frame before and after it by half."""
    candidates = np.array([[1, 0], [1, 0], [0, 1], [0, 1], [0, 1], [1, 0]], dtype=bool)
    figure = candidate_rows(SECONDS, candidates, [(0, 2), (3, 5)], [1, 4], names=["one", "two"])
    first, second, clusters, keys = figure.data
    assert list(first.base) == pytest.approx([-0.05, 0.45])
    assert list(first.x) == pytest.approx([0.2, 0.1])
    assert list(second.x) == pytest.approx([0.3])
    assert list(clusters.x) == pytest.approx([0.3, 0.3])
    assert list(keys.x) == pytest.approx([0.1, 0.4])
    assert list(figure.layout.yaxis.categoryarray) == ["clusters", "two", "one"]


def test_parameter_curves_show_motions_median_and_example():
    """The median is over all motions, the example among them; the band is shaded."""
    curves = pd.DataFrame({1: [4.0, 6.0, 8.0], 2: [3.0, 3.0, 9.0]}, index=["a", "b", "c"])
    panel = ParameterPanel("k", "k", curves, (7.0, 10.0), "b")
    figure = parameter_curves([panel], y_title="error")
    traces = named(figure)
    assert list(traces["median"].y) == [6.0, 3.0]
    assert list(traces["example"].y) == [6.0, 3.0]
    assert sorted(t.y[0] for t in figure.data if t.name == "each motion") == [4.0, 8.0]
    assert [(shape.x0, shape.x1) for shape in figure.layout.shapes] == [(7.0, 10.0)]


def test_strips_have_a_dot_for_each_clip():
    """Dots lie near the row of their method; the median has its interval."""
    groups = {"A": {"x": 1.0, "y": 2.0}, "none": {}, "B": {"x": 0.5}}
    figure = strip_plot(
        groups, x_title="ratio", reference=1.0, medians={"A": (1.5, 1.2, 1.9)}, marked="y"
    )
    traces = named(figure)
    assert sorted(traces["one clip"].x) == [0.5, 1.0]
    assert list(traces["y"].x) == [2.0]
    median = traces["median, 95 % interval"]
    assert list(median.x) == [1.5]
    assert list(median.error_x.array) == pytest.approx([0.4])
    assert list(median.error_x.arrayminus) == pytest.approx([0.3])
    rows = dict(zip(figure.layout.yaxis.ticktext, figure.layout.yaxis.tickvals, strict=True))
    assert rows == {"A": 1, "B": 0}
    assert list(traces["one clip"].y) == pytest.approx([1, 0], abs=0.3)


def test_ratios_are_drawn_on_a_logarithmic_axis():
    """The line of the reference is placed by value, its note by the logarithm."""
    figure = strip_plot(
        {"A": {"x": 4.0}},
        x_title="ratio",
        reference=10.0,
        medians={},
        sides=("below", "above"),
        logarithmic=True,
    )
    assert figure.layout.xaxis.type == "log"
    assert figure.layout.shapes[0].x0 == 10.0
    assert [note.x for note in figure.layout.annotations] == [1.0, 1.0]


def test_the_line_of_times_is_that_of_least_squares():
    """Times on a line are met by it; the range is that of the repetitions."""
    seconds = pd.DataFrame({100: [1.0, 1.2, 0.8], 300: [3.0, 3.3, 2.9]})
    line, points = time_growth(seconds, x_title="frames", note="published").data
    assert list(line.y) == pytest.approx([1.0, 3.0])
    assert "10000.0 µs per frame" in line.name
    assert list(points.error_y.array) == pytest.approx([0.2, 0.3])


def test_readings_stand_where_they_are():
    """Each reading is a point; the published values a star in a box of the tolerance."""
    figure = reading_points(
        {"4σ": [(127, 42.8, "D′")], "2σ": [(210, 46.7, "D′")]},
        published=(131, 42.9),
        default=(127, 42.8),
        others={"PB": (129, 46.05), "Chord": (129, 39.4), "SCS": (129, 46.2)},
        tolerance=(13, 1.5),
    )
    traces = named(figure)
    assert (traces["2σ"].x[0], traces["2σ"].y[0]) == (210, 46.7)
    assert (traces["published"].x[0], traces["published"].y[0]) == (131, 42.9)
    assert traces["PB"].y[0] == 46.05
    assert [note.text for note in figure.layout.annotations] == ["PB, SCS", "Chord"]
    box = figure.layout.shapes[0]
    assert (box.x0, box.x1, box.y0, box.y1) == pytest.approx((118, 144, 41.4, 44.4))


@pytest.mark.parametrize(
    "draw",
    [
        lambda: parameter_curves([], y_title="error"),
        lambda: strip_plot({"A": {}}, x_title="x", reference=1.0, medians={}),
        lambda: time_growth(pd.DataFrame({1: [1.0]}), x_title="frames"),
        lambda: reading_points({"4σ": []}),
    ],
    ids=["panels", "strips", "times", "readings"],
)
def test_nothing_to_draw_is_refused(draw):
    """An empty figure would look like a result."""
    with pytest.raises(WorkbenchError, match="got"):
        draw()
