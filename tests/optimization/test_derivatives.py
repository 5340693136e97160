"""Tests of errors' derivatives and of the steps made of them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import workbench
from tests.optimization.problems import flat, sheet
from workbench.errors import WorkbenchError
from workbench.mocap.distance_derivatives import rotation_distance_derivatives
from workbench.mocap.distances import rotation_distance_pairs
from workbench.optimization.objective import Objective
from workbench.optimization.trust_region import ErrorModel, trust_region_steps
from workbench.schemes import SpatialScheme


def central_differences(objective, points, indices, step=1e-6):
    """Differentiate an objective numerically: (n_points, n_dimensions)."""
    return np.stack(
        [
            (objective(points + step * axis, indices) - objective(points - step * axis, indices))
            / (2 * step)
            for axis in np.eye(points.shape[1])
        ],
        axis=1,
    )


@pytest.mark.parametrize("dimensions", [2, 3])
def test_gradients_of_tables_equal_differences(dimensions):
    """The gradient of a row's error is what central differences give."""
    problem = sheet(dimensions=dimensions)
    points = problem.start[problem.free]
    errors, gradients, _ = problem.objective().derivatives(points, problem.free)
    assert np.allclose(errors, problem.objective()(points, problem.free), atol=1e-12)
    expected = central_differences(problem.objective(), points, problem.free)
    assert np.allclose(gradients, expected, atol=1e-6)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_gradients_of_poses_equal_differences(dimensions):
    """The gradient of D_q through RBF and nearest rotations is what differences give."""
    clip = workbench.load_space("cmu/01_01-jump")
    result = SpatialScheme("pca", dimensions=dimensions).run(clip, ratio=0.03)
    free = np.setdiff1d(np.arange(len(clip)), result.control_points)[::5]
    objective = Objective.of(clip, result.back_projector)
    points = result.embedding[free]
    errors, gradients, _ = objective.derivatives(points, free)
    assert np.allclose(errors, objective(points, free), atol=1e-12)
    expected = central_differences(objective, points, free)
    assert np.allclose(gradients, expected, atol=1e-5 * np.abs(expected).max())


@given(seed=st.integers(0, 10_000))
@settings(max_examples=30, deadline=None)
def test_second_derivatives_of_turning_joints_are_exact(seed):
    """For joints that turn at constant velocity the curvature is the true second derivative."""
    rng = np.random.default_rng(seed)
    targets = Rotation.random(4, rng).as_matrix()[None]
    poses = Rotation.random(4, rng).as_matrix()[None]
    velocity = rng.normal(size=(4, 3))
    weights = rng.random(4)

    def moved(t):
        return (poses[0] @ Rotation.from_rotvec(t * velocity).as_matrix())[None]

    def distance(t):
        return rotation_distance_pairs(targets, moved(t), weights)[0]

    angle = Rotation.from_matrix(targets[0].swapaxes(1, 2) @ poses[0]).magnitude()
    if angle.max() > 3.0 or angle.min() < 0.1:
        return  # differences across the kinks at 0 and 180 degrees mean nothing
    h = 1e-4
    jacobian = ((moved(h) - moved(-h)) / (2 * h))[..., None]
    _, gradients, curvatures = rotation_distance_derivatives(targets, poses, jacobian, weights)
    assert gradients[0, 0] == pytest.approx((distance(h) - distance(-h)) / (2 * h), abs=1e-5)
    second = (distance(h) - 2 * distance(0.0) + distance(-h)) / h**2
    assert curvatures[0, 0, 0] == pytest.approx(second, abs=1e-4 * max(1.0, abs(second)))


def test_a_reached_pose_has_no_slope():
    """At the target itself, where D_q has a kink, derivatives are 0 and finite."""
    pose = Rotation.random(3, np.random.default_rng(0)).as_matrix()[None]
    jacobian = np.random.default_rng(1).normal(size=(1, 3, 3, 3, 2))
    parts = rotation_distance_derivatives(pose, pose, jacobian, np.ones(3))
    assert all(not part.any() for part in parts)


def test_shapes_that_do_not_fit_are_refused():
    """A compiled loop must not read beyond the end of an array."""
    poses = np.broadcast_to(np.eye(3), (2, 4, 3, 3))
    with pytest.raises(WorkbenchError, match="got shapes"):
        rotation_distance_derivatives(poses, poses, np.zeros((2, 4, 3, 3, 2)), np.ones(3))


@given(seed=st.integers(0, 10_000), dimensions=st.sampled_from([2, 3]))
@settings(max_examples=50, deadline=None)
def test_steps_solve_the_trust_region_problem(seed, dimensions):
    """No random step of allowed length lowers the model more; steps keep to the radius."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(6, dimensions, dimensions)) * rng.random((6, 1, 1))
    root[0] = 0.0  # no curvature at all
    root[1, 1:] = 0.0  # curvature in one direction only
    curvatures = root.swapaxes(1, 2) @ root
    gradients = rng.normal(size=(6, dimensions))
    gradients[2] = 0.0
    radii = 10.0 ** rng.uniform(-3, 1, 6)
    steps = trust_region_steps(gradients, curvatures, radii)
    assert np.all(np.linalg.norm(steps, axis=1) <= radii * (1 + 1e-9))

    def models(at):
        bends = np.einsum("ni,nij,nj->n", at, curvatures, at)
        return np.einsum("ni,ni->n", gradients, at) + 0.5 * bends

    lowest = models(steps)
    for _ in range(50):
        others = rng.normal(size=steps.shape)
        others *= (radii * rng.random(6) / np.linalg.norm(others, axis=1))[:, None]
        assert np.all(models(others) >= lowest - 1e-6 * radii)


def test_the_model_of_a_linear_reconstruction_is_exact():
    """Where the reconstruction is linear, the step goes home and promises the whole error."""
    problem, places = flat()
    points = problem.start[problem.free]
    model = ErrorModel(*problem.objective().derivatives(points, problem.free))
    steps = model.steps(np.full(len(points), 10.0))
    assert np.allclose(points + steps, places[problem.free], atol=1e-9)
    assert np.allclose(model.gains(steps), model.errors, atol=1e-9)
