"""Tests of workbench.projection.rbfp."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import RBFInterpolator

from workbench.errors import AdjustmentWarning, DegenerateDataWarning, WorkbenchError
from workbench.projection.rbfp import KERNELS, RBFP
from workbench.spaces import PoseSpace, VectorSpace

every_kernel = pytest.mark.parametrize("kernel", KERNELS)


def fitted(samples, positions, n_control_points, **parameters):
    """Fit a map to the first samples of a table, silently where ε is raised."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AdjustmentWarning)
        return RBFP(**parameters).fit(
            VectorSpace(samples), np.arange(n_control_points), positions[:n_control_points]
        )


@every_kernel
@pytest.mark.parametrize("n", [150, 300])
def test_control_points_get_their_positions_where_epsilon_1_is_ill_conditioned(kernel, n):
    """Hundreds of random points of the unit square go to random places, each to its own."""
    samples, positions = np.random.default_rng(n).random((2, n, 2))
    projector = fitted(samples, positions, n, kernel=kernel)
    assert np.abs(projector.transform(samples) - positions).max() < 1e-8


def test_raising_epsilon_is_said():
    """The message gives both values; where ε = 1 serves, it stays and nothing is said."""
    samples, positions = np.random.default_rng(0).random((2, 150, 2))
    with pytest.warns(AdjustmentWarning, match="epsilon=1 raised to"):
        raised = RBFP().fit(VectorSpace(samples), np.arange(150), positions)
    assert raised.epsilon_ > 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        kept = RBFP().fit(VectorSpace(100 * samples), np.arange(150), positions)
    assert kept.epsilon_ == 1


@every_kernel
def test_agrees_with_scipys_interpolant(kernel):
    """Where the system is well conditioned, scipy's solution is the same map."""
    rng = np.random.default_rng(1)
    samples, positions = 10 * rng.random((60, 3)), rng.random((60, 2))
    names = {"inverse-multiquadric": "inverse_multiquadric"}
    expected = RBFInterpolator(
        samples[:20], positions[:20], kernel=names.get(kernel, kernel), epsilon=1.0, degree=-1
    )(samples)
    projector = fitted(samples, positions, 20, kernel=kernel)
    assert np.abs(projector.transform(samples) - expected).max() < 1e-9


def test_the_argument_between_poses_is_the_root_of_their_distance(waving):
    """The map of a motion is the sum of √(1 + D_q) with the weights that solve the system."""
    space = PoseSpace(waving)
    control, positions = np.arange(0, 60, 6), np.random.default_rng(0).random((10, 2))
    kernel = np.sqrt(1.0 + space.distances[:, control])
    expected = kernel @ np.linalg.solve(kernel[control], positions)
    projector = RBFP().fit(space, control, positions)
    assert np.abs(projector.transform(space.samples) - expected).max() < 1e-9


@pytest.mark.parametrize("dimensions", [2, 3])
def test_new_poses_are_placed(waving, dimensions):
    """A pose that the space does not hold gets a place between its neighbours."""
    space = PoseSpace(waving[::2])
    control = np.arange(0, 30, 3)
    line = np.outer(control, np.ones(dimensions)) / 30
    placed = RBFP().fit(space, control, line).transform(waving.rotations[1::2])
    assert placed.shape == (30, dimensions)
    # Control points are 0.1 apart.
    assert np.abs(placed[:27] - (np.arange(27) + 0.5)[:, None] / 30).max() < 0.06


def test_equal_control_points_get_their_mean():
    """One sample with two positions lies between them, and that is said."""
    samples = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 0.0], [0.0, 4.0]])
    positions = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]])
    with pytest.warns(DegenerateDataWarning, match="1 control points equal others"):
        projector = RBFP().fit(VectorSpace(samples), np.arange(4), positions)
    wanted = [[0, 0], [1.5, 0], [1.5, 0], [0, 1]]
    assert np.allclose(projector.transform(samples), wanted, atol=1e-9)


def test_equal_control_points_with_one_position_are_no_news():
    """Nothing is undetermined there, so nothing is said."""
    samples = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 0.0], [0.0, 4.0]])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        RBFP().fit(VectorSpace(samples), np.arange(4), samples)


def test_control_points_too_close_to_tell_apart_are_said():
    """Nearly equal samples with opposite positions cannot all be hit by a smooth map."""
    samples = np.array([[0.0, 0.0], [1e-11, 0.0], [1.0, 0.0], [0.0, 1.0]])
    positions = np.array([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]])
    with pytest.warns(DegenerateDataWarning, match="too close to each other"):
        RBFP("linear").fit(VectorSpace(samples), np.arange(4), positions)


@every_kernel
def test_smoothing_trades_exactness_for_small_weights(kernel):
    """More smoothing, smaller weights and larger misses."""
    samples, positions = np.random.default_rng(2).random((2, 40, 2))
    maps = [fitted(samples, positions, 40, kernel=kernel, smoothing=s) for s in (0.01, 0.1, 1.0)]
    sizes = [np.linalg.norm(m.weights_) for m in maps]
    misses = [np.linalg.norm(m.transform(samples) - positions) for m in maps]
    assert sizes == sorted(sizes, reverse=True)
    assert misses == sorted(misses)
    assert misses[0] > 1e-6


@settings(max_examples=25, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.integers(3, 30),
    st.integers(1, 6),
    st.sampled_from([2, 3]),
    st.floats(1e-3, 1e3),
)
def test_positions_are_kept_at_any_scale(seed, n, n_features, dimensions, scale):
    """Random tables of any unit: control points get their positions to 1e-8 of the extent."""
    rng = np.random.default_rng(seed)
    samples = scale * rng.normal(size=(n, n_features))
    positions = rng.random((n, dimensions))
    projector = fitted(samples, positions, n)
    assert np.abs(projector.transform(samples) - positions).max() < 1e-7


def test_blocks_do_not_show(monkeypatch):
    """Many blocks give what one block gives."""
    rng = np.random.default_rng(0)
    samples, positions = 10 * rng.random((100, 3)), rng.random((100, 2))
    projector = fitted(samples, positions, 20)
    whole = projector.transform(samples)
    monkeypatch.setattr("workbench.projection.control_points._BLOCK_ENTRIES", 7 * 20)
    assert np.allclose(projector.transform(samples), whole, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"kernel": "cosine"}, "kernel: got 'cosine', want one of multiquadric"),
        ({"epsilon": 0.0}, "epsilon: got 0.0, want a number above 0"),
        ({"epsilon": np.nan}, "epsilon: got nan"),
        ({"smoothing": -1.0}, "smoothing: got -1.0, want a number from 0"),
    ],
    ids=["kernel", "epsilon zero", "epsilon nan", "smoothing"],
)
def test_unusable_parameters_are_refused(parameters, message):
    """The message names the parameter, its value and what is wanted."""
    with pytest.raises(WorkbenchError, match=message):
        RBFP(**parameters)
