"""Back-projection to poses: spatial keyframes, and any method for vectors."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator
from sklearn.utils.metaestimators import available_if
from sklearn.utils.validation import check_is_fitted

from workbench.backprojection.rbf import RBF
from workbench.errors import WorkbenchError
from workbench.mocap.nearest_rotation import nearest_rotations
from workbench.mocap.nearest_rotation_derivative import nearest_rotations_with_derivatives
from workbench.registry import fresh_copy
from workbench.validation import finite


def _if_regressor_has(name: str) -> Callable[[PoseBackProjector], bool]:
    """Make a method exist only where the method for vectors has it."""
    return lambda self: hasattr(getattr(self, "regressor_", self._template()), name)


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

    def _template(self) -> Any:
        """Give the method for vectors, unfitted."""
        return self.regressor

    @available_if(_if_regressor_has("use_projection"))
    def use_projection(self, projection: Any) -> None:
        """Pass the projection on to a method that needs it, such as the projector's inverse.

        Parameters
        ----------
        projection : Projection or None
            As :class:`~workbench.backprojection.inverse.ProjectorInverse` takes it.
        """
        self._projection = projection

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
            If the poses are not finite matrices of that shape.
        """
        poses = np.asarray(rotations, dtype=np.float64)
        n_keys = len(np.asarray(points))
        if poses.ndim != 4 or poses.shape[2:] != (3, 3) or not 0 < len(poses) == n_keys:
            raise WorkbenchError(
                f"rotations: got shape {poses.shape}, "
                f"want ({n_keys or 'n_keys'}, n_joints, 3, 3), at least one"
            )
        finite(poses, "rotations")
        regressor = fresh_copy(self._template())
        if hasattr(regressor, "use_projection"):
            regressor.use_projection(getattr(self, "_projection", None))
        self.n_joints_ = poses.shape[1]
        self.regressor_ = regressor.fit(points, poses.reshape(len(poses), -1))
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
        matrices = self._matrices(self.regressor_.predict(points))
        return nearest_rotations(matrices, overwrite=self._owns_results())

    @available_if(_if_regressor_has("predict_with_jacobian"))
    def jacobian(self, points: ArrayLike) -> NDArray[np.float64]:
        """Differentiate the rebuilt rotation matrices by the position.

        The derivative of the nearest rotation follows that of the matrix entries; where
        the nearest rotation is not unique it is 0.

        Parameters
        ----------
        points : array-like of shape (n_points, n_dimensions)
            Positions.

        Returns
        -------
        ndarray of shape (n_points, n_joints, 3, 3, n_dimensions)
            A view, in memory one dimension of the embedding after the other:
            ``np.moveaxis(jacobian, -1, 1)`` is contiguous.
        """
        return self.predict_with_jacobian(points)[1]

    @available_if(_if_regressor_has("predict_with_jacobian"))
    def predict_with_jacobian(
        self, points: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Rebuild the poses and differentiate them by the position.

        Parameters
        ----------
        points : array-like of shape (n_points, n_dimensions)
            Positions.

        Returns
        -------
        rotations : ndarray of shape (n_points, n_joints, 3, 3)
            As :meth:`predict` gives them.
        jacobian : ndarray of shape (n_points, n_joints, 3, 3, n_dimensions)
            As :meth:`jacobian` gives it.
        """
        check_is_fitted(self)
        values, jacobian = self.regressor_.predict_with_jacobian(points)
        matrices = self._matrices(values)
        changes = np.swapaxes(np.asarray(jacobian, dtype=np.float64), 1, 2)
        rotations, changes = nearest_rotations_with_derivatives(
            matrices,
            changes.reshape(*changes.shape[:2], self.n_joints_, 3, 3),
            overwrite=self._owns_results(),
        )
        return rotations, np.moveaxis(changes, 1, -1)

    def _matrices(self, values: ArrayLike) -> NDArray[np.float64]:
        entries = np.asarray(values, dtype=np.float64)
        if entries.ndim != 2 or entries.shape[1] != 9 * self.n_joints_:
            raise WorkbenchError(
                f"{type(self.regressor_).__name__}: rebuilt numbers of shape {entries.shape}, "
                f"want (n_points, {9 * self.n_joints_}), nine for each of {self.n_joints_} joints"
            )
        return entries.reshape(len(entries), self.n_joints_, 3, 3)

    def _owns_results(self) -> bool:
        """Tell whether what the method returned is new memory, free to be overwritten."""
        return isinstance(self.regressor_, RBF)


class SpatialKeyframes(PoseBackProjector):
    """Rebuild poses from spatial keyframes.

    Radial basis functions interpolate the matrix entries between the markers, and the
    nearest rotation is taken (Igarashi et al. 2005; Costa 2018, Eq. 2.1-2.3 and
    section 3.1). A marker gives back its own pose.

    Poses may come with a translation of the root, interpolated alike (Costa 2018,
    section 2.4); :meth:`predict_root` rebuilds it. Authoring needs it; the back-projection
    error counts rotations only.

    Parameters
    ----------
    kernel, epsilon, smoothing, centers
        As for :class:`~workbench.backprojection.rbf.RBF`; by default the linear kernel
        through all poses.

    Attributes
    ----------
    regressor_ : RBF
        Of the matrix entries.
    root_regressor_ : RBF or None
        Of the root translations, where there were some.
    n_joints_ : int
        Joints of the poses.

    Examples
    --------
    >>> from workbench.mocap.rotations import axis_rotation
    >>> points = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    >>> poses = axis_rotation("Z", [0.0, 90.0, 0.0])[:, None]
    >>> model = SpatialKeyframes().fit(points, poses, root_translations=np.eye(3))
    >>> bool(np.allclose(model.predict([[0.5, 0.0]])[0, 0], axis_rotation("Z", 45.0)))
    True
    >>> model.predict_root([[0.5, 0.0]]).round(12)
    array([[0.5, 0.5, 0. ]])
    """

    root_regressor_: RBF | None

    def __init__(
        self,
        kernel: str = "linear",
        *,
        epsilon: float | None = None,
        smoothing: float = 0.0,
        centers: int | None = None,
    ) -> None:
        self.kernel = kernel
        self.epsilon = epsilon
        self.smoothing = smoothing
        self.centers = centers

    def _template(self) -> RBF:
        return RBF(
            self.kernel, epsilon=self.epsilon, smoothing=self.smoothing, centers=self.centers
        )

    def fit(
        self,
        points: ArrayLike,
        rotations: ArrayLike,
        root_translations: ArrayLike | None = None,
    ) -> SpatialKeyframes:
        """Learn the poses, and where the root is, at the markers.

        Parameters
        ----------
        points : array-like of shape (n_keys, n_dimensions)
            Positions of the markers.
        rotations : array-like of shape (n_keys, n_joints, 3, 3)
            Their poses.
        root_translations : array-like of shape (n_keys, 3), optional
            Their root translations, in file units.

        Returns
        -------
        SpatialKeyframes
            Itself.

        Raises
        ------
        WorkbenchError
            If poses or translations are not finite and of that shape.
        """
        roots = None
        if root_translations is not None:
            roots = np.asarray(root_translations, dtype=np.float64)
            if roots.shape != (len(np.asarray(rotations)), 3):
                raise WorkbenchError(
                    f"root_translations: got shape {roots.shape}, "
                    f"want ({len(np.asarray(rotations))}, 3)"
                )
            finite(roots, "root_translations")
        super().fit(points, rotations)
        self.root_regressor_ = None if roots is None else self._template().fit(points, roots)
        return self

    def predict_root(self, points: ArrayLike) -> NDArray[np.float64]:
        """Rebuild the root translations at positions of the embedding.

        Parameters
        ----------
        points : array-like of shape (n_points, n_dimensions)
            Positions.

        Returns
        -------
        ndarray of shape (n_points, 3)
            In file units.

        Raises
        ------
        WorkbenchError
            If none were learnt.
        """
        check_is_fitted(self)
        if self.root_regressor_ is None:
            raise WorkbenchError(
                "root translations: none were learnt, want fit(points, rotations, "
                "root_translations)"
            )
        return self.root_regressor_.predict(points)
