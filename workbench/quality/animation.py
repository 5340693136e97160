"""Errors of rebuilt animations: mean squared error and peak signal-to-noise ratio."""

from __future__ import annotations

from dataclasses import replace
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.channels import channels_from_rotations, motion_to_euler, rotation_columns
from workbench.mocap.contacts import feet_by_name
from workbench.mocap.kinematics import body_positions
from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.rotations import check_rotations
from workbench.mocap.skeleton import Skeleton
from workbench.validation import as_numbers, finite

#: The length that the femur has in Halit 2010, Table 4.1.
FEMUR_LENGTH = 3.21
#: The degrees of freedom that the error there is divided by.
N_DIMENSIONS = 62
#: The greatest value of a joint angle, in degrees (Halit 2010, Eq. 4.2).
GREATEST_ANGLE = 360.0


def body_coordinate_error(
    motion: Motion,
    rotations: ArrayLike,
    *,
    femur: float | None = None,
    n_dimensions: int = N_DIMENSIONS,
) -> float:
    """Measure the mean squared error of a reconstruction in body coordinates.

    E = Σ_i Σ_k |F_i°(k) − F_i^r(k)|² / (n · j), with F_i(k) the position of joint k in frame i
    in the root's own frame, n frames and j dimensions of the skeleton, scaled so that the
    femur has a length of 3.21 (Halit 2010, Eq. 4.1; the thesis has j = 62). Neither the root's
    path nor its rotation counts.

    Parameters
    ----------
    motion : Motion
        The original.
    rotations : array-like of shape (n_frames, n_joints, 3, 3)
        Rebuilt rotations.
    femur : float, optional
        Length of the femur in file units; by default that of the skeleton, the bone above the
        lower leg.
    n_dimensions : int
        j.

    Returns
    -------
    float
        In squared units of which the femur has 3.21; the mean of
        :func:`body_coordinate_errors`.

    Raises
    ------
    WorkbenchError
        If the shape is another, a matrix is no rotation, the femur is not found, or a parameter
        is not above 0.
    """
    return float(
        body_coordinate_errors(motion, rotations, femur=femur, n_dimensions=n_dimensions).mean()
    )


def body_coordinate_errors(
    motion: Motion,
    rotations: ArrayLike,
    *,
    femur: float | None = None,
    n_dimensions: int = N_DIMENSIONS,
) -> NDArray[np.float64]:
    """Measure the squared error of each frame in body coordinates.

    Parameters
    ----------
    motion, rotations, femur, n_dimensions
        As :func:`body_coordinate_error` takes them.

    Returns
    -------
    ndarray of shape (n_frames,)

    Raises
    ------
    WorkbenchError
        As there.
    """
    rebuilt = replace(motion, rotations=_rebuilt(motion, rotations))
    length = femur_length(motion.skeleton) if femur is None else femur
    for name, value in (("femur", length), ("n_dimensions", n_dimensions)):
        if not isinstance(value, Real) or not 0 < value < np.inf:
            raise WorkbenchError(f"{name}: got {value!r}, want a number above 0")
    errors = body_positions(motion) - body_positions(rebuilt)
    squares = np.einsum("fjc,fjc->f", errors, errors)
    return squares * (FEMUR_LENGTH / length) ** 2 / n_dimensions


def femur_length(skeleton: Skeleton) -> float:
    """Measure the femur of a skeleton whose ankles or feet have common names.

    Parameters
    ----------
    skeleton : Skeleton
        The joints. The ankle, or the foot where none is called so, hangs on the knee, and
        that on the hip; toes do not tell how many joints are above them.

    Returns
    -------
    float
        In file units, of the left leg.

    Raises
    ------
    WorkbenchError
        If neither ankles nor feet are found by name, or they hang on no leg.
    """
    feet = feet_by_name(skeleton, parts=("ankle", "foot", "feet"))
    knee = int(skeleton.parents[feet[0]]) if feet else -1
    if knee < 1:
        raise WorkbenchError("femur: found no leg by the names of joints, want its length")
    return float(np.linalg.norm(skeleton.offsets[knee]))


def psnr(motion: Motion, rotations: ArrayLike) -> float:
    """Compute the peak signal-to-noise ratio of a reconstruction's joint angles.

    Parameters
    ----------
    motion : Motion
        The original.
    rotations : array-like of shape (n_frames, n_joints, 3, 3)
        Rebuilt rotations.

    Returns
    -------
    float
        In dB, of the mean of :func:`joint_angle_errors`; infinite where nothing is lost.

    Raises
    ------
    WorkbenchError
        If the shape is another, a matrix is no rotation, or one that its joint's channels cannot
        express.
    """
    return float(psnr_of_error(joint_angle_errors(motion, rotations).mean()))


def joint_angle_errors(motion: Motion, rotations: ArrayLike) -> NDArray[np.float64]:
    """Measure the mean squared joint-angle error of each frame.

    Angles are the Euler angles of each joint's own channels, the root's rotation included. Of
    the two triples of angles that stand for a rebuilt rotation, the one nearer to the original
    is taken, and full turns do not count. Near gimbal lock angles tell little: there, rotations
    that are almost equal may have very different ones.

    Parameters
    ----------
    motion : Motion
        The original.
    rotations : array-like of shape (n_frames, n_joints, 3, 3)
        Rebuilt rotations.

    Returns
    -------
    ndarray of shape (n_frames,)
        In squared degrees.

    Raises
    ------
    WorkbenchError
        If the shape is another, a matrix is no rotation, or one that its joint's channels cannot
        express.
    """
    original = motion_to_euler(motion, unwrap=True)
    rebuilt = channels_from_rotations(motion.skeleton, _rebuilt(motion, rotations))
    difference = _nearest_turn(rebuilt - original)
    triples = [c for c in rotation_columns(motion.skeleton) if c.stop - c.start == 3]
    for columns in triples:
        # Three angles have one other representative, (a + 180, 180 − b, c + 180).
        first, second, third = rebuilt[:, columns].T
        other = np.stack([first + 180.0, 180.0 - second, third + 180.0], axis=1)
        flipped = _nearest_turn(other - original[:, columns])
        here = difference[:, columns]
        nearer = np.sum(flipped**2, axis=1) < np.sum(here**2, axis=1)
        difference[nearer, columns] = flipped[nearer]
    return np.mean(difference**2, axis=1)


def angle_errors(original: ArrayLike, rebuilt: ArrayLike) -> NDArray[np.float64]:
    """Measure the mean squared error of each frame between two arrays of angle curves.

    For angles that are known without a skeleton, such as
    :attr:`~workbench.mocap.amc.JointAngles.degrees`.

    Parameters
    ----------
    original, rebuilt : array-like of shape (n_frames, n_angles)
        Angles in degrees; full turns between the two do not count, so neither has to be
        unwrapped.

    Returns
    -------
    ndarray of shape (n_frames,)
        In squared degrees; :func:`psnr_of_error` makes decibels of their mean.

    Raises
    ------
    WorkbenchError
        If the shapes differ, or a number is not finite.

    Examples
    --------
    >>> angle_errors([[0.0, 90.0], [359.0, 90.0]], [[0.0, 92.0], [1.0, 90.0]])
    array([2., 2.])
    """
    first = finite(as_numbers("original", original), "original")
    second = finite(as_numbers("rebuilt", rebuilt), "rebuilt")
    if first.ndim != 2 or not first.size or first.shape != second.shape:
        raise WorkbenchError(
            f"original and rebuilt: got shapes {first.shape} and {second.shape}, "
            "want equal ones, (n_frames, n_angles)"
        )
    return np.mean(_nearest_turn(second - first) ** 2, axis=1)


def psnr_of_error(mean_squared_error: ArrayLike) -> Any:
    """Turn mean squared joint-angle errors into peak signal-to-noise ratios.

    20 · log10(360 / √E) (Halit 2010, Eq. 4.2). E is the mean squared error of joint angles in
    degrees: the errors of Table 4.1, which are in body coordinates, do not give the ratios of
    Table 4.2.

    Parameters
    ----------
    mean_squared_error : array-like of shape (...)
        E in squared degrees.

    Returns
    -------
    float or ndarray of shape (...)
        In dB; infinite where the error is 0.

    Raises
    ------
    WorkbenchError
        If an error is below 0 or no number.

    Examples
    --------
    >>> float(psnr_of_error(3.6**2))
    40.0
    """
    errors = as_numbers("mean_squared_error", mean_squared_error)
    if not np.all(errors >= 0):
        raise WorkbenchError("mean_squared_error: got a negative or missing value, want 0 or more")
    with np.errstate(divide="ignore"):
        return 20.0 * np.log10(GREATEST_ANGLE) - 10.0 * np.log10(errors)


def _nearest_turn(degrees: NDArray[np.float64]) -> NDArray[np.float64]:
    """Remove full turns from differences of angles."""
    return degrees - 360.0 * np.round(degrees / 360.0)


def _rebuilt(motion: Motion, rotations: ArrayLike) -> NDArray[np.float64]:
    check_motion(motion)
    array = as_numbers("rotations", rotations)
    if array.shape != np.shape(motion.rotations):
        raise WorkbenchError(
            f"rotations: got shape {array.shape}, want {np.shape(motion.rotations)}"
        )
    check_rotations("rotations", finite(array, "rotations"))
    return array
