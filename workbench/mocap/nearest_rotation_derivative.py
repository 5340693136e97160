"""How the nearest rotation changes with the matrix."""

from __future__ import annotations

import numpy as np
from numba import prange
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.kernels import compiled, compiled_parallel
from workbench.mocap.nearest_rotation import _nearest_rotation
from workbench.validation import as_numbers


@compiled
def _nearest_rotation_and_derivatives(m, derivatives):  # type: ignore[no-untyped-def]  # compiled
    """Replace M (3, 3) by R and each dM of ``derivatives`` (n_directions, 3, 3) by dR."""
    m00, m01, m02 = m[0, 0], m[0, 1], m[0, 2]
    m10, m11, m12 = m[1, 0], m[1, 1], m[1, 2]
    m20, m21, m22 = m[2, 0], m[2, 1], m[2, 2]
    if not _nearest_rotation(m):
        return False
    r00, r01, r02 = m[0, 0], m[0, 1], m[0, 2]
    r10, r11, r12 = m[1, 0], m[1, 1], m[1, 2]
    r20, r21, r22 = m[2, 0], m[2, 1], m[2, 2]
    # S = Rᵀ M is symmetric, and G = tr(S) I − S.
    s00 = r00 * m00 + r10 * m10 + r20 * m20
    s11 = r01 * m01 + r11 * m11 + r21 * m21
    s22 = r02 * m02 + r12 * m12 + r22 * m22
    g01 = -(r00 * m01 + r10 * m11 + r20 * m21)
    g02 = -(r00 * m02 + r10 * m12 + r20 * m22)
    g12 = -(r01 * m02 + r11 * m12 + r21 * m22)
    g00, g11, g22 = s11 + s22, s00 + s22, s00 + s11
    # G⁻¹ by cofactors.
    c00, c01, c02 = g11 * g22 - g12 * g12, g02 * g12 - g01 * g22, g01 * g12 - g02 * g11
    c11, c12, c22 = g00 * g22 - g02 * g02, g01 * g02 - g00 * g12, g00 * g11 - g01 * g01
    determinant = g00 * c00 + g01 * c01 + g02 * c02
    mean = (g00 + g11 + g22) / 3.0
    # Without a derivative, 0 is given.
    inverse = 0.0
    if determinant > 1e-12 * mean * mean * mean:
        inverse = 1.0 / determinant
    for n in range(derivatives.shape[0]):
        d = derivatives[n]
        # The axial vector of Rᵀ dM − (Rᵀ dM)ᵀ.
        a0 = (
            r02 * d[0, 1] + r12 * d[1, 1] + r22 * d[2, 1]
            - r01 * d[0, 2] - r11 * d[1, 2] - r21 * d[2, 2]
        )  # fmt: skip  # one product in each line would hide the symmetry
        a1 = (
            r00 * d[0, 2] + r10 * d[1, 2] + r20 * d[2, 2]
            - r02 * d[0, 0] - r12 * d[1, 0] - r22 * d[2, 0]
        )  # fmt: skip
        a2 = (
            r01 * d[0, 0] + r11 * d[1, 0] + r21 * d[2, 0]
            - r00 * d[0, 1] - r10 * d[1, 1] - r20 * d[2, 1]
        )  # fmt: skip
        x = inverse * (c00 * a0 + c01 * a1 + c02 * a2)
        y = inverse * (c01 * a0 + c11 * a1 + c12 * a2)
        z = inverse * (c02 * a0 + c12 * a1 + c22 * a2)
        d[0, 0], d[0, 1], d[0, 2] = r01 * z - r02 * y, r02 * x - r00 * z, r00 * y - r01 * x
        d[1, 0], d[1, 1], d[1, 2] = r11 * z - r12 * y, r12 * x - r10 * z, r10 * y - r11 * x
        d[2, 0], d[2, 1], d[2, 2] = r21 * z - r22 * y, r22 * x - r20 * z, r20 * y - r21 * x
    return True


@compiled_parallel
def _all_nearest_rotations_and_derivatives(  # type: ignore[no-untyped-def]  # compiled
    matrices, derivatives
):
    """Do it for all rows and joints in place, and count the matrices that are not finite."""
    refused = 0
    for row in prange(matrices.shape[0]):
        for joint in range(matrices.shape[1]):
            if not _nearest_rotation_and_derivatives(
                matrices[row, joint], derivatives[row, :, joint]
            ):
                refused += 1
    return refused


def nearest_rotations_with_derivatives(
    matrices: ArrayLike, derivatives: ArrayLike, *, overwrite: bool = False
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Find the rotation nearest to each matrix, and how it moves when the matrix does.

    With M = R S, R the nearest rotation and S symmetric, dM = dR S + R dS. The part of
    Rᵀ dM that is not symmetric leaves Ω S + S Ω for the skew Ω = Rᵀ dR, which for its axial
    vector ω is (tr(S) I − S) ω = axial(Rᵀ dM − dMᵀ R), three equations. Optimizers of
    spatial keyframes need it, since the back-projection ends with nearest rotations.

    Where the nearest rotation is not unique (a rank below 2, or a reflection with two
    equal smallest singular values) there is no derivative, and 0 is given.

    Parameters
    ----------
    matrices : array-like of shape (n_rows, n_joints, 3, 3)
        Any finite matrices M.
    derivatives : array-like of shape (n_rows, n_directions, n_joints, 3, 3)
        Their derivatives dM along some directions.
    overwrite : bool
        Whether the results may take the place of the input.

    Returns
    -------
    rotations : ndarray of shape (n_rows, n_joints, 3, 3)
        As :func:`~workbench.mocap.nearest_rotation.nearest_rotations` gives them.
    derivatives : ndarray of shape (n_rows, n_directions, n_joints, 3, 3)
        dR along the same directions.

    Raises
    ------
    WorkbenchError
        If the shapes do not fit, or a matrix is not finite.

    Examples
    --------
    >>> spin = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    >>> _, change = nearest_rotations_with_derivatives([[2.0 * np.eye(3)]], [[[spin]]])
    >>> change[0, 0, 0]
    array([[ 0. , -0.5,  0. ],
           [ 0.5,  0. ,  0. ],
           [ 0. ,  0. ,  0. ]])
    """
    copy = None if overwrite else True
    rotations = np.array(as_numbers("matrices", matrices, 3, 3), order="C", copy=copy)
    changes = np.array(as_numbers("derivatives", derivatives, 3, 3), order="C", copy=copy)
    if (
        rotations.ndim != 4
        or changes.ndim != 5
        or rotations.shape[:2] != (changes.shape[0], changes.shape[2])
    ):
        raise WorkbenchError(
            f"matrices and derivatives: got shapes {rotations.shape} and {changes.shape}, "
            "want (n_rows, n_joints, 3, 3) and (n_rows, n_directions, n_joints, 3, 3)"
        )
    if _all_nearest_rotations_and_derivatives(rotations, changes):
        raise WorkbenchError("matrices: got numbers that are not finite")
    return rotations, changes
