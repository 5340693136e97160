"""What is kept of a motion, and how exactly."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection.poses import SpatialKeyframes
from workbench.compact.quantization import (
    FINEST_BITS,
    Quantized,
    power_of_two_below,
    quantize,
    step_for_bits,
)
from workbench.errors import WorkbenchError
from workbench.interpolation import interpolators
from workbench.mocap.channels import channels_from_rotations
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotation_vectors, rotations_from_vectors
from workbench.mocap.skeleton import ROTATION_CHANNELS, Skeleton
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


@dataclass(frozen=True, eq=False)
class CompactMotion:
    """A motion reduced to keyframes and what tells the other frames, all of it rounded.

    Its file holds exactly these numbers.

    Attributes
    ----------
    skeleton : Skeleton
        The joints.
    frame_time : float
        Time between frames, in seconds.
    name : str
        The clip's name.
    keyframes : ndarray of shape (n_keys,)
        Sorted frame indices.
    keys : Quantized
        Of shape (n_keys, n_values): what the interpolator keeps, or the rotation vectors of
        all joints in radians. Rotation vectors that are off by at most b in each number,
        ``keys.bound``, are rotations that are off by at most √3·b radians.
    path : Quantized
        Of shape (n_frames, 3 · (1 + n_moved)), in file units: the root's world position, then
        the positions, relative to their parents, of the joints in ``moved_joints``.
    embedding : Quantized or None
        Position of each frame, of shape (n_frames, n_dimensions); None where an interpolator
        is named.
    interpolator : str or None
        Registered name; None where the frames are rebuilt from their positions.
    back_projector : mapping of str to object
        Parameters of the spatial keyframes; empty where an interpolator is named.
    moved_joints : tuple of int
        Joints, other than the root, that the motion moves as well as turns.
    scheme_error, error : float
        Error per frame per joint of the scheme's reconstruction, and of what :meth:`expand`
        gives; the difference is what rounding has added.
    """

    skeleton: Skeleton
    frame_time: float
    name: str
    keyframes: NDArray[np.intp]
    keys: Quantized
    path: Quantized
    embedding: Quantized | None
    interpolator: str | None
    back_projector: Mapping[str, Any]
    moved_joints: tuple[int, ...]
    scheme_error: float
    error: float

    def expand(self) -> Motion:
        """Rebuild all frames.

        A joint whose own channels cannot express what it was rebuilt to, for lack of an axis,
        gets the missing rotation channels.

        Returns
        -------
        Motion
        """
        rotations = self.rotations()
        path = self.path.values
        return Motion(
            _with_channels_for(self.skeleton, rotations),
            rotations,
            path[:, :3],
            self.frame_time,
            {joint: path[:, 3 * i : 3 * i + 3] for i, joint in enumerate(self.moved_joints, 1)},
            name=self.name,
        )

    def rotations(self) -> NDArray[np.float64]:
        """Rebuild the rotations of all frames: (n_frames, n_joints, 3, 3)."""
        keys, n_frames = self.keys.values, len(self.path.counts)
        if self.interpolator is not None:
            interpolator = interpolators.create(self.interpolator)
            decoded: NDArray[np.float64] = interpolator.decode(
                keys, self.keyframes, n_frames, self.skeleton
            )
            return decoded
        assert self.embedding is not None
        positions = self.embedding.values
        poses = rotations_from_vectors(keys.reshape(len(keys), -1, 3))
        model = SpatialKeyframes(**self.back_projector).fit(positions[self.keyframes], poses)
        rebuilt = model.predict(positions)
        rebuilt[self.keyframes] = poses
        return rebuilt


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
    space, keyframes = result.space, result.control_points
    keys, positions, parameters = _kept(result, interpolator)
    exact = CompactMotion(
        space.motion.skeleton,
        space.motion.frame_time,
        space.motion.name,
        keyframes,
        _finest(keys),
        _path(space.motion),
        None if positions is None else _finest(positions),
        interpolator,
        parameters,
        tuple(sorted(space.motion.joint_translations)),
        result.error,
        result.error,
    )
    exact = _measured(exact, space)
    negligible = NEGLIGIBLE_ANGLE * float(space.weights.mean())
    if abs(exact.error - result.error) > max(_SAME * result.error, 1e-3 * negligible):
        kept = "its spatial keyframes" if interpolator is None else f"interpolator {interpolator!r}"
        raise WorkbenchError(
            f"result: {kept} give an error of {exact.error:.6g} where the scheme's is "
            f"{result.error:.6g}; want the name of the interpolator that made it, with its "
            "usual parameters"
        )

    def acceptable(candidate: CompactMotion, share: float) -> bool:
        added = candidate.error - result.error
        return added <= share * max(tolerance * result.error, negligible)

    def with_keys(bits: int) -> CompactMotion:
        return replace(exact, keys=quantize(keys, step_for_bits(keys, bits)))

    def with_positions(bits: int) -> CompactMotion:
        return replace(coarse, embedding=quantize(positions, step_for_bits(positions, bits)))

    # Of two things that are rounded, the first may use up half of what is tolerated.
    share = 1.0 if positions is None else 0.5
    coarse = _coarsest(with_keys, KEY_BITS, space, lambda c: acceptable(c, share))
    if positions is None:
        return coarse
    return _coarsest(with_positions, EMBEDDING_BITS, space, lambda c: acceptable(c, 1.0))


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
    if not (isinstance(result, SpatialResult) and isinstance(result.back_projector, SpatialKeyframes)):
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


def _finest(values: NDArray[np.float64]) -> Quantized:
    return quantize(values, step_for_bits(values, FINEST_BITS))


def _measured(compact: CompactMotion, space: PoseSpace) -> CompactMotion:
    """Find out the error of what a compact motion gives."""
    errors = space.errors(np.arange(len(space)), compact.rotations())
    return replace(compact, error=float(errors.mean()))


def _coarsest(
    rounded: Callable[[int], CompactMotion],
    every_bits: tuple[int, ...],
    space: PoseSpace,
    acceptable: Callable[[CompactMotion], bool],
) -> CompactMotion:
    """Round to as few bits as will do; to the most there are, if none will."""
    for bits in every_bits:
        candidate = _measured(rounded(bits), space)
        if acceptable(candidate):
            break
    return candidate


def _with_channels_for(skeleton: Skeleton, rotations: NDArray[np.float64]) -> Skeleton:
    """Complete the rotation channels of a skeleton that cannot express its joints' rotations."""
    if all(len(skeleton.rotation_order(joint)) == 3 for joint in range(skeleton.n_joints)):
        return skeleton
    try:
        channels_from_rotations(skeleton, rotations)
    except WorkbenchError:
        complete = [
            (*own, *(name for name in ROTATION_CHANNELS if name not in own))
            for own in skeleton.channels
        ]
        return replace(skeleton, channels=tuple(complete))
    return skeleton
