"""Back-projection to poses: spatial keyframes, and any method for vectors."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator
from sklearn.utils.validation import check_is_fitted

from workbench.backprojection.rbf import RBF
from workbench.errors import WorkbenchError
from workbench.mocap.nearest_rotation import nearest_rotations
from workbench.registry import fresh_copy


class PoseBackProjector(BaseEstimator):
    """Rebuild poses with a method that rebuilds vectors.

    The nine matrix entries of every joint are rebuilt as numbers; what comes out is no
    rotation any more, so each matrix is replaced by the nearest one.

    Parameters
    ----------
    regressor : back-projector for vectors
        For instance ``RBF()`` or any scikit-learn regressor for several outputs.

    Attributes
    ----------
    regressor_ : back-projector for vectors
        The fitted method.
    n_joints_ : int
        Joints of the poses.
    """

    def __init__(self, regressor: Any) -> None:
        self.regressor = regressor

    def fit(self, points: ArrayLike, rotations: ArrayLike) -> PoseBackProjector:
        """Learn the poses at the key positions.

        Parameters
        ----------
        points : array-like of shape (n_keys, n_dimensions)
            Positions of the markers.
        rotations : array-like of shape (n_keys, n_joints, 3, 3)
            Their poses.

        Returns
        -------
        PoseBackProjector
            Itself.

        Raises
        ------
        WorkbenchError
            If the poses are not rotation matrices of that shape.
        """
        poses = np.asarray(rotations, dtype=np.float64)
        if poses.ndim != 4 or poses.shape[2:] != (3, 3) or len(poses) != len(np.asarray(points)):
            raise WorkbenchError(
                f"rotations: got shape {poses.shape}, "
                f"want ({len(np.asarray(points))}, n_joints, 3, 3)"
            )
        self.n_joints_ = poses.shape[1]
        self.regressor_ = fresh_copy(self.regressor).fit(points, poses.reshape(len(poses), -1))
        return self

    def predict(self, points: ArrayLike) -> NDArray[np.float64]:
        """Rebuild the poses at positions of the embedding.

        Parameters
        ----------
        points : array-like of shape (n_points, n_dimensions)
            Positions.

        Returns
        -------
        ndarray of shape (n_points, n_joints, 3, 3)
        """
        check_is_fitted(self)
        entries = np.asarray(self.regressor_.predict(points))
        return nearest_rotations(entries.reshape(len(entries), self.n_joints_, 3, 3))


class SpatialKeyframes(PoseBackProjector):
    """Rebuild poses from spatial keyframes.

    Radial basis functions interpolate the matrix entries between the markers, and the
    nearest rotation is taken (Igarashi et al. 2005; Costa 2018, Eq. 2.1-2.3 and
    section 3.1). A marker gives back its own pose.

    Examples
    --------
    >>> from workbench.mocap.rotations import axis_rotation
    >>> points = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    >>> poses = axis_rotation("Z", [0.0, 90.0, 0.0])[:, None]
    >>> middle = SpatialKeyframes().fit(points, poses).predict([[0.5, 0.0]])
    >>> bool(np.allclose(middle[0, 0], axis_rotation("Z", 45.0)))
    True
    """

    def __init__(self) -> None:
        super().__init__(RBF())
