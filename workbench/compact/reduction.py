"""What is kept of a motion, and how exactly."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection.poses import SpatialKeyframes
from workbench.compact.motion import CompactMotion
from workbench.compact.quantization import (
    FINEST_BITS,
    Quantized,
    power_of_two_below,
    quantize,
    step_for_bits,
)
from workbench.errors import WorkbenchError
from workbench.interpolation import interpolators
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotation_vectors
from workbench.results import Result, SpatialResult
from workbench.spaces import PoseSpace
from workbench.validation import finite

#: Bits of a number, the sign included, that are tried one after the other. Positions lie
#: densely and are many, so they start coarser than the poses of keyframes.
KEY_BITS = (16, 20, 24, 32, 48, FINEST_BITS)
EMBEDDING_BITS = (12, 14, 16, 20, 24, 32, 48, FINEST_BITS)

#: Steps of a root's path: in centimetres, or relative to the longest chain of bones where the
#: scale is not known.
PATH_STEP_CM = 0.01
PATH_STEP_OF_REACH = 1e-4

#: An error that rounding may always add, as if it turned every joint by so many radians.
NEGLIGIBLE_ANGLE = 1e-4

#: A rebuilt motion whose error differs by more than this share is not the result's.
_SAME = 1e-6


def compact_motion(
    result: Result, interpolator: str | None = None, *, tolerance: float = 0.01
) -> CompactMotion:
    """Take from the result of a scheme what is needed to rebuild the motion, and round it.

    What rounding the positions of an embedding does to the poses cannot be told in advance:
    where markers nearly coincide, poses change a lot within very little. So it is tried out.
    Numbers of keyframes get 16 bits, positions 12, and as many more as it takes until the
    error per frame per joint is no more than ``tolerance`` above the scheme's. An error as
    small as that of turning every joint by 0.0001 radian is always accepted.

    The path is rounded to at most 0.01 cm, or 0.0001 of the skeleton's longest chain of
    bones where the scale is not known; it does not count in the error.

    Parameters
    ----------
    result : Result
        Of a spatial scheme with spatial keyframes, or of a temporal one.
    interpolator : str, optional
        The temporal scheme's interpolator, by its registered name.
    tolerance : float, default 0.01
        How much rounding may add to the error, as a share of it.

    Returns
    -------
    CompactMotion

    Raises
    ------
    WorkbenchError
        If the result is no motion's, was made by another back-projector or interpolator, or
        the tolerance is negative.

    Examples
    --------
    >>> from workbench.datasets import load_space
    >>> from workbench.schemes import TemporalScheme
    >>> result = TemporalScheme("slerp").run(load_space("cmu/01_01-jump"), ratio=0.03)
    >>> compact = compact_motion(result, "slerp")
    >>> compact.error < 1.01 * result.error
    True
    """
    if not isinstance(result.space, PoseSpace):
        raise WorkbenchError("result: got that of a table, want that of a motion")
    if not 0 <= tolerance < np.inf:
        raise WorkbenchError(f"tolerance: got {tolerance}, want a share from 0")
    space = result.space
    keys, positions, parameters = _kept(result, interpolator)
    exact = CompactMotion(
        space.motion.skeleton,
        space.motion.frame_time,
        space.motion.name,
        result.control_points,
        _rounded(keys, FINEST_BITS),
        _path(space.motion),
        None if positions is None else _rounded(positions, FINEST_BITS),
        interpolator,
        parameters,
        tuple(sorted(space.motion.joint_translations)),
        result.error,
        result.error,
    )
    negligible = NEGLIGIBLE_ANGLE * float(space.weights.mean())
    _check_same(_measured(exact, space), negligible)
    added = max(tolerance * result.error, negligible)
    if positions is None:
        return _coarsest(exact, "keys", keys, KEY_BITS, space, result.error + added)
    # Of two things that are rounded, the first may use up half of what is tolerated.
    coarse = _coarsest(exact, "keys", keys, KEY_BITS, space, result.error + added / 2)
    return _coarsest(coarse, "embedding", positions, EMBEDDING_BITS, space, result.error + added)


def _check_same(exact: CompactMotion, negligible: float) -> None:
    """Refuse a result that comes from another interpolator, or one with other parameters."""
    difference = abs(exact.error - exact.scheme_error)
    if difference > max(_SAME * exact.scheme_error, 1e-3 * negligible):
        kept = "spatial keyframes"
        if exact.interpolator is not None:
            kept = f"interpolator {exact.interpolator!r}"
        raise WorkbenchError(
            f"result: {kept} would rebuild it with an error of {exact.error:.6g}, but the "
            f"scheme's is {exact.scheme_error:.6g}; want the name of the interpolator that made "
            "it, with its usual parameters"
        )


def _kept(
    result: Result, interpolator: str | None
) -> tuple[NDArray[np.float64], NDArray[np.float64] | None, dict[str, Any]]:
    """Take numbers of keyframes, positions and back-projection's parameters from a result."""
    assert isinstance(result.space, PoseSpace)
    motion, keyframes = result.space.motion, result.control_points
    if interpolator is not None:
        method = interpolators.create(interpolator)
        if not (hasattr(method, "encode") and hasattr(method, "decode")):
            raise WorkbenchError(
                f"interpolator {interpolator!r}: has no encode and decode, so it does not tell "
                "what to keep"
            )
        return method.encode(motion, keyframes), None, {}
    if not (
        isinstance(result, SpatialResult) and isinstance(result.back_projector, SpatialKeyframes)
    ):
        raise WorkbenchError("result: want a temporal scheme's, or one of spatial keyframes")
    vectors = rotation_vectors(motion.rotations[keyframes]).reshape(len(keyframes), -1)
    # NumPy's numbers, which a user may have given, are none to JSON.
    parameters = {
        name: value.item() if isinstance(value, np.generic) else value
        for name, value in result.back_projector.get_params().items()
    }
    return vectors, result.embedding, parameters


def _path(motion: Motion) -> Quantized:
    """Round where the root is, and joints that the motion moves, counted from the first frame."""
    moved = [motion.joint_translations[joint] for joint in sorted(motion.joint_translations)]
    path = finite(np.concatenate([motion.root_translation, *moved], axis=1), "root_translation")
    finite(motion.skeleton.offsets, "offsets")
    unit = motion.skeleton.unit_cm
    if unit is not None:
        limit = PATH_STEP_CM / unit
    else:
        limit = PATH_STEP_OF_REACH * float(motion.skeleton.path_weights.max())
    # Far from the origin float64 itself is coarser than that.
    step = max(power_of_two_below(limit), step_for_bits(path, 53))
    return quantize(path, step, path[0].copy())


def _rounded(values: NDArray[np.float64], bits: int) -> Quantized:
    return quantize(values, step_for_bits(values, bits))


def _measured(compact: CompactMotion, space: PoseSpace) -> CompactMotion:
    """Find out the error of what a compact motion gives."""
    errors = space.errors(np.arange(len(space)), compact.rotations())
    return replace(compact, error=float(errors.mean()))


def _coarsest(
    compact: CompactMotion,
    part: str,
    values: NDArray[np.float64],
    every_bits: tuple[int, ...],
    space: PoseSpace,
    most_error: float,
) -> CompactMotion:
    """Round a part to as few bits as keep the error low; to the most there are, if none do."""
    for bits in every_bits:
        changed: dict[str, Any] = {part: _rounded(values, bits)}
        candidate = _measured(replace(compact, **changed), space)
        if candidate.error <= most_error:
            break
    return candidate
