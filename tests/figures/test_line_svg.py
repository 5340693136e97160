"""Line drawings as SVG files."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np
import plotly.graph_objects as go
import pytest

from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.figures.filmstrips import filmstrip
from workbench.figures.line_svg import line_svg

_SVG = "{http://www.w3.org/2000/svg}"


def drawing() -> go.Figure:
    """Draw a line with a gap and a filled square, on a range of 10 by 5."""
    square = {"x": [0, 1, 1, 0, 0], "y": [0, 0, 1, 1, 0], "fill": "toself", "fillcolor": "red"}
    figure = go.Figure(
        [
            go.Scatter(
                x=[0, 10, None, 0, 5], y=[0, 5, None, 5, 0], line={"color": "black", "width": 2}
            ),
            go.Scatter(**square, line={"color": "blue", "width": 1}),
        ],
        layout={"height": 50, "xaxis": {"range": [0, 10]}, "yaxis": {"range": [0, 5]}},
    )
    figure.add_annotation(x=5, y=2.5, text="<b>a</b><br><span style='color:red'>b</span>")
    return figure


def test_places_are_those_of_the_axes() -> None:
    """Corners of the ranges are corners of the picture, and gaps stay gaps."""
    root = ET.fromstring(line_svg(drawing(), title="t", description="d", width=100))
    line, square = root.iter(f"{_SVG}path")
    assert line.get("d") == "M0.0 50.0L100.0 0.0M0.0 0.0L50.0 50.0"
    assert (line.get("fill"), square.get("fill")) == ("none", "red")


def test_one_scale_on_both_axes() -> None:
    """A picture that is wider than the drawing has space at both sides."""
    root = ET.fromstring(line_svg(drawing(), title="t", description="d", width=300))
    assert next(root.iter(f"{_SVG}path")).get("d").startswith("M100.0 50.0L200.0 0.0")


def test_words_are_written_below_their_place_without_tags() -> None:
    """Each line of an annotation is a text of its own."""
    root = ET.fromstring(line_svg(drawing(), title="a < b", description="d", width=100))
    words = list(root.iter(f"{_SVG}text"))
    assert [text.text for text in words] == ["a", "b"]
    assert [float(text.get("x")) for text in words] == [50.0, 50.0]
    assert 25 < float(words[0].get("y")) < float(words[1].get("y"))
    assert root.find(f"{_SVG}title").text == "a < b"


def test_a_filmstrip_has_a_head_and_a_label_for_each_pose() -> None:
    """The file holds all poses within the picture."""
    frames = [0, 100, 200, 299]
    motion = load_space("cmu/01_01-jump").motion
    root = ET.fromstring(
        line_svg(filmstrip(motion, frames), title="jump", description="four poses")
    )
    texts = [text.text for text in root.iter(f"{_SVG}text")]
    assert texts[::2] == [str(frame) for frame in frames]
    width, height = float(root.get("width")), float(root.get("height"))
    numbers = [
        float(number)
        for path in root.iter(f"{_SVG}path")
        for number in path.get("d").replace("M", " ").replace("L", " ").split()
    ]
    x, y = np.array(numbers).reshape(-1, 2).T
    assert 0 <= x.min() < x.max() <= width
    assert 0 <= y.min() < y.max() <= height


def test_a_figure_without_ranges_is_refused() -> None:
    """A plot with axes is no line drawing."""
    with pytest.raises(WorkbenchError, match="without a height or a range"):
        line_svg(go.Figure(), title="t", description="d")
