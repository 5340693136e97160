"""Distances between poses: D_p by joint positions, D_q by joint rotations."""

from __future__ import annotations

import math

import numpy as np
from numba import prange
from numpy.typing import NDArray

from workbench.kernels import compiled, compiled_parallel


@compiled
def _rotation_distance(a, b, weights):  # type: ignore[no-untyped-def]  # compiled
    """Sum the weighted geodesic angles of two poses given as rows of 9 entries per joint."""
    total = 0.0
    for joint in range(weights.shape[0]):
        chord2 = 0.0
        for entry in range(9 * joint, 9 * joint + 9):
            difference = a[entry] - b[entry]
            chord2 += difference * difference
        half_sine = math.sqrt(chord2 / 8.0)
        total += weights[joint] * 2.0 * math.asin(min(half_sine, 1.0))
    return total


@compiled
def _fill_row(poses, weights, i, result):  # type: ignore[no-untyped-def]  # compiled
    for j in range(i):
        result[i, j] = result[j, i] = _rotation_distance(poses[i], poses[j], weights)


@compiled_parallel
def _rotation_distance_matrix(poses, weights, result):  # type: ignore[no-untyped-def]  # compiled
    n = poses.shape[0]
    # Row i is paired with row n-1-i so that every step has the same work.
    for half in prange((n + 1) // 2):
        row = np.int64(half)
        _fill_row(poses, weights, row, result)
        _fill_row(poses, weights, n - 1 - row, result)


@compiled_parallel
def _rotation_distance_pairs(a, b, weights, result):  # type: ignore[no-untyped-def]  # compiled
    for i in prange(a.shape[0]):
        result[i] = _rotation_distance(a[i], b[i], weights)


def rotation_distance_matrix(
    rotations: NDArray[np.float64], weights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Compute D_q between all pairs of poses (Costa 2018, Eq. 3.2).

    D_q(A, B) = Σ_r w_r · arccos((Tr[A_r B_rᵀ] − 1) / 2), the weighted sum of the angles
    between corresponding joint rotations, evaluated as 2·asin(‖A_r − B_r‖_F / (2√2)).

    Parameters
    ----------
    rotations : ndarray of shape (n_poses, n_joints, 3, 3)
        Poses.
    weights : ndarray of shape (n_joints,)
        Joint weights, usually :attr:`Skeleton.path_weights`.

    Returns
    -------
    ndarray of shape (n_poses, n_poses)
        Symmetric, zero on the diagonal; radians times the weights' unit.
    """
    poses = _rows(rotations)
    result = np.zeros((len(poses), len(poses)))
    _rotation_distance_matrix(poses, np.ascontiguousarray(weights), result)
    return result


def rotation_distance_pairs(
    a: NDArray[np.float64], b: NDArray[np.float64], weights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Compute D_q between corresponding poses of two sequences (Costa 2018, Eq. 3.2).

    Parameters
    ----------
    a, b : ndarray of shape (n_pairs, n_joints, 3, 3)
        Poses.
    weights : ndarray of shape (n_joints,)
        Joint weights.

    Returns
    -------
    ndarray of shape (n_pairs,)
    """
    result = np.empty(len(a))
    _rotation_distance_pairs(_rows(a), _rows(b), np.ascontiguousarray(weights), result)
    return result


def position_distance_pairs(
    a: NDArray[np.float64], b: NDArray[np.float64], weights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Compute D_p between corresponding poses of two sequences (Costa 2018, Eq. 3.1).

    D_p(A, B) = Σ_j w_j · ‖P(A_j) − P(B_j)‖².

    Parameters
    ----------
    a, b : ndarray of shape (n_pairs, n_joints, 3)
        Joint positions.
    weights : ndarray of shape (n_joints,)
        Joint weights; uniform where nothing favours a joint.

    Returns
    -------
    ndarray of shape (n_pairs,)
        In squared file units.
    """
    return np.einsum("ijk,ijk,j->i", a - b, a - b, weights)


def position_distance_matrix(
    positions: NDArray[np.float64], weights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Compute D_p between all pairs of poses (Costa 2018, Eq. 3.1).

    A weighted sum of squares is a squared Euclidean distance of scaled coordinates, so no
    temporary of size n_poses² · n_joints is needed.

    Parameters
    ----------
    positions : ndarray of shape (n_poses, n_joints, 3)
        Joint positions, in file units.
    weights : ndarray of shape (n_joints,)
        Joint weights.

    Returns
    -------
    ndarray of shape (n_poses, n_poses)
        In squared file units.
    """
    from scipy.spatial.distance import cdist

    scaled = (positions * np.sqrt(weights)[:, None]).reshape(len(positions), -1)
    return cdist(scaled, scaled, "sqeuclidean")


def _rows(rotations: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.ascontiguousarray(rotations, dtype=np.float64).reshape(len(rotations), -1)
