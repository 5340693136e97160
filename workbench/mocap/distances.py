"""Distances between poses: D_p by joint positions, D_q by joint rotations."""

from __future__ import annotations

import math

import numpy as np
from numba import prange
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
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
def _rotation_distance_table(a, b, weights, result):  # type: ignore[no-untyped-def]  # compiled
    for i in prange(a.shape[0]):
        for j in range(b.shape[0]):
            result[i, j] = _rotation_distance(a[i], b[j], weights)


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

    Raises
    ------
    WorkbenchError
        If the shapes are others or do not fit each other.
    """
    poses, weights = _fitting("rotations", rotations, weights, (3, 3))
    result = np.zeros((len(poses), len(poses)))
    _rotation_distance_matrix(_rows(poses), weights, result)
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

    Raises
    ------
    WorkbenchError
        If the shapes are others or do not fit each other.
    """
    a, b, weights = _fitting_pairs(a, b, weights, (3, 3))
    result = np.empty(len(a))
    _rotation_distance_pairs(_rows(a), _rows(b), weights, result)
    return result


def rotation_distance_table(
    a: NDArray[np.float64], b: NDArray[np.float64], weights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Compute D_q between each pose of one sequence and each of another (Costa 2018, Eq. 3.2).

    Parameters
    ----------
    a : ndarray of shape (n_first, n_joints, 3, 3)
        Poses.
    b : ndarray of shape (n_second, n_joints, 3, 3)
        Poses.
    weights : ndarray of shape (n_joints,)
        Joint weights.

    Returns
    -------
    ndarray of shape (n_first, n_second)

    Raises
    ------
    WorkbenchError
        If the shapes are others or do not fit each other.
    """
    first, weights = _fitting("a", a, weights, (3, 3))
    second, weights = _fitting("b", b, weights, (3, 3))
    result = np.empty((len(first), len(second)))
    _rotation_distance_table(_rows(first), _rows(second), weights, result)
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

    Raises
    ------
    WorkbenchError
        If the shapes are others or do not fit each other.
    """
    a, b, weights = _fitting_pairs(a, b, weights, (3,))
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

    Raises
    ------
    WorkbenchError
        If the shapes are others or do not fit each other.
    """
    from scipy.spatial.distance import cdist

    positions, weights = _fitting("positions", positions, weights, (3,))
    scaled = (positions * np.sqrt(weights)[:, None]).reshape(len(positions), -1)
    return cdist(scaled, scaled, "sqeuclidean")


def _fitting(
    name: str, poses: ArrayLike, weights: ArrayLike, entries: tuple[int, ...]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Refuse shapes with which a compiled loop would read beyond the end of an array."""
    poses = np.ascontiguousarray(poses, dtype=np.float64)
    weights = np.ascontiguousarray(weights, dtype=np.float64)
    if (
        poses.ndim != 2 + len(entries)
        or poses.shape[2:] != entries
        or weights.shape != poses.shape[1:2]
    ):
        wanted = ", ".join(["n_poses", "n_joints", *map(str, entries)])
        raise WorkbenchError(
            f"{name} and weights: got shapes {poses.shape} and {weights.shape}, "
            f"want ({wanted}) and (n_joints,)"
        )
    return poses, weights


def _fitting_pairs(
    a: ArrayLike, b: ArrayLike, weights: ArrayLike, entries: tuple[int, ...]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    first, weights = _fitting("a", a, weights, entries)
    second, weights = _fitting("b", b, weights, entries)
    if first.shape != second.shape:
        raise WorkbenchError(
            f"a and b: got shapes {first.shape} and {second.shape}, want the same shape"
        )
    return first, second, weights


def _rows(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    return poses.reshape(len(poses), 9 * poses.shape[1])
