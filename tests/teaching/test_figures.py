"""Figures of lessons: they show what they are given, on any ground."""

from __future__ import annotations

import numpy as np
import pytest

from workbench import VectorSpace, WorkbenchError
from workbench.quality.shepard_diagram import shepard_diagram
from workbench.teaching.figures import curves, maps_side_by_side, shepard_panels

PLACES = np.random.default_rng(0).random((20, 2))
SPACE = VectorSpace(PLACES * [2.0, 1.0], labels=["a", "b"] * 10)
DIAGRAM = shepard_diagram(SPACE.distances, PLACES)

FIGURES = {
    "maps": lambda: maps_side_by_side(SPACE, {"one": PLACES, "two": SPACE.samples}),
    "curves": lambda: curves({"one": {1: 2.0, 10: 3.0}}, x_title="x", y_title="y"),
    "Shepard diagrams": lambda: shepard_panels({"one": DIAGRAM, "two": DIAGRAM}),
}


def _luminance(color: str) -> float:
    parts = [int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return float(np.dot([0.2126, 0.7152, 0.0722], linear))


@pytest.mark.parametrize("make", FIGURES.values(), ids=FIGURES)
def test_figures_show_on_white_and_on_black(make):
    """They have no ground of their own, and their texts contrast by 4 : 1 with both themes."""
    figure = make()
    assert figure.layout.paper_bgcolor == figure.layout.plot_bgcolor == "rgba(0, 0, 0, 0)"
    texts = {figure.layout.font.color, *(note.font.color for note in figure.layout.annotations)}
    for text in texts:
        for ground in ("#ffffff", "#111111"):
            light, dark = sorted([_luminance(text), _luminance(ground)], reverse=True)
            assert (light + 0.05) / (dark + 0.05) > 4.0


def test_every_pair_is_in_the_shepard_diagram():
    """The heat map holds as many pairs as there are, distance in the data to the right."""
    heat = shepard_panels({"one": DIAGRAM}).data[0]
    assert np.nansum(heat.z) == 20 * 19 / 2
    assert np.array_equal(heat.x, DIAGRAM.data_edges)
    assert heat.z.shape == (len(DIAGRAM.embedding_edges) - 1, len(DIAGRAM.data_edges) - 1)


def test_no_diagram_is_refused():
    """The message says what is wanted."""
    with pytest.raises(WorkbenchError, match="diagrams: got none"):
        shepard_panels({})


@pytest.mark.parametrize("count", [0, 3], ids=["without control points", "with some"])
def test_the_legend_explains_crosses_if_there_are_any(count):
    """Maps without control points do not speak of them."""
    figure = maps_side_by_side(SPACE, {"one": PLACES}, control_points=np.arange(count))
    shown = [trace.name for trace in figure.data if trace.showlegend is not False]
    assert ("control point" in shown) == (count > 0)


def test_curves_are_drawn_on_logarithmic_axes_if_asked_for():
    """Both axes count powers of ten, and no axis is forced to show 0, which has no logarithm."""
    figure = curves({"one": {0.1: 2.0, 10.0: 3.0}}, x_title="x", y_title="y", logarithmic=True)
    assert figure.layout.xaxis.type == figure.layout.yaxis.type == "log"
    assert figure.layout.yaxis.rangemode == "normal"
