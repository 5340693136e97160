"""Spaces of samples: what every step of the pipeline works on.

A space knows its samples, how far apart they are, how wrong a reconstruction of one is,
and which samples are next to each other. Motion capture and tables differ in nothing
else, so all other steps serve both.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.rotations import check_rotations
from workbench.validation import (
    MIN_SAMPLES,
    control_point_indices,
    finite,
    require_memory,
)


class Space(ABC):
    """The base of all spaces.

    Attributes
    ----------
    name : str
        What to call the data in messages and figures.
    samples : ndarray of shape (n_samples, ...)
        The samples themselves.
    labels : ndarray of shape (n_samples,) or None
        A class for each sample.
    notes : tuple of str
        What was done to the data when they were read, for the user to know.
    """

    name: str
    samples: NDArray[np.float64]
    labels: NDArray[Any] | None = None
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.samples)

    @property
    @abstractmethod
    def features(self) -> NDArray[np.float64]:
        """Samples as vectors, for methods that need coordinates: (n_samples, n_features)."""

    @property
    @abstractmethod
    def distances(self) -> NDArray[np.float64]:
        """Distances between all pairs of samples: (n_samples, n_samples)."""

    @abstractmethod
    def pair_distances(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """Measure the distances between pairs of samples.

        Parameters
        ----------
        first, second : array-like of shape (n_pairs,)
            Indices of samples.

        Returns
        -------
        ndarray of shape (n_pairs,)
        """

    @abstractmethod
    def cross_distances(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """Measure the distances between samples of two sets, new ones too.

        Parameters
        ----------
        first : array-like of shape (n_first, ...)
            Samples like those of the space.
        second : array-like of shape (n_second, ...)
            As many or others.

        Returns
        -------
        ndarray of shape (n_first, n_second)
        """

    @abstractmethod
    def subset(self, indices: ArrayLike) -> Space:
        """Make a space of some of the samples, under the same distance.

        Parameters
        ----------
        indices : array-like of shape (n_subset,)
            Sorted, each once, at least 3.

        Returns
        -------
        Space
        """

    @abstractmethod
    def errors(self, indices: ArrayLike, reconstructions: ArrayLike) -> NDArray[np.float64]:
        """Measure how far reconstructions are from the samples that they stand for.

        Parameters
        ----------
        indices : array-like of shape (n_points,)
            The sample that each reconstruction stands for; repetitions are allowed.
        reconstructions : array-like of shape (n_points, ...)
            Reconstructed samples.

        Returns
        -------
        ndarray of shape (n_points,)
        """

    @abstractmethod
    def error_table(self, indices: ArrayLike, reconstructions: ArrayLike) -> NDArray[np.float64]:
        """Measure the error of every reconstruction as one of every given sample.

        Parameters
        ----------
        indices : array-like of shape (n_indices,)
            Samples.
        reconstructions : array-like of shape (n_reconstructions, ...)
            Reconstructed samples.

        Returns
        -------
        ndarray of shape (n_indices, n_reconstructions)
        """

    @abstractmethod
    def error_derivatives(
        self, indices: ArrayLike, reconstructions: ArrayLike, jacobians: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Measure errors and how they change with what the reconstructions depend on.

        Parameters
        ----------
        indices, reconstructions
            As for :meth:`errors`.
        jacobians : ndarray of shape (n_points, ..., n_dimensions)
            Derivatives of the reconstructions by position.

        Returns
        -------
        errors : ndarray of shape (n_points,)
        gradients : ndarray of shape (n_points, n_dimensions)
        curvatures : ndarray of shape (n_points, n_dimensions, n_dimensions)
            Second derivatives as if the Jacobians were constant (Gauss and Newton):
            positive semidefinite. All 0 where the error is 0 and has a kink.
        """

    @property
    @abstractmethod
    def neighbors(self) -> NDArray[np.intp]:
        """Two neighbours of each sample, equal where there is only one: (n_samples, 2)."""

    @abstractmethod
    def mean_prediction_error(self) -> float:
        """Mean error of the poorest sensible reconstruction: every sample by the mean."""

    def matched(
        self, indices: ArrayLike, reconstructions: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Pair samples with their reconstructions, whoever made these.

        Parameters
        ----------
        indices : array-like of shape (n_points,)
            The sample that each reconstruction stands for.
        reconstructions : array-like of shape (n_points, ...)
            Reconstructed samples.

        Returns
        -------
        samples, reconstructions : ndarray of shape (n_points, ...)

        Raises
        ------
        WorkbenchError
            If they are not as many, or of another shape.
        """
        originals = self.samples[_index(indices)]
        rebuilt = np.asarray(reconstructions, dtype=np.float64)
        if rebuilt.shape != originals.shape:
            raise WorkbenchError(
                f"reconstructions: got shape {rebuilt.shape}, want {originals.shape}"
            )
        return originals, rebuilt

    def _require_memory_for_distances(self) -> None:
        # Twice the matrix: methods that work on it need a copy.
        require_memory(
            16.0 * len(self) ** 2,
            f"{self.name or 'data'}: the distances between {len(self)} samples",
            "take a sample of them, or a shorter or thinner clip",
        )


class VectorSpace(Space):
    """Rows of a table under the Euclidean distance.

    Parameters
    ----------
    values : array-like of shape (n_samples, n_features)
        The table's numbers.
    columns : iterable of str, optional
        Names of the features.
    labels : array-like of shape (n_samples,), optional
        A class for each row; never used by a projection, only to colour it.
    name : str
        What to call the table.
    standardize : bool
        Whether to bring each column to zero mean and unit variance; a constant column
        becomes 0. It changes every result, so figures and tables say which was used.
    notes : sequence of str
        What was done to the data when they were read.

    Raises
    ------
    WorkbenchError
        If the table is not 2-D, has fewer than 3 rows or values that are not finite.

    Examples
    --------
    >>> space = VectorSpace([[0, 0], [3, 4], [0, 1]])
    >>> space.pair_distances([0], [1])
    array([5.])
    """

    def __init__(
        self,
        values: ArrayLike,
        *,
        columns: Iterable[str] | None = None,
        labels: ArrayLike | None = None,
        name: str = "",
        standardize: bool = False,
        notes: tuple[str, ...] = (),
    ) -> None:
        try:
            array = np.array(values, dtype=np.float64)
        except (TypeError, ValueError):
            raise WorkbenchError(
                "values: got entries that are no numbers, or rows of different lengths, "
                "want a table of numbers (workbench.load_space reads files with text columns)"
            ) from None
        if array.ndim != 2 or len(array) < MIN_SAMPLES or array.shape[1] < 1:
            raise WorkbenchError(
                f"values: got shape {array.shape}, want at least {MIN_SAMPLES} rows "
                "and 1 column of numbers"
            )
        finite(array, "values")
        if standardize:
            # By the range: the mean of equal numbers may differ from them by rounding.
            varies = np.ptp(array, axis=0) > 0
            spread = np.where(varies, array.std(axis=0), 1.0)
            array = np.where(varies, (array - array.mean(axis=0)) / spread, 0.0)
        self.samples = array
        self.name = name
        self.standardized = standardize
        if columns is None:
            columns = [f"x{i}" for i in range(array.shape[1])]
        self.columns = tuple(columns)
        self.labels = None if labels is None else np.asarray(labels)
        self.notes = tuple(notes)
        if len(self.columns) != array.shape[1]:
            raise WorkbenchError(f"columns: got {len(self.columns)} names, want {array.shape[1]}")
        if self.labels is not None and self.labels.shape != (len(array),):
            raise WorkbenchError(f"labels: got shape {self.labels.shape}, want ({len(array)},)")

    @property
    def features(self) -> NDArray[np.float64]:
        """The table's numbers: (n_samples, n_features)."""
        return self.samples

    @cached_property
    def distances(self) -> NDArray[np.float64]:
        """Euclidean distances between all rows: (n_samples, n_samples)."""
        from scipy.spatial.distance import pdist, squareform

        self._require_memory_for_distances()
        return squareform(pdist(self.samples))

    def pair_distances(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """Measure the Euclidean distances between pairs of rows."""
        return np.linalg.norm(self.samples[_index(first)] - self.samples[_index(second)], axis=1)

    def cross_distances(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """Measure the Euclidean distances between rows of two tables."""
        from scipy.spatial.distance import cdist

        return cdist(np.asarray(first, dtype=np.float64), np.asarray(second, dtype=np.float64))

    def subset(self, indices: ArrayLike) -> VectorSpace:
        """Make a table of some of the rows; standardised columns stay as they are."""
        rows = control_point_indices(indices, len(self), at_least=MIN_SAMPLES, name="indices")
        return VectorSpace(
            self.samples[rows],
            columns=self.columns,
            labels=None if self.labels is None else self.labels[rows],
            name=self.name,
            notes=self.notes,
        )

    def errors(self, indices: ArrayLike, reconstructions: ArrayLike) -> NDArray[np.float64]:
        """Measure the Euclidean distances between rows and their reconstructions."""
        originals, rebuilt = self.matched(indices, reconstructions)
        return finite(np.linalg.norm(originals - rebuilt, axis=1), "errors of reconstructions")

    def error_table(self, indices: ArrayLike, reconstructions: ArrayLike) -> NDArray[np.float64]:
        """Measure Euclidean distances: (n_indices, n_reconstructions)."""
        errors = self.cross_distances(self.samples[_index(indices)], reconstructions)
        return finite(errors, "errors of reconstructions")

    def error_derivatives(
        self, indices: ArrayLike, reconstructions: ArrayLike, jacobians: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Measure Euclidean distances to rows, and their derivatives."""
        originals, rebuilt = self.matched(indices, reconstructions)
        difference = rebuilt - originals
        errors = finite(np.linalg.norm(difference, axis=1), "errors of reconstructions")
        per_error = np.divide(1.0, errors, out=np.zeros_like(errors), where=errors > 0)
        gradients = np.einsum("nf,nfd,n->nd", difference, jacobians, per_error)
        curvatures = np.swapaxes(jacobians, 1, 2) @ jacobians
        curvatures -= gradients[:, :, None] * gradients[:, None, :]
        return errors, gradients, curvatures * per_error[:, None, None]

    @cached_property
    def neighbors(self) -> NDArray[np.intp]:
        """The two nearest other rows of each row: (n_samples, 2).

        Rows have no order in time, so these take the place of the previous and the next
        frame (Costa 2018, section 5.2).
        """
        from sklearn.neighbors import NearestNeighbors

        return NearestNeighbors(n_neighbors=2).fit(self.samples).kneighbors(return_distance=False)

    def mean_prediction_error(self) -> float:
        """Mean Euclidean distance between the rows and their mean."""
        return float(np.linalg.norm(self.samples - self.samples.mean(axis=0), axis=1).mean())


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
            self.samples[_index(first)], self.samples[_index(second)], self.weights
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
        distances = self.cross_distances(self.samples[_index(indices)], reconstructions)
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
            self.positions[_index(first)],
            self.positions[_index(second)],
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


def check_space(space: Any) -> None:
    """Refuse what is no space of samples.

    Raises
    ------
    WorkbenchError
        If it is not; the message says how to make one.
    """
    if not isinstance(space, Space):
        raise WorkbenchError(
            f"space: got {type(space).__name__}, want a VectorSpace or a PoseSpace, "
            "as workbench.load_space gives them"
        )


def _index(indices: ArrayLike) -> NDArray[np.intp]:
    """Take indices of samples, refusing fractions, which numpy would cut off."""
    array = np.asarray(indices)
    if array.size and array.dtype.kind not in "iu":
        raise WorkbenchError(f"indices: got {array.dtype}, want whole numbers")
    return array.astype(np.intp)
