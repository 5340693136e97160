"""Scatter panels show the positions they are given."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.figures.embeddings import Panel, embedding_panels
from workbench.figures.style import class_style

POINTS = np.random.default_rng(0).random((12, 2))
LABELS = np.array(list("aabbccaabbcc"))
CONTROL = np.array([1, 2, 11])


def _panels(points=POINTS):
    return [Panel("raw", points, CONTROL), Panel("optimized", points + 0.1, CONTROL)]


def test_every_sample_is_drawn_once_at_its_place():
    """Samples of all classes, dots and crosses together, are the positions given."""
    figure = embedding_panels(_panels(), labels=LABELS)
    for axis, shift in (("x", 0.0), ("x2", 0.1)):
        traces = [t for t in figure.data if t.xaxis == axis and t.customdata is not None]
        samples = np.concatenate([trace.customdata for trace in traces])
        drawn = np.concatenate([np.stack([trace.x, trace.y], axis=1) for trace in traces])
        assert sorted(samples) == list(range(12))
        assert np.array_equal(drawn, POINTS[samples] + shift)


def test_control_points_are_crosses_in_the_colour_of_their_class():
    """Crosses are the control points and nothing else."""
    figure = embedding_panels(_panels(), labels=LABELS)
    crosses = [t for t in figure.data if t.marker.symbol == "x" and t.customdata is not None]
    assert sorted(np.concatenate([t.customdata for t in crosses])) == sorted([*CONTROL, *CONTROL])
    dots = {t.name: t.marker.color for t in figure.data if t.marker.symbol != "x"}
    assert all(cross.marker.color == dots[cross.name] for cross in crosses)


def test_classes_look_as_they_are_said_to():
    """A published figure's colours and order are kept; a class that it does not name follows."""
    styles = {"c": ("#101010", "square"), "a": ("#202020", "circle"), "x": ("#303030", "circle")}
    figure = embedding_panels(_panels(), labels=LABELS, styles=styles)
    dots = [t for t in figure.data if t.xaxis == "x" and t.marker.symbol != "x"]
    assert [t.name for t in dots] == ["c", "a", "b"]
    drawn = [(t.marker.color, t.marker.symbol) for t in dots]
    assert drawn == [styles["c"], styles["a"], class_style(2)]


def test_both_axes_of_a_panel_have_one_scale():
    """Distances in the plane mean something, so no axis is stretched."""
    layout = embedding_panels(_panels()).layout
    assert (layout.yaxis.scaleanchor, layout.yaxis2.scaleanchor) == ("x", "x2")


def test_the_legend_names_each_class_once():
    """Two panels do not double the legend."""
    figure = embedding_panels(_panels(), labels=LABELS)
    shown = [t.name for t in figure.data if t.showlegend is not False]
    assert sorted(shown) == ["a", "b", "c", "control point"]


def test_names_of_classes_are_text():
    """Tags and fields in a class's name are neither drawn as markup nor filled in."""
    labels = np.where(LABELS == "a", "<b>%{x}</b> R&D", LABELS)
    trace = next(t for t in embedding_panels(_panels(), labels=labels).data if "R&" in t.name)
    shown = "&lt;b&gt;%&#123;x}&lt;/b&gt; R&amp;D"
    assert trace.name == shown
    assert trace.hovertemplate == f"{shown}, sample %{{customdata}}<extra></extra>"


def test_ten_classes_can_be_told_apart():
    """Colour and symbol together are different for more classes than there are colours."""
    assert len({class_style(index) for index in range(20)}) == 20


def test_many_points_are_drawn_fast():
    """A table such as Page blocks is drawn by WebGL, a small one as vectors."""
    many = np.random.default_rng(0).random((5473, 2))
    assert {t.type for t in embedding_panels(_panels(many)).data if t.customdata is not None} == {
        "scattergl"
    }
    assert {t.type for t in embedding_panels(_panels()).data} == {"scatter"}


@pytest.mark.parametrize(
    ("panels", "labels"),
    [([], None), (_panels(), LABELS[:5]), ([*_panels(), Panel("3", POINTS[:5], CONTROL)], None)],
    ids=["no panel", "too few labels", "other samples"],
)
def test_what_does_not_fit_is_refused(panels, labels):
    """Panels show the same samples, with one label each."""
    with pytest.raises(WorkbenchError, match="panel"):
        embedding_panels(panels, labels=labels)
