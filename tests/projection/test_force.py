"""Tests of workbench.projection.force."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.distance import pdist, squareform

from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.projection.force import Force


def misfit(distances, embedding):
    """Compute the stress of an embedding at its best scale."""
    wanted, have = squareform(distances, checks=False), pdist(embedding)
    scale = (wanted @ have) / (have @ have)
    return np.sqrt(((wanted - scale * have) ** 2).sum() / (wanted**2).sum())


@pytest.mark.parametrize("dimensions", [2, 3])
def test_agrees_with_a_plain_loop_over_pairs(dimensions):
    """Each pair in turn moves its second point by (δ − length) / α along the unit vector."""
    rng = np.random.default_rng(3)
    samples = rng.normal(size=(25, 6))
    expected = np.random.RandomState(4).standard_normal((dimensions, 25)).T
    distances = squareform(pdist(samples))
    wanted = distances / distances.max()
    for _ in range(7):
        for i in range(25):
            for j in range(25):
                if i != j:
                    step = expected[j] - expected[i]
                    length = np.linalg.norm(step)
                    expected[j] += (wanted[i, j] - length) / 8 * step / length
    projector = Force(dimensions, n_iterations=7, order="given", random_state=4)
    embedding = projector.fit_transform(samples)
    assert np.abs(embedding - expected * distances.max()).max() < 1e-9


@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_flat_data_set_keeps_its_distances(dimensions):
    """Points of a plane in 10-D nearly find their places; the step's size leaves a rest."""
    rng = np.random.default_rng(0)
    plane = rng.normal(size=(100, dimensions))
    basis = np.linalg.qr(rng.normal(size=(10, dimensions)))[0]
    embedding = Force(dimensions, random_state=0).fit_transform(plane @ basis.T)
    assert np.allclose(pdist(embedding), pdist(plane), rtol=0, atol=0.02 * pdist(plane).max())


def test_a_random_order_fits_better_than_that_of_a_motion():
    """On a jump, samples in the order of time leave more than twice the stress."""
    clip = load_space("cmu/01_01-jump")
    stress = {
        order: misfit(
            clip.distances,
            Force(order=order, metric="precomputed", random_state=0).fit_transform(clip.distances),
        )
        for order in ("random", "given")
    }
    assert stress["random"] < 0.1
    assert stress["given"] > 2 * stress["random"]


def test_equal_samples_come_close():
    """A distance of zero pulls points together and breaks nothing."""
    samples = np.repeat(np.random.default_rng(0).normal(size=(10, 4)), 3, axis=0)
    embedding = Force(random_state=0).fit_transform(samples)
    apart = squareform(pdist(embedding)).reshape(10, 3, 10, 3)
    groups = np.arange(10)
    assert apart[groups, :, groups].max() < 0.05 * apart.max()


def test_distances_are_not_changed():
    """A matrix that the caller goes on using stays as it is."""
    distances = squareform(pdist(np.random.default_rng(0).normal(size=(30, 4))))
    before = distances.copy()
    Force(metric="precomputed", random_state=0).fit_transform(distances)
    assert np.array_equal(distances, before)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"order": "time"}, "order: got 'time', want 'random' or 'given'"),
        ({"n_iterations": 0}, "n_iterations: got 0, want at least 1"),
        ({"step": 0.5}, "step: got 0.5, want a number from 1"),
    ],
    ids=["order", "iterations", "step"],
)
def test_unusable_parameters_are_refused(parameters, message):
    """The message names the parameter, its value and what is wanted."""
    with pytest.raises(WorkbenchError, match=message):
        Force(**parameters).fit_transform(np.random.default_rng(0).normal(size=(9, 3)))
