"""Radial kernels φ(r): their values and slopes at many points, compiled."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import prange
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.kernels import compiled, compiled_parallel

_LINEAR, _THIN_PLATE, _CUBIC, _GAUSSIAN, _MULTIQUADRIC = range(5)


@dataclass(frozen=True)
class RadialKernel:
    """What solving for weights has to know about a kernel.

    All of them are definite on weights that a linear polynomial does not see (Σ w_j = 0
    and Σ w_j c_j = 0), so a polynomial of degree 1 makes each system solvable (Micchelli
    1986).

    Attributes
    ----------
    code : int
        Its number in the compiled loops.
    sign : int
        1 if it is positive definite there, −1 if negative definite.
    power : int
        How it grows with the size of the plane, φ(s r) ~ s^power φ(r); 0 for a kernel with
        a width of its own.
    """

    code: int
    sign: int
    power: int


KERNELS = {
    "linear": RadialKernel(_LINEAR, -1, 1),
    "thin-plate": RadialKernel(_THIN_PLATE, 1, 2),
    "cubic": RadialKernel(_CUBIC, 1, 3),
    "gaussian": RadialKernel(_GAUSSIAN, 1, 0),
    "multiquadric": RadialKernel(_MULTIQUADRIC, -1, 0),
}


def radial_kernel(name: str) -> RadialKernel:
    """Look up a kernel.

    Raises
    ------
    WorkbenchError
        If there is none of that name.
    """
    if not isinstance(name, str) or name not in KERNELS:
        raise WorkbenchError(f"kernel: got {name!r}, want one of {', '.join(KERNELS)}")
    return KERNELS[name]


@compiled
def _values(code, epsilon, row):  # type: ignore[no-untyped-def]  # compiled
    """Replace squared distances r² by φ(r)."""
    if code == _LINEAR:
        for j in range(row.shape[0]):
            row[j] = math.sqrt(row[j])
    elif code == _THIN_PLATE:
        for j in range(row.shape[0]):
            row[j] = 0.5 * row[j] * math.log(row[j]) if row[j] > 0.0 else 0.0
    elif code == _CUBIC:
        for j in range(row.shape[0]):
            row[j] = row[j] * math.sqrt(row[j])
    elif code == _GAUSSIAN:
        for j in range(row.shape[0]):
            row[j] = math.exp(-epsilon * epsilon * row[j])
    else:
        for j in range(row.shape[0]):
            row[j] = math.sqrt(1.0 + epsilon * epsilon * row[j])


@compiled
def _slopes(code, epsilon, row):  # type: ignore[no-untyped-def]  # compiled
    """Replace squared distances r² by φ'(r) / r, and by 0 at r = 0 where that is infinite."""
    if code == _LINEAR:
        for j in range(row.shape[0]):
            row[j] = 1.0 / math.sqrt(row[j]) if row[j] > 0.0 else 0.0
    elif code == _THIN_PLATE:
        for j in range(row.shape[0]):
            row[j] = math.log(row[j]) + 1.0 if row[j] > 0.0 else 0.0
    elif code == _CUBIC:
        for j in range(row.shape[0]):
            row[j] = 3.0 * math.sqrt(row[j])
    elif code == _GAUSSIAN:
        for j in range(row.shape[0]):
            row[j] = -2.0 * epsilon * epsilon * math.exp(-epsilon * epsilon * row[j])
    else:
        for j in range(row.shape[0]):
            row[j] = epsilon * epsilon / math.sqrt(1.0 + epsilon * epsilon * row[j])


@compiled
def _squared_distances(point, centers, row):  # type: ignore[no-untyped-def]  # compiled
    for j in range(centers.shape[0]):
        total = 0.0
        for k in range(centers.shape[1]):
            difference = point[k] - centers[j, k]
            total += difference * difference
        row[j] = total


@compiled_parallel
def fill_basis(code, epsilon, points, centers, basis):  # type: ignore[no-untyped-def]  # compiled
    """Write φ(‖x − c_j‖) for each centre, 1 and x for each point.

    points (n, d), centers (m, d), basis (n, m + 1 + d).
    """
    m = centers.shape[0]
    for i in prange(points.shape[0]):
        _squared_distances(points[i], centers, basis[i, :m])
        _values(code, epsilon, basis[i, :m])
        basis[i, m] = 1.0
        for k in range(points.shape[1]):
            basis[i, m + 1 + k] = points[i, k]


@compiled_parallel
def fill_basis_derivatives(  # type: ignore[no-untyped-def]  # compiled
    code, epsilon, points, centers, derivatives
):
    """Write the derivatives of that basis along each dimension.

    points (n, d), centers (m, d), derivatives (n, d, m + 1 + d).
    """
    m = centers.shape[0]
    d = points.shape[1]
    for i in prange(points.shape[0]):
        last = derivatives[i, d - 1]
        _squared_distances(points[i], centers, last[:m])
        _slopes(code, epsilon, last[:m])
        # The last dimension overwrites the slopes, which the others need before.
        for k in range(d):
            for j in range(m):
                derivatives[i, k, j] = last[j] * (points[i, k] - centers[j, k])
            for j in range(d + 1):
                derivatives[i, k, m + j] = 1.0 if j == k + 1 else 0.0


def kernel_matrix(
    kernel: RadialKernel,
    epsilon: float,
    points: NDArray[np.float64],
    centers: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Evaluate a kernel between points and centres: (n_points, n_centers)."""
    basis = np.empty((len(points), len(centers) + 1 + points.shape[1]))
    fill_basis(kernel.code, epsilon, points, centers, basis)
    return np.ascontiguousarray(basis[:, : len(centers)])
