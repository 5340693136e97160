"""How much control points count for samples that RBFP places."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from workbench.errors import AdjustmentWarning, WorkbenchError
from workbench.projection.rbfp import KERNELS, RBFP
from workbench.spaces import PoseSpace, VectorSpace


@pytest.mark.parametrize("kernel", KERNELS)
def test_influence_places_samples_as_the_fitted_map_does(kernel):
    """With the same ε, both give the same places, wherever control points are."""
    rng = np.random.default_rng(4)
    space, control = VectorSpace(rng.normal(size=(80, 5))), np.arange(0, 80, 7)
    projector = RBFP(kernel)
    influence = projector.influence(space, control)
    for positions in rng.normal(size=(3, len(control), 2)):
        placed = RBFP(kernel, epsilon=projector.epsilon_).fit(space, control, positions)
        expected = placed.transform(space.samples)
        np.testing.assert_allclose(influence @ positions, expected, atol=1e-6)


def test_influence_agrees_with_the_default_map_of_poses(waving):
    """Where ε = 1 serves, nothing has to be said about it."""
    space, control = PoseSpace(waving), np.arange(0, 60, 6)
    positions = np.random.default_rng(0).random((10, 2))
    expected = RBFP().fit(space, control, positions).transform(space.samples)
    np.testing.assert_allclose(RBFP().influence(space, control) @ positions, expected, atol=1e-6)


def test_control_points_stay_where_they_are_put():
    """Hundreds of close control points, and one that equals another, have unit vectors."""
    samples = np.random.default_rng(5).random((300, 2))
    samples[1] = samples[0]
    control = np.arange(150)
    with warnings.catch_warnings():
        warnings.simplefilter("error", AdjustmentWarning)
        influence = RBFP().influence(VectorSpace(samples), control)
    np.testing.assert_array_equal(influence[control], np.eye(150))
    # A sample beside a control point follows it and hardly any other.
    beside = VectorSpace(np.vstack([samples, samples[7] + 1e-6]))
    assert RBFP().influence(beside, control)[-1, 7] == pytest.approx(1, abs=1e-3)


def test_wrong_indices_are_refused():
    """The message is that of all control points."""
    with pytest.raises(WorkbenchError, match="control points: got 0…9, want indices from 0 to 4"):
        RBFP().influence(VectorSpace(np.eye(5)), [0, 9])
