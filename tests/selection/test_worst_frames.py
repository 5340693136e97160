"""Tests of workbench.selection.worst_frames."""

from __future__ import annotations

import numpy as np
import pytest

from tests.selection.conftest import random_motion, still_motion, wave
from workbench.selection.splitting import worst_of
from workbench.selection.track_errors import errors_between
from workbench.selection.tracks import pose_track
from workbench.selection.worst_frames import GROUP, WorstFrames


@pytest.mark.parametrize("interpolator", ["slerp", "linear"])
@pytest.mark.parametrize("smooth", [False, True], ids=["rough", "smooth"])
def test_the_worst_frame_is_that_of_all_errors(smooth, interpolator):
    """Groups that are not looked at never hold the worst frame, wherever the keys are."""
    track = pose_track(wave(700) if smooth else random_motion(700, 6), interpolator, "scs")
    worst = WorstFrames(track)
    rng = np.random.default_rng(0)
    for _ in range(150):
        first = int(rng.integers(0, 690))
        last = int(rng.integers(first + 2, 700))
        error, frame = worst.between(first, last)
        wanted = worst_of(errors_between(track, first, last), first + 1)
        assert frame == wanted[1]
        assert error == pytest.approx(wanted[0], rel=1e-12)


def test_of_equal_errors_the_first_counts_across_groups():
    """Where nothing moves, the frame after the first key is the worst."""
    worst = WorstFrames(pose_track(still_motion(10 * GROUP), "slerp", "scs"))
    assert worst.between(3, 10 * GROUP - 2) == (0.0, 4)
