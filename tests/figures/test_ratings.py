"""Figures of a user study show every answer and every difference as it is."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pandas as pd
import pytest
from scipy import stats

from workbench.errors import WorkbenchError
from workbench.figures.ratings import difference_figure, rating_figure
from workbench.study.comparisons import compare_stimuli
from workbench.study.published_tests import implied_comparisons

RATINGS = pd.DataFrame(
    np.random.default_rng(0).integers(1, 11, size=(6, 3)).astype(float),
    index=list("123456"),
    columns=["original", "saliency", "<b>uniform</b> %{x}"],
)


def test_every_answer_is_drawn_in_its_cell():
    """The place of a marker rounds to the rating and the row of its participant."""
    for name, trace in zip(RATINGS.columns, rating_figure(RATINGS).data[::2], strict=True):
        assert np.round(trace.x).tolist() == RATINGS[name].tolist()
        assert np.round(trace.y).tolist() == list(range(6))
        assert [answer[0] for answer in trace.customdata] == list("123456")


def test_equal_ratings_do_not_hide_each_other():
    """Four equal ratings of one participant are four places."""
    equal = pd.DataFrame([[7.0] * 4], columns=list("abcd"))
    places = [(trace.x[0], trace.y[0]) for trace in rating_figure(equal).data[::2]]
    assert min(math.dist(*pair) for pair in pairwise(places)) > 0.2


def test_means_have_students_interval():
    """The bar below is the 95 % interval that scipy gives."""
    for name, trace in zip(RATINGS.columns, rating_figure(RATINGS).data[1::2], strict=True):
        interval = stats.ttest_1samp(RATINGS[name], 0).confidence_interval()
        assert trace.x[0] == pytest.approx(RATINGS[name].mean())
        assert trace.x[0] + trace.error_x.array[0] == pytest.approx(interval.high)


def test_answers_that_lack_are_not_drawn():
    """A gap is no rating; a stimulus that nobody rated has no mean, one answer no interval."""
    gaps = RATINGS.copy()
    gaps.iloc[2, 0] = np.nan
    gaps.iloc[1:, 1] = np.nan
    gaps.iloc[:, 2] = np.nan
    answers, mean, single, its_mean, none = rating_figure(gaps).data
    assert (len(answers.x), len(single.x), len(none.x)) == (5, 1, 0)
    assert mean.x[0] == pytest.approx(gaps["original"].mean())
    assert its_mean.error_x.array[0] == 0
    with pytest.raises(WorkbenchError, match="got none to draw"):
        rating_figure(gaps[[gaps.columns[2]]])


def test_names_are_text():
    """Tags and fields in a stimulus's name are neither drawn as markup nor filled in."""
    trace = rating_figure(RATINGS).data[-2]
    assert trace.name == "&lt;b&gt;uniform&lt;/b&gt; %&#123;x}"
    assert trace.hovertemplate.endswith(f"<extra>{trace.name}</extra>")


def test_differences_stand_at_their_means_with_their_intervals():
    """Both sources share rows; the bars end where the intervals do."""
    ours = compare_stimuli(RATINGS)
    table = {(c.first, c.second): (1.0, 0.03) for c in reversed(ours)}
    sources = {"ours": ours, "published": implied_comparisons(table, 20)}
    for trace, comparisons in zip(difference_figure(sources).data, sources.values(), strict=True):
        assert list(trace.x) == [c.mean_difference for c in comparisons]
        assert np.add(trace.x, trace.error_x.array) == pytest.approx([c.high for c in comparisons])
    first, second = difference_figure(sources).data
    assert np.round(first.y).tolist() == [0, 1, 2]
    assert np.round(second.y).tolist() == [2, 1, 0]
    assert first.marker.color[0] != second.marker.color[0]


def test_an_unknown_interval_is_an_open_marker_without_a_bar():
    """What the published numbers do not tell is not drawn."""
    table = {("a", "b"): (0.0, 0.5), ("a", "c"): (1.0, 0.03)}
    (trace,) = difference_figure({"published": implied_comparisons(table, 20)}).data
    assert trace.error_x.array[0] is None
    assert trace.marker.color[0] == "white"
    assert trace.marker.color[1] != "white"
    assert "no interval" in trace.customdata[0]


def test_nothing_to_compare_is_refused():
    """An empty figure would look like a result."""
    with pytest.raises(WorkbenchError, match="no comparison"):
        difference_figure({"ours": []})


def test_axes_of_small_and_large_differences_can_be_compared():
    """Small differences do not fill the axis, large ones stay on it."""
    small = implied_comparisons({("a", "b"): (0.1, 0.001)}, 20)
    large = implied_comparisons({("a", "b"): (6.0, 0.001)}, 20)
    assert list(difference_figure({"ours": small}).layout.xaxis.range) == [-1.1, 3.1]
    assert difference_figure({"ours": large}).layout.xaxis.range[1] > large[0].high
