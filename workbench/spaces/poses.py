"""Poses of a motion as a space."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.rotations import check_rotations
from workbench.spaces.base import Space, sample_indices
from workbench.validation import (
    MIN_SAMPLES,
    control_point_indices,
    finite,
)


class PoseSpace(Space):
    """Poses of a motion under D_q, the weighted sum of joint rotation angles.

    Errors are D_q divided by the number of joints, so that their mean over all frames is
    the error per frame per joint of Costa 2018, chapter 5. The root's rotation counts as a
    joint; its translation does not count.

    Parameters
    ----------
    motion : Motion
        The clip, at least 3 frames.

    Raises
    ------
    WorkbenchError
        If it is shorter, its matrices are not rotations, or no bone has a length.
    """

    def __init__(self, motion: Motion) -> None:
        check_motion(motion)
        rotations = finite(np.ascontiguousarray(motion.rotations, dtype=np.float64), "rotations")
        if len(rotations) < MIN_SAMPLES:
            raise WorkbenchError(
                f"motion {motion.name!r}: got {len(rotations)} frames, want {MIN_SAMPLES} or more"
            )
        check_rotations(f"rotations of {motion.name!r}", rotations)
        if not motion.skeleton.path_weights.any():
            raise WorkbenchError(
                f"motion {motion.name!r}: no bone of its skeleton has a length, "
                "so no rotation has a weight; want offsets or end sites"
            )
        self.motion = motion
        self.samples = rotations
        self.name = motion.name

    @property
    def weights(self) -> NDArray[np.float64]:
        """Joint weights of D_q, from the clip's own skeleton: (n_joints,)."""
        return self.motion.skeleton.path_weights

    @property
    def features(self) -> NDArray[np.float64]:
        """The nine matrix entries of each joint: (n_frames, 9 · n_joints)."""
        return self.samples.reshape(len(self), -1)

    @cached_property
    def distances(self) -> NDArray[np.float64]:
        """D_q between all frames: (n_frames, n_frames)."""
        from workbench.mocap.distances import rotation_distance_matrix

        self._require_memory_for_distances()
        return rotation_distance_matrix(self.samples, self.weights)

    def pair_distances(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """Measure D_q between pairs of frames."""
        from workbench.mocap.distances import rotation_distance_pairs

        return rotation_distance_pairs(
            self.samples[sample_indices(first)], self.samples[sample_indices(second)], self.weights
        )

    def cross_distances(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """Measure D_q between poses of two sequences: (n_first, n_second)."""
        from workbench.mocap.distances import rotation_distance_table

        return rotation_distance_table(
            np.asarray(first, dtype=np.float64), np.asarray(second, dtype=np.float64), self.weights
        )

    def subset(self, indices: ArrayLike) -> PoseSpace:
        """Make a motion of some of the frames, one after the other as if nothing was between."""
        frames = control_point_indices(indices, len(self), at_least=MIN_SAMPLES, name="indices")
        motion = self.motion
        return PoseSpace(
            replace(
                motion,
                rotations=motion.rotations[frames],
                root_translation=motion.root_translation[frames],
                joint_translations={j: t[frames] for j, t in motion.joint_translations.items()},
            )
        )

    def errors(self, indices: ArrayLike, reconstructions: ArrayLike) -> NDArray[np.float64]:
        """Measure D_q per joint between frames and their reconstructions."""
        from workbench.mocap.distances import rotation_distance_pairs

        originals, rebuilt = self.matched(indices, reconstructions)
        distances = rotation_distance_pairs(originals, rebuilt, self.weights)
        return finite(distances / len(self.weights), "errors of reconstructions")

    def error_table(self, indices: ArrayLike, reconstructions: ArrayLike) -> NDArray[np.float64]:
        """Measure D_q per joint: (n_indices, n_reconstructions)."""
        distances = self.cross_distances(self.samples[sample_indices(indices)], reconstructions)
        return finite(distances / len(self.weights), "errors of reconstructions")

    def error_derivatives(
        self, indices: ArrayLike, reconstructions: ArrayLike, jacobians: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Measure D_q per joint between frames and reconstructions, and its derivatives."""
        from workbench.mocap.distance_derivatives import rotation_distance_derivatives

        originals, rebuilt = self.matched(indices, reconstructions)
        n_joints = len(self.weights)
        distances, gradients, curvatures = rotation_distance_derivatives(
            originals, rebuilt, jacobians, self.weights
        )
        errors = finite(distances / n_joints, "errors of reconstructions")
        return errors, gradients / n_joints, curvatures / n_joints

    @cached_property
    def positions(self) -> NDArray[np.float64]:
        """World positions of the joints, in file units: (n_frames, n_joints, 3)."""
        from workbench.mocap.kinematics import joint_positions

        return joint_positions(self.motion)

    @cached_property
    def position_distances(self) -> NDArray[np.float64]:
        """D_p between all frames with uniform weights: (n_frames, n_frames)."""
        from workbench.mocap.distances import position_distance_matrix

        return position_distance_matrix(self.positions, np.ones(len(self.weights)))

    def pair_position_distances(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """Measure D_p with uniform weights between pairs of frames."""
        from workbench.mocap.distances import position_distance_pairs

        return position_distance_pairs(
            self.positions[sample_indices(first)],
            self.positions[sample_indices(second)],
            np.ones(len(self.weights)),
        )

    @cached_property
    def neighbors(self) -> NDArray[np.intp]:
        """The previous and the next frame of each frame: (n_frames, 2)."""
        frames = np.arange(len(self))
        pairs = np.stack([frames - 1, frames + 1], axis=1)
        pairs[0, 0], pairs[-1, 1] = 1, len(self) - 2
        return pairs

    def mean_prediction_error(self) -> float:
        """Mean error per frame per joint of the mean pose (nearest rotation to the mean)."""
        from workbench.mocap.nearest_rotation import nearest_rotations

        mean = nearest_rotations(self.samples.mean(axis=0))
        every = np.broadcast_to(mean, self.samples.shape)
        return float(self.errors(np.arange(len(self)), every).mean())
