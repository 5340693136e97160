"""Charts of medians and ranges show the quantiles of what they are given."""

from __future__ import annotations

import pytest

from workbench.errors import WorkbenchError
from workbench.figures.ranges import range_chart

TIMES = {
    "project": {"PCA": [1.0, 2.0, 3.0, 4.0, 50.0], "MDS": [10.0]},
    "optimize": {"PCA": [5.0, 7.0], "MDS": [9.0]},
}


def _traces(name: str):
    figure = range_chart(TIMES, x_title="seconds")
    return [trace for trace in figure.data if trace.legendgroup == name]


def test_dots_are_medians_and_lines_quartiles_and_ranges():
    """Median 3, quartiles 2 and 4, from 1 to 50."""
    whole, middle, dots = _traces("project")
    assert list(dots.x) == [3.0, 10.0]
    assert list(middle.x)[:2] == [2.0, 4.0]
    assert list(whole.x)[:2] == [1.0, 50.0]
    assert whole.line.width < middle.line.width


def test_series_lie_beside_each_other_in_the_row_of_their_category():
    """The first series is above the second, both nearer to their row than to the next."""
    (first, second) = (_traces(name)[-1] for name in TIMES)
    for row, (y_first, y_second) in enumerate(zip(first.y, second.y, strict=True)):
        assert row - 0.5 < y_first < row < y_second < row + 0.5


def test_categories_run_down_a_logarithmic_axis():
    """The first category is on top."""
    layout = range_chart(TIMES, x_title="seconds").layout
    assert list(layout.yaxis.ticktext) == ["PCA", "MDS"]
    assert layout.yaxis.range[0] > layout.yaxis.range[1]
    assert (layout.xaxis.type, layout.xaxis.title.text) == ("log", "seconds")


@pytest.mark.parametrize("values", [[0.0, 1.0], [-1.0], [], [float("nan")]], ids=str)
def test_what_has_no_logarithm_is_refused(values):
    """The message names the category."""
    with pytest.raises(WorkbenchError, match="PCA"):
        range_chart({"project": {"PCA": values}}, x_title="seconds")


def test_nothing_to_draw_is_refused():
    """There is no chart without a value."""
    with pytest.raises(WorkbenchError, match="groups: got no values"):
        range_chart({"project": {}}, x_title="seconds")


def test_the_axis_holds_every_value():
    """The range, in powers of ten, leaves a margin on both sides; equal values have one too."""
    low, high = range_chart(TIMES, x_title="seconds").layout.xaxis.range
    assert 10**low < 1.0
    assert 10**high > 50.0
    low, high = range_chart({"project": {"PCA": [2.0]}}, x_title="seconds").layout.xaxis.range
    assert 10**low < 2.0 < 10**high
