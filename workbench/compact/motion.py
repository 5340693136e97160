"""A motion in its compact form, and how it is rebuilt."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection.poses import SpatialKeyframes
from workbench.compact.quantization import Quantized
from workbench.errors import DegenerateDataWarning, WorkbenchError
from workbench.interpolation import interpolators
from workbench.mocap.channels import channels_from_rotations
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotations_from_vectors
from workbench.mocap.skeleton import ROTATION_CHANNELS, Skeleton


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
        with warnings.catch_warnings():
            # Markers that coincide were told of when the scheme ran; here poses are given back.
            warnings.simplefilter("ignore", DegenerateDataWarning)
            model = SpatialKeyframes(**self.back_projector).fit(positions[self.keyframes], poses)
        rebuilt = model.predict(positions)
        rebuilt[self.keyframes] = poses
        return rebuilt


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
