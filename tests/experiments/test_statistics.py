"""Box plot statistics by the rule of the thesis."""

from __future__ import annotations

import statistics

import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.errors import WorkbenchError
from workbench.experiments.statistics import boxplot_statistics

VALUES = st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=60)


def test_known_values():
    """Of 1, 2, 3, 4, 20: the quartiles are 2, 3 and 4, so 20 lies beyond 4 + 3."""
    box = boxplot_statistics([4, 20, 1, 3, 2])
    assert (box.whisker_bottom, box.q1, box.median, box.q3, box.whisker_top) == (1, 2, 3, 4, 4)
    assert (box.n_outliers, box.outliers) == (1, (20.0,))


def test_whiskers_end_at_data_not_at_fences():
    """The top whisker is the highest value below the fence, which itself is no value."""
    box = boxplot_statistics([0, 10, 11, 12, 13, 14, 15, 16, 17.5])
    assert (box.q1, box.q3) == (11.0, 15.0)
    assert (box.whisker_bottom, box.whisker_top) == (10.0, 17.5)
    assert box.outliers == (0.0,)


@given(VALUES)
def test_quartiles_agree_with_the_standard_library(values):
    """Quartiles are those of ``statistics.quantiles`` by its inclusive method."""
    box = boxplot_statistics(values)
    expected = statistics.quantiles(values, n=4, method="inclusive")
    assert [box.q1, box.median, box.q3] == pytest.approx(expected, rel=1e-9, abs=1e-6)


@given(VALUES)
def test_every_value_is_inside_or_an_outlier(values):
    """The whiskers are data, and what is not between them is counted as an outlier."""
    box = boxplot_statistics(values)
    assert {box.whisker_bottom, box.whisker_top} <= {float(value) for value in values}
    inside = [value for value in values if box.whisker_bottom <= value <= box.whisker_top]
    assert len(inside) + box.n_outliers == len(values)
    assert len(box.outliers) == box.n_outliers


def test_equal_values_are_no_outliers():
    """Where all values are equal, the box is that value."""
    box = boxplot_statistics([0.1] * 7)
    assert (box.whisker_bottom, box.whisker_top, box.n_outliers) == (0.1, 0.1, 0)


@pytest.mark.parametrize("values", [[], [1.0, float("nan")]], ids=["none", "nan"])
def test_what_has_no_box_is_refused(values):
    """No values, or one that is not a number, is an error that says so."""
    with pytest.raises(WorkbenchError, match="values: got"):
        boxplot_statistics(values)
