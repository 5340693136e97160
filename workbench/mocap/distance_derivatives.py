"""How D_q changes with one of its poses: first and second derivatives."""

from __future__ import annotations

import math

import numpy as np
from numba import prange
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.kernels import compiled, compiled_parallel

#: Angles below which a joint counts as reached: its distance has a kink there.
_REACHED = 1e-9


@compiled
def _axis(a, b, axis):  # type: ignore[no-untyped-def]  # compiled
    """Write the vector of the antisymmetric part of aᵀb, twice; return its length."""
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        value = 0.0
        for row in range(3):
            value += a[row, k] * b[row, j] - a[row, j] * b[row, k]
        axis[i] = value
    return math.sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2])


@compiled
def _pose_derivatives(  # type: ignore[no-untyped-def]  # compiled
    target, pose, changes, weights, gradient, curvature
):
    """Add up one pose's distance and its derivatives along each direction."""
    n_directions = changes.shape[0]
    total = 0.0
    axis = np.empty(3)
    turns = np.empty((n_directions, 3))
    slopes = np.empty(n_directions)
    for joint in range(weights.shape[0]):
        chord2 = 0.0
        for i in range(3):
            for j in range(3):
                difference = target[joint, i, j] - pose[joint, i, j]
                chord2 += difference * difference
        half_sine2 = min(chord2 / 8.0, 1.0)
        angle = 2.0 * math.asin(math.sqrt(half_sine2))
        total += weights[joint] * angle
        length = _axis(target[joint], pose[joint], axis)
        if angle < _REACHED or length < _REACHED:
            continue
        # The second derivative of a distance on the group of rotations, across the axis:
        # ½ cot(angle / 2), by the sine of that half.
        bend = 0.5 * weights[joint] * math.sqrt((1.0 - half_sine2) / half_sine2)
        for d in range(n_directions):
            # pose' = pose · [turn]×; the antisymmetric part is read twice, hence the half.
            _axis(pose[joint], changes[d, joint], turns[d])
            slopes[d] = 0.0
            for i in range(3):
                turns[d, i] *= 0.5
                slopes[d] += turns[d, i] * axis[i] / length
            gradient[d] += weights[joint] * slopes[d]
        for d in range(n_directions):
            for e in range(d + 1):
                product = -slopes[d] * slopes[e]
                for i in range(3):
                    product += turns[d, i] * turns[e, i]
                curvature[d, e] += bend * product
                if d != e:
                    curvature[e, d] += bend * product
    return total


@compiled_parallel
def _all_derivatives(  # type: ignore[no-untyped-def]  # compiled
    targets, poses, changes, weights, distances, gradients, curvatures
):
    for i in prange(poses.shape[0]):
        distances[i] = _pose_derivatives(
            targets[i], poses[i], changes[i], weights, gradients[i], curvatures[i]
        )


def rotation_distance_derivatives(
    targets: NDArray[np.float64],
    poses: NDArray[np.float64],
    jacobians: NDArray[np.float64],
    weights: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Compute D_q between corresponding poses and its derivatives by what moves the second.

    With θ_j the angle between the joints' rotations, u_j its axis and ω_jd the angular
    velocity along direction d, ∂D_q/∂d = Σ_j w_j · u_j·ω_jd. The curvature
    Σ_j w_j · ½ cot(θ_j / 2) · (ω_jd·ω_je − (u_j·ω_jd)(u_j·ω_je)) is the second derivative
    for rotations that turn at constant velocity: it leaves out how the velocities change,
    as Gauss and Newton's method does. A joint that is reached (θ_j = 0, where D_q has a kink)
    or half a turn away adds nothing to either.

    Parameters
    ----------
    targets, poses : ndarray of shape (n_pairs, n_joints, 3, 3)
        Poses; the second ones move.
    jacobians : ndarray of shape (n_pairs, n_joints, 3, 3, n_directions)
        Derivatives of the second ones' matrices.
    weights : ndarray of shape (n_joints,)
        Joint weights.

    Returns
    -------
    distances : ndarray of shape (n_pairs,)
    gradients : ndarray of shape (n_pairs, n_directions)
    curvatures : ndarray of shape (n_pairs, n_directions, n_directions)
        Positive semidefinite.

    Raises
    ------
    WorkbenchError
        If the shapes do not fit each other.
    """
    if (
        targets.ndim != 4
        or targets.shape != poses.shape
        or targets.shape[1:] != (len(weights), 3, 3)
        or jacobians.shape[:-1] != poses.shape
    ):
        raise WorkbenchError(
            f"targets, poses, jacobians and weights: got shapes {targets.shape}, {poses.shape}, "
            f"{jacobians.shape} and {np.shape(weights)}, want (n_pairs, n_joints, 3, 3) twice, "
            "(n_pairs, n_joints, 3, 3, n_directions) and (n_joints,)"
        )
    n_pairs, n_directions = len(poses), jacobians.shape[-1]
    distances = np.empty(n_pairs)
    gradients = np.zeros((n_pairs, n_directions))
    curvatures = np.zeros((n_pairs, n_directions, n_directions))
    _all_derivatives(
        np.ascontiguousarray(targets),
        np.ascontiguousarray(poses),
        np.ascontiguousarray(np.moveaxis(jacobians, -1, 1)),
        np.ascontiguousarray(weights, dtype=np.float64),
        distances,
        gradients,
        curvatures,
    )
    return distances, gradients, curvatures
