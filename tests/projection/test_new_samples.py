"""Places of new samples on an existing map."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.projection import fit_projection
from workbench.projection.new_samples import Neighborhood, placed_by_projector
from workbench.spaces import PoseSpace, VectorSpace


@pytest.fixture
def known() -> VectorSpace:
    """Give 40 rows in 3-D."""
    return VectorSpace(np.random.default_rng(0).random((40, 3)))


def test_weights_are_inverse_distances():
    """Between samples at distances 1 and 3, three times as near to the first."""
    line = VectorSpace([[0.0], [4.0], [100.0], [104.0], [108.0]])
    neighborhood = Neighborhood(line, VectorSpace([[1.0], [4.0], [104.0]]))
    places = np.array([[0.0, 1.0], [1.0, 0.0], [5.0, 5.0], [6.0, 6.0], [7.0, 7.0]])
    weights = 1 / np.abs(np.array([1.0, 3.0, 99.0, 103.0, 107.0]))
    found = neighborhood.mean_positions(places)
    assert found[0] == pytest.approx(weights @ places / weights.sum())
    assert np.array_equal(found[1:], places[[1, 3]])
    assert neighborhood.nearest.tolist() == [0, 1, 3]


def test_positions_are_unexplained_as_far_as_they_are_noise(known):
    """Shuffled positions cannot be told from neighbours; a flat sheet's can."""
    neighborhood = Neighborhood(known, known)
    every = np.arange(40)
    flat = known.samples[:, :2]
    shuffled = np.random.default_rng(1).permutation(flat)
    assert neighborhood.unexplained(flat, every) < 0.6
    assert neighborhood.unexplained(shuffled, every) > 0.9
    assert neighborhood.unexplained(np.ones((40, 2)), every) == 0.0


def test_unexplained_leaves_each_sample_out(known):
    """The same as placing every sample by a neighbourhood of the others."""
    places = known.samples[:, :2] ** 2
    rows = np.arange(3, 20)
    guessed = np.array(
        [
            Neighborhood(
                known.subset(np.delete(np.arange(40), row)),
                VectorSpace(np.repeat(known.samples[[row]], 3, axis=0)),
            ).mean_positions(np.delete(places, row, axis=0))[0]
            for row in rows
        ]
    )
    spread = ((places[rows] - places[rows].mean(axis=0)) ** 2).sum()
    missed = ((places[rows] - guessed) ** 2).sum()
    assert Neighborhood(known, known).unexplained(places, rows) == pytest.approx(
        np.sqrt(missed / spread)
    )


@pytest.mark.parametrize("projector", ["pca", "isomap"])
def test_own_maps_put_known_samples_where_they_are(waving, known, projector):
    """For vectors and for poses, whose distances are measured to the samples of the map."""
    for space in (known, PoseSpace(waving)):
        projection = fit_projection(space, projector)
        points = placed_by_projector(projection, space, space)
        assert points == pytest.approx(projection.embedding, abs=1e-6)


def test_a_projector_without_a_map_places_nothing(known):
    """MDS knows the samples that it was given, and no others."""
    assert placed_by_projector(fit_projection(known, "mds"), known, known) is None
