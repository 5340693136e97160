"""Trajectory panels colour frames by time and mark keyframes."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.figures.embeddings import Panel
from workbench.figures.trajectories import TIME_COLORS, trajectory_panels

POINTS = np.random.default_rng(0).random((40, 2))
KEYS = np.array([0, 13, 26, 39])
PANELS = [Panel("PCA", POINTS, KEYS), Panel("t-SNE", 2 * POINTS, KEYS)]


def _named(figure, name, axis="x"):
    return [
        t for t in figure.data if t.name == name and t.customdata is not None and t.xaxis == axis
    ]


def test_time_goes_from_red_over_green_to_blue_and_ever_darker():
    """The hues are the caption's; lightness (CIE L*) falls, for who cannot tell them."""
    rgb = np.array([[int(c[i : i + 2], 16) / 255 for i in (1, 3, 5)] for c in TIME_COLORS])
    assert [rgb[i].argmax() for i in (0, len(rgb) // 2, -1)] == [0, 1, 2]
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    lightness = 116 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16
    assert np.all(np.diff(lightness) < -2)


def test_each_frame_is_drawn_once_at_its_place_and_time():
    """Dots and keyframes together are all frames; colour grows with the frame."""
    figure = trajectory_panels(PANELS)
    for axis, scale in (("x", 1), ("x2", 2)):
        (dots,), (keys,) = (_named(figure, name, axis) for name in ("frame", "keyframe"))
        frames = np.concatenate([dots.customdata, keys.customdata])
        assert sorted(frames) == list(range(40))
        assert np.array_equal(keys.customdata, KEYS)
        drawn = np.concatenate([np.stack([t.x, t.y], axis=1) for t in (dots, keys)])
        assert np.array_equal(drawn, scale * POINTS[frames])
        colors = np.concatenate([dots.marker.color, keys.marker.color])
        assert np.allclose(colors, frames / 39)


def test_keyframes_are_bigger_dots_with_a_border_or_crosses():
    """The marker is that of Figure 6.2 or that of Figures 5.6 to 5.11."""
    (dots,) = _named(trajectory_panels(PANELS), "frame")
    (key,) = _named(trajectory_panels(PANELS), "keyframe")
    (cross,) = _named(trajectory_panels(PANELS, crosses=True), "keyframe")
    assert key.marker.size > 1.5 * dots.marker.size
    assert key.marker.line.width > 1
    assert cross.marker.symbol == "x"


def test_a_jump_breaks_the_line():
    """With a gap of a tenth, two clusters far apart are not joined."""
    points = np.concatenate([0.01 * POINTS, 1 + 0.01 * POINTS])
    panel = [Panel("t-SNE", points, KEYS)]
    joined, broken = (trajectory_panels(panel, gap=gap).data[0] for gap in (None, 0.1))
    assert not np.isnan(joined.x).any()
    assert np.flatnonzero(np.isnan(broken.x)).tolist() == [40]


def test_a_cycle_is_closed():
    """A dotted line leads from the last frame to the first."""
    (line,) = [t for t in trajectory_panels(PANELS[:1], closed=True).data if t.line.dash == "dot"]
    assert np.array_equal(np.stack([line.x, line.y], axis=1), POINTS[[-1, 0]])


def test_the_bar_tells_seconds():
    """With a duration, the colour bar has times; without, start and end."""
    bar = trajectory_panels(PANELS, seconds=6.8).layout.coloraxis.colorbar
    assert bar.ticktext == ("0 s", "3.4 s", "6.8 s")
    assert trajectory_panels(PANELS).layout.coloraxis.colorbar.ticktext == ("start", "", "end")


def test_a_row_that_is_not_full_has_no_empty_frames():
    """Three panels in two columns leave the fourth place blank."""
    layout = trajectory_panels([*PANELS, PANELS[0]]).layout
    assert layout.xaxis4.visible is False
    assert layout.xaxis3.visible is None


@pytest.mark.parametrize(
    ("panels", "settings", "message"),
    [
        ([], {}, "panels"),
        ([Panel("3-D", np.zeros((4, 3)), KEYS[:1])], {}, "three dimensions"),
        ([Panel("short", POINTS[:5], KEYS)], {}, "keyframes"),
        (PANELS, {"gap": 0.0}, "gap"),
        (PANELS, {"seconds": -1.0}, "seconds"),
        (PANELS, {"n_columns": 0}, "n_columns"),
    ],
    ids=["no panel", "space", "keyframe beyond", "no gap", "negative time", "no column"],
)
def test_what_does_not_fit_is_refused(panels, settings, message):
    """The message names the argument."""
    with pytest.raises(WorkbenchError, match=message):
        trajectory_panels(panels, **settings)
