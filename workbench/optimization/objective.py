"""What an optimizer lowers, and what it returns."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.backprojection import BackProjector
from workbench.errors import WorkbenchError
from workbench.spaces import Space
from workbench.validation import finite

#: Called with (iteration, mean error, embedding) after each iteration; a true result stops.
Callback = Callable[[int, float, NDArray[np.float64]], bool | None]

#: Error measure: (indices of samples, their reconstructions) to one error for each.
ErrorFunction = Callable[[NDArray[np.intp], NDArray[np.float64]], NDArray[np.float64]]

#: Points rebuilt at once, which bounds the memory of their samples.
_BLOCK = 4096

#: Points differentiated at once: their Jacobians take as many times more as there are axes.
_DIFFERENTIATED = 1024


@dataclass(frozen=True)
class Effort:
    """What a search has cost so far.

    Attributes
    ----------
    evaluations : int
        Points back-projected.
    jacobians : int
        Points at which the back-projection was differentiated too; by finite differences
        each would cost as many evaluations as the embedding has dimensions.
    distances : int
        Errors measured, each between a sample and a reconstruction.
    """

    evaluations: int = 0
    jacobians: int = 0
    distances: int = 0

    def __add__(self, other: Effort) -> Effort:
        return Effort(
            self.evaluations + other.evaluations,
            self.jacobians + other.jacobians,
            self.distances + other.distances,
        )

    def __sub__(self, earlier: Effort) -> Effort:
        return Effort(
            self.evaluations - earlier.evaluations,
            self.jacobians - earlier.jacobians,
            self.distances - earlier.distances,
        )


class Objective:
    """The back-projection error of samples at given positions.

    Parameters
    ----------
    back_projector : back-projector
        Fitted on the control points.
    errors : callable
        ``errors(indices, reconstructions)`` gives one error for each reconstruction, for
        instance :meth:`workbench.spaces.Space.errors`.
    space : Space, optional
        Where the errors come from, see :meth:`of`; it knows their derivatives.

    Attributes
    ----------
    effort : Effort
        What was computed so far.
    stage : str
        What the search tries next, in a word, for those who watch it
        (:mod:`workbench.optimization.recording`); the values do not depend on it.
    """

    def __init__(
        self, back_projector: BackProjector, errors: ErrorFunction, space: Space | None = None
    ) -> None:
        self._back_projector: Any = back_projector
        self._errors = errors
        self._space = space
        self.effort = Effort()
        self.stage = ""

    @classmethod
    def of(cls, space: Space, back_projector: BackProjector) -> Objective:
        """Make the objective of a space's own error."""
        return cls(back_projector, space.errors, space)

    @property
    def evaluations(self) -> int:
        """Points back-projected so far."""
        return self.effort.evaluations

    @property
    def has_derivatives(self) -> bool:
        """Whether :meth:`derivatives` can be had: of the back-projector and of the error."""
        return self._space is not None and any(
            hasattr(self._back_projector, name) for name in ("predict_with_jacobian", "jacobian")
        )

    def __call__(self, points: NDArray[np.float64], indices: ArrayLike) -> NDArray[np.float64]:
        """Evaluate the errors of samples placed at points.

        Parameters
        ----------
        points : ndarray of shape (n_points, n_dimensions)
            Positions.
        indices : array-like of shape (n_points,)
            The sample that each position is tried for.

        Returns
        -------
        ndarray of shape (n_points,)

        Raises
        ------
        WorkbenchError
            If the back-projector or the error measure gives values that are not finite, or
            of another shape.
        """
        self.effort += Effort(evaluations=len(points), distances=len(points))
        indices = np.asarray(indices)
        errors = np.empty(len(points))
        for block in _blocks(len(points), _BLOCK):
            rebuilt = self._back_projector.predict(points[block])
            errors[block] = self._measured(indices[block], rebuilt)
        return errors

    def derivatives(
        self, points: NDArray[np.float64], indices: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Evaluate errors with their gradients and curvatures by position.

        Parameters
        ----------
        points, indices
            As for a call.

        Returns
        -------
        errors : ndarray of shape (n_points,)
        gradients : ndarray of shape (n_points, n_dimensions)
        curvatures : ndarray of shape (n_points, n_dimensions, n_dimensions)
            See :meth:`workbench.spaces.Space.error_derivatives`.

        Raises
        ------
        WorkbenchError
            If the back-projector gives values that are not finite, or of another shape.
        """
        assert self._space is not None
        n, dimensions = points.shape
        self.effort += Effort(evaluations=n, jacobians=n, distances=n)
        indices = np.asarray(indices)
        errors = np.empty(n)
        gradients = np.empty((n, dimensions))
        curvatures = np.empty((n, dimensions, dimensions))
        for block in _blocks(n, _DIFFERENTIATED):
            rebuilt, jacobians = self._differentiated(points[block])
            errors[block], gradients[block], curvatures[block] = self._space.error_derivatives(
                indices[block], rebuilt, jacobians
            )
        finite(gradients, "gradients of errors")
        return errors, gradients, curvatures

    def back_project(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Rebuild one sample at each point, to be compared with several samples.

        Parameters
        ----------
        points : ndarray of shape (n_points, n_dimensions)
            Positions.

        Returns
        -------
        ndarray of shape (n_points, ...)
        """
        self.effort += Effort(evaluations=len(points))
        rebuilt: NDArray[np.float64] = self._back_projector.predict(points)
        return rebuilt

    def table(
        self,
        indices: NDArray[np.intp],
        reconstructions: NDArray[np.float64],
        points: NDArray[np.float64] | None = None,  # noqa: ARG002 - for objectives that record
    ) -> NDArray[np.float64]:
        """Evaluate the error of every reconstruction as one of every given sample.

        Parameters
        ----------
        indices : ndarray of shape (n_indices,)
            Samples.
        reconstructions : ndarray of shape (n_reconstructions, ...)
            As :meth:`back_project` gives them.
        points : ndarray of shape (n_reconstructions, n_dimensions), optional
            Where they were rebuilt, for those who watch.

        Returns
        -------
        ndarray of shape (n_indices, n_reconstructions)

        Raises
        ------
        WorkbenchError
            As for a call.
        """
        n = len(reconstructions)
        self.effort += Effort(distances=len(indices) * n)
        if self._space is not None:
            return self._space.error_table(indices, reconstructions)
        rows = [self._measured(np.full(n, index), reconstructions) for index in indices]
        return np.array(rows).reshape(len(indices), n)

    def _measured(
        self, indices: NDArray[np.intp], rebuilt: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Measure errors by a function that may be the user's own, and check them."""
        errors = np.asarray(self._errors(indices, rebuilt), dtype=np.float64)
        if errors.shape != indices.shape:
            raise WorkbenchError(
                f"errors: got shape {errors.shape} for {len(indices)} reconstructions, "
                "want one error for each"
            )
        return finite(errors, "errors of reconstructions")

    def _differentiated(
        self, points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Rebuild samples with their derivatives, at once where the back-projector does that."""
        method = self._back_projector
        if hasattr(method, "predict_with_jacobian"):
            rebuilt, jacobians = method.predict_with_jacobian(points)
        else:
            rebuilt, jacobians = method.predict(points), method.jacobian(points)
        wanted = (*np.shape(rebuilt), points.shape[1])
        if np.shape(jacobians) != wanted:
            raise WorkbenchError(
                f"jacobian of the back-projector: got shape {np.shape(jacobians)}, want {wanted}"
            )
        return rebuilt, jacobians


@dataclass(frozen=True)
class OptimizationResult:
    """A better embedding and how it was found.

    Attributes
    ----------
    embedding : ndarray of shape (n_samples, n_dimensions)
        Positions; those of control points are as they were.
    errors : ndarray of shape (n_free,)
        Error of each free sample there.
    history : ndarray of shape (n_iterations + 1,)
        Mean error over the free samples, at the start and after each iteration.
    evaluations : int
        Points back-projected.
    reason : str
        Why the search ended.
    effort : Effort or None
        What else was computed, where the optimizer tells.
    """

    embedding: NDArray[np.float64]
    errors: NDArray[np.float64]
    history: NDArray[np.float64]
    evaluations: int
    reason: str
    effort: Effort | None = None

    @property
    def iterations(self) -> int:
        """Number of iterations that were run."""
        return len(self.history) - 1


def _blocks(n: int, size: int) -> Iterator[slice]:
    """Cut a range into slices."""
    return (slice(start, start + size) for start in range(0, n, size))
