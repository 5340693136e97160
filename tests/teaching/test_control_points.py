"""What lesson 3 measures of maps around control points."""

from __future__ import annotations

import numpy as np
import pytest

from workbench import VectorSpace
from workbench.teaching.control_points import departure, mean_departures, placed_around

RANDOM = np.random.default_rng(0)
SPACE = VectorSpace(RANDOM.normal(size=(30, 4)))
PLACES = RANDOM.random((30, 2))


@pytest.mark.parametrize("placing", ["rbfp", "lamp"])
def test_control_points_keep_their_places(placing):
    """Both methods interpolate, so a map around all of its samples is that map."""
    chosen = np.array([0, 5, 9, 20])
    placed = placed_around(SPACE, PLACES, placing, chosen)
    assert np.allclose(placed[chosen], PLACES[chosen])
    assert departure(placed_around(SPACE, PLACES, placing, np.arange(30)), PLACES) < 1e-9


def test_departures_are_means_over_seeds():
    """Two repetitions give the mean of what each seed gives alone."""
    both = mean_departures(SPACE, PLACES, "lamp", "random", [5], repetitions=2, random_state=3)
    alone = [
        mean_departures(SPACE, PLACES, "lamp", "random", [5], repetitions=1, random_state=seed)[5]
        for seed in (3, 4)
    ]
    assert both[5] == pytest.approx(np.mean(alone))
