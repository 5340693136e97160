"""Distances between poses: D_p by joint positions, D_q by joint rotations."""

from __future__ import annotations

import math

import numpy as np
from numba import prange
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.kernels import compiled, compiled_fused, compiled_parallel
from workbench.mocap.elementary import angle_from_squared_chord
from workbench.validation import require_memory

#: Poses in a row or column of a tile: what a tile reads and writes stays in the cache.
_TILE = 128


@compiled_fused
def _add_joint(  # type: ignore[no-untyped-def]  # compiled
    angle_weight, rotation, others, first, last, sums
):
    """Add one joint's weighted angles between a rotation and those of columns first … last.

    ``rotation`` has 9 entries, ``others`` a row for each of the 9. The rows are contiguous
    and the loop starts at 0: otherwise it is not vectorised.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8 = (
        rotation[0], rotation[1], rotation[2], rotation[3], rotation[4],
        rotation[5], rotation[6], rotation[7], rotation[8],
    )  # fmt: skip
    b0, b1, b2 = others[0, first:last], others[1, first:last], others[2, first:last]
    b3, b4, b5 = others[3, first:last], others[4, first:last], others[5, first:last]
    b6, b7, b8 = others[6, first:last], others[7, first:last], others[8, first:last]
    for j in range(len(sums)):
        chord2 = (a0 - b0[j]) ** 2 + (a1 - b1[j]) ** 2 + (a2 - b2[j]) ** 2
        chord2 += (a3 - b3[j]) ** 2 + (a4 - b4[j]) ** 2 + (a5 - b5[j]) ** 2
        chord2 += (a6 - b6[j]) ** 2 + (a7 - b7[j]) ** 2 + (a8 - b8[j]) ** 2
        sums[j] += angle_weight * angle_from_squared_chord(chord2)


@compiled
def _fill_below_diagonal(a, weights, top, left, result):  # type: ignore[no-untyped-def]  # compiled
    """Fill a tile of the result left of the diagonal, and its mirror image."""
    n = result.shape[0]
    right = min(left + _TILE, n)
    for joint in range(weights.shape[0]):
        for i in range(top, min(top + _TILE, n)):
            last = min(right, i)
            _add_joint(weights[joint], a[joint, :, i], a[joint], left, last, result[i, left:last])
    for i in range(top, min(top + _TILE, n)):
        for j in range(left, min(right, i)):
            result[j, i] = result[i, j]


@compiled_parallel
def _rotation_distance_matrix(poses, weights, result):  # type: ignore[no-untyped-def]  # compiled
    n_tiles = (result.shape[0] + _TILE - 1) // _TILE
    for tile in prange(n_tiles * (n_tiles + 1) // 2):
        # Tiles are numbered row by row, and row r has r + 1 of them.
        row = np.int64((math.sqrt(8.0 * tile + 1.0) - 1.0) / 2.0)
        column = tile - row * (row + 1) // 2
        _fill_below_diagonal(poses, weights, row * _TILE, column * _TILE, result)


@compiled_parallel
def _rotation_distance_table(a, b, weights, result):  # type: ignore[no-untyped-def]  # compiled
    n_first, n_second = result.shape
    across = (n_second + _TILE - 1) // _TILE
    for tile in prange(across * ((n_first + _TILE - 1) // _TILE)):
        top, left = np.int64(tile // across) * _TILE, np.int64(tile % across) * _TILE
        right = min(left + _TILE, n_second)
        for joint in range(weights.shape[0]):
            for i in range(top, min(top + _TILE, n_first)):
                _add_joint(
                    weights[joint], a[joint, :, i], b[joint], left, right, result[i, left:right]
                )


@compiled_fused
def rotation_distance(a, b, weights):  # type: ignore[no-untyped-def]  # compiled
    """Compute D_q of two poses, for compiled loops over few pairs.

    Parameters
    ----------
    a, b : ndarray of shape (9 * n_joints,)
        Poses, the entries of one joint after those of another.
    weights : ndarray of shape (n_joints,)
        Joint weights.

    Returns
    -------
    float

    Examples
    --------
    >>> turned = np.array([0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    >>> round(rotation_distance(np.eye(3).ravel(), turned, np.array([2.0])) / math.pi, 12)
    1.0
    """
    angles = np.empty(weights.shape[0])
    for joint in range(weights.shape[0]):
        chord2 = 0.0
        for entry in range(9 * joint, 9 * joint + 9):
            difference = a[entry] - b[entry]
            chord2 += difference * difference
        angles[joint] = chord2
    # A loop of its own, so that it is vectorised.
    for joint in range(weights.shape[0]):
        angles[joint] = weights[joint] * angle_from_squared_chord(angles[joint])
    total = 0.0
    for joint in range(weights.shape[0]):
        total += angles[joint]
    return total


@compiled_parallel
def _rotation_distance_pairs(a, b, weights, result):  # type: ignore[no-untyped-def]  # compiled
    for i in prange(a.shape[0]):
        result[i] = rotation_distance(a[i], b[i], weights)


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
    n = len(poses)
    require_memory(16.0 * n * n, f"the distance matrix of {n} poses", "take fewer frames")
    result = np.zeros((n, n))
    _rotation_distance_matrix(_entries_first(poses), weights, result)
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
    result = np.zeros((len(first), len(second)))
    _rotation_distance_table(_entries_first(first), _entries_first(second), weights, result)
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


def _entries_first(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lay poses out as (n_joints, 9, n_poses), for loops over poses."""
    return np.ascontiguousarray(_rows(poses).reshape(len(poses), -1, 9).transpose(1, 2, 0))
