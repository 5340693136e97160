"""Tests of workbench.selection.chord."""

from __future__ import annotations

import os
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings

from tests.selection.conftest import selections, still_motion
from workbench.errors import WorkbenchError
from workbench.mocap import motion_to_euler, read_amc
from workbench.mocap.rotations import unwrap_degrees
from workbench.selection.chord import ChordSimplification, chord_keyframes
from workbench.selection.pb import decimated_keyframes
from workbench.spaces import VectorSpace


def naive(curves, count, fixed, relative):
    """Measure all frames of all segments for every key, by the area of a parallelogram."""
    keys = {0, len(curves) - 1, *fixed}
    while len(keys) < count:
        best = (-1.0, -1)
        stops = sorted(keys)
        for first, last in pairwise(stops):
            chord = curves[last] - curves[first]
            for frame in range(first + 1, last):
                x = curves[frame] - curves[first]
                area2 = (x @ x) * (chord @ chord) - (x @ chord) ** 2
                distance = np.sqrt(max(area2, 0.0) / (chord @ chord))
                measure = distance / np.linalg.norm(chord) if relative else distance
                if measure > best[0]:
                    best = (measure, frame)
        keys.add(best[1])
    return sorted(keys)


@settings(deadline=None, max_examples=25)
@given(drawn=selections())
def test_selection_splits_at_the_farthest_frame(drawn):
    """Keys are those of a plain implementation in the space of unwrapped Euler angles."""
    space, count, fixed = drawn
    curves = motion_to_euler(space.motion, unwrap=True)
    for measure in ("relative", "distance"):
        found = ChordSimplification(measure).select(space, count, fixed=fixed)
        assert found.tolist() == naive(curves, count, fixed, measure == "relative")


def test_time_is_ignored_unless_it_has_a_weight():
    """Speed along a straight line makes no key; as a coordinate it does."""
    path = np.concatenate([np.linspace(0, 1, 10), np.linspace(1, 9, 20)[1:]])
    bump = 0.01 * np.sin(np.linspace(0, np.pi, 29))
    curves = np.column_stack([path, bump])
    assert chord_keyframes(curves, 3, measure="distance")[1] != 9
    assert chord_keyframes(curves, 3, measure="distance", time_weight=0.5)[1] == 9


def test_a_closed_curve_is_split_at_its_far_side():
    """Where both ends are the same pose, the distance is that from the pose."""
    turn = np.linspace(0, 2 * np.pi, 41)
    curves = np.column_stack([np.cos(turn), np.sin(turn)])
    curves[-1] = curves[0]
    assert chord_keyframes(curves, 3).tolist() == [0, 20, 40]


def test_equal_distances_are_settled_by_the_earlier_frame():
    """A still motion gives the first frames and the last."""
    assert ChordSimplification().select(still_motion(9), 5).tolist() == [0, 1, 2, 3, 8]


@pytest.mark.parametrize(
    ("select", "decibels"),
    [
        (lambda x: chord_keyframes(x, 131), 39.4),
        (lambda x: chord_keyframes(x, 131, measure="distance"), 45.3),
        (lambda x: decimated_keyframes(x, 131), 46.1),
    ],
    ids=["relative", "distance", "decimation"],
)
def test_stretching_comes_near_the_published_values(select, decibels):
    """On CMU 13_29 with 131 keys: published 40.20 dB, and 46.42 dB for decimation."""
    folders = [Path(p) for p in os.environ.get("WORKBENCH_DATA", "").split(os.pathsep) if p]
    found = [f / "mocap/asf_amc/13_29.amc" for f in folders]
    files = [path for path in found if path.is_file()]
    if not files:
        pytest.skip("needs mocap/asf_amc/13_29.amc in a folder named by WORKBENCH_DATA")
    angles = unwrap_degrees(read_amc(files[0]).degrees)
    keys, frames = select(angles), np.arange(len(angles))
    rebuilt = np.column_stack([np.interp(frames, keys, curve[keys]) for curve in angles.T])
    mean_square = np.mean((rebuilt - angles) ** 2)
    assert 20 * np.log10(360 / np.sqrt(mean_square)) == pytest.approx(decibels, abs=0.1)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"measure": "area"}, "measure: got 'area'"),
        ({"time_weight": -1}, "time_weight: got -1"),
        ({"time_weight": np.nan}, "time_weight: got nan"),
    ],
    ids=["measure", "negative", "nan"],
)
def test_bad_options_are_refused(options, message):
    """The message names the option."""
    with pytest.raises(WorkbenchError, match=message):
        ChordSimplification(**options)
    with pytest.raises(WorkbenchError, match=message):
        chord_keyframes(np.eye(4), 3, **options)


def test_what_cannot_be_is_refused(wandering):
    """No room for the ends, or a table: each is said."""
    with pytest.raises(WorkbenchError, match="count: got 2 keyframes, want at least 3"):
        ChordSimplification().select(wandering, 2, fixed=[4])
    with pytest.raises(WorkbenchError, match="got the table"):
        ChordSimplification().select(VectorSpace(np.eye(5)), 3)
