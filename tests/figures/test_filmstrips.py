"""Filmstrips show each pose once, in order, above its frame number."""

from __future__ import annotations

import re

import numpy as np
import pytest

from workbench import load_space
from workbench.errors import WorkbenchError
from workbench.figures.filmstrips import filmstrip

JUMP = load_space("cmu/01_01-jump").motion
FRAMES = np.linspace(0, 299, 12).astype(int)


def _numbers(figure):
    return [int(re.search(r"(\d+)</b>", note.text)[1]) for note in figure.layout.annotations]


@pytest.mark.parametrize("travelling", [False, True], ids=["in place", "travelling"])
def test_poses_stand_in_order_above_their_numbers(travelling):
    """Twelve poses make two rows of six, from left to right."""
    figure = filmstrip(JUMP, FRAMES, travelling=travelling)
    assert _numbers(figure) == FRAMES.tolist()
    x = np.array([note.x for note in figure.layout.annotations]).reshape(2, 6)
    y = np.array([note.y for note in figure.layout.annotations]).reshape(2, 6)
    assert np.all(np.diff(x, axis=1) > 0)
    assert np.all(y == y[:, :1])
    assert y[1, 0] < y[0, 0]


def test_poses_in_place_are_equally_far_apart():
    """All poses of a row have the same room."""
    figure = filmstrip(JUMP, FRAMES, n_columns=12)
    steps = np.diff([note.x for note in figure.layout.annotations])
    assert np.allclose(steps, steps[0])


def test_travelling_poses_show_the_way_between_them():
    """The jump itself is wider than the standing before it."""
    figure = filmstrip(JUMP, [0, 10, 120, 230], travelling=True, n_columns=4)
    steps = np.diff([note.x for note in figure.layout.annotations])
    root = JUMP.root_translation[[0, 10, 120, 230]][:, [0, 2]]
    way = np.linalg.norm(root[3] - root[2])
    assert steps[2] > steps[0]
    assert steps[2] >= 0.9 * way


def test_letters_name_the_panels():
    """Poses can be called as in a figure with parts."""
    texts = [note.text for note in filmstrip(JUMP, FRAMES, letters=True).layout.annotations]
    assert texts[0].startswith("<b>(a) 0</b>")
    assert texts[-1].startswith("<b>(l) 299</b>")


def test_times_are_those_of_the_clip():
    """Frame 299 at 120 Hz is at 2.49 s."""
    assert "2.49 s" in filmstrip(JUMP, [299]).layout.annotations[0].text


@pytest.mark.parametrize(
    ("settings", "message"),
    [({"n_columns": 0}, "n_columns"), ({"letters": True, "frames": range(30)}, "letters")],
    ids=["no column", "too many letters"],
)
def test_what_cannot_be_laid_out_is_refused(settings, message):
    """The message names the argument."""
    frames = list(settings.pop("frames", [0, 1]))
    with pytest.raises(WorkbenchError, match=message):
        filmstrip(JUMP, frames, **settings)
