"""Tests of workbench.projection.lamp."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.errors import DegenerateDataWarning
from workbench.projection.lamp import LAMP
from workbench.spaces import PoseSpace, VectorSpace


def naive(space, samples, control, positions):
    """Place samples one by one as the formula says, with numpy's decomposition."""
    features = space.features[control]
    apart = np.linalg.norm(features[:, None] - features, axis=2)
    wanted = np.linalg.norm(positions[:, None] - positions, axis=2)
    scale = (apart * wanted).sum() / (apart**2).sum()
    rows = samples.reshape(len(samples), -1)
    distances = space.cross_distances(samples, space.samples[control])
    placed = []
    for x, d in zip(rows, distances, strict=True):
        alpha = 1 / d**2
        mean_x, mean_y = (alpha @ values / alpha.sum() for values in (features, positions))
        cross = (features - mean_x).T @ (alpha[:, None] * (positions - mean_y))
        u, _, vt = np.linalg.svd(cross, full_matrices=False)
        placed.append(mean_y + scale * (x - mean_x) @ u @ vt)
    return np.array(placed)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_vectors_are_placed_as_the_formula_says(dimensions):
    """The compiled loop agrees with a plain one, in the plane and in space."""
    rng = np.random.default_rng(0)
    space = VectorSpace(rng.normal(size=(80, 7)))
    control, positions = np.arange(0, 80, 4), rng.normal(size=(20, dimensions))
    others = np.setdiff1d(np.arange(80), control)
    placed = LAMP().fit(space, control, positions).transform(space.samples[others])
    assert np.abs(placed - naive(space, space.samples[others], control, positions)).max() < 1e-9


def test_poses_are_placed_as_the_formula_says(waving):
    """Weights come from D_q, the map acts on matrix entries."""
    space = PoseSpace(waving)
    control, positions = np.arange(0, 60, 5), np.random.default_rng(0).random((12, 2))
    others = np.setdiff1d(np.arange(60), control)
    placed = LAMP().fit(space, control, positions).transform(space.samples[others])
    assert np.abs(placed - naive(space, space.samples[others], control, positions)).max() < 1e-9


@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_flat_data_set_is_recovered_exactly(dimensions):
    """Points of a plane in 10-D, drawn at another scale, all get their places."""
    rng = np.random.default_rng(0)
    plane = rng.normal(size=(200, dimensions))
    basis = np.linalg.qr(rng.normal(size=(10, dimensions)))[0]
    space = VectorSpace(plane @ basis.T + 5.0)
    positions = 0.3 * plane - 2.0
    projector = LAMP().fit(space, np.arange(8), positions[:8])
    assert projector.scale_ == pytest.approx(0.3)
    assert np.abs(projector.transform(space.samples) - positions).max() < 1e-9


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(3, 25), st.integers(1, 8), st.sampled_from([2, 3]))
def test_control_points_keep_their_positions(seed, n, n_features, dimensions):
    """Exactly at a control point, and within the gap a hair beside it, on any table."""
    rng = np.random.default_rng(seed)
    samples, positions = rng.normal(size=(n, n_features)), rng.normal(size=(n, dimensions))
    projector = LAMP().fit(VectorSpace(samples), np.arange(n), positions)
    assert np.array_equal(projector.transform(samples), positions)
    beside = projector.transform(samples + 1e-9)
    assert np.abs(beside - positions).max() < 1e-6


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0.01, 100), st.floats(-3, 3), st.floats(-50, 50))
def test_the_map_moves_with_its_control_points(seed, scale, angle, shift):
    """Scaled, turned and shifted positions scale, turn and shift all places."""
    rng = np.random.default_rng(seed)
    space, positions = VectorSpace(rng.normal(size=(40, 5))), rng.normal(size=(9, 2))
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    moved = [
        LAMP().fit(space, np.arange(9), p).transform(space.samples)
        for p in (positions, scale * positions @ turn + shift)
    ]
    assert np.allclose(moved[1], scale * moved[0] @ turn + shift, rtol=0, atol=1e-9 * (1 + scale))


def test_collinear_positions_stay_on_their_line():
    """What the control points leave undetermined moves nothing."""
    samples = np.random.default_rng(0).normal(size=(50, 4))
    line = np.stack([np.arange(6.0), 2 * np.arange(6.0)], axis=1)
    placed = LAMP().fit(VectorSpace(samples), np.arange(6), line).transform(samples)
    assert np.abs(placed[:, 1] - 2 * placed[:, 0]).max() < 1e-9


def test_equal_control_points_get_their_mean():
    """One sample with two positions lies between them, and that is said."""
    samples = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 0.0], [0.0, 4.0]])
    positions = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]])
    with pytest.warns(DegenerateDataWarning, match="1 control points equal others"):
        projector = LAMP().fit(VectorSpace(samples), np.arange(4), positions)
    assert np.array_equal(projector.transform(samples)[1:3], [[1.5, 0], [1.5, 0]])
