"""Schemes: named compositions of the pipeline's steps, run on a space.

    samples → select → project → optimize → back-project → measure

A temporal scheme has time in place of the embedding. The command line, the notebooks and
the dashboards run these two classes and nothing else.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection import BackProjector, back_projector_for
from workbench.errors import WorkbenchError
from workbench.interpolation import Interpolator, interpolators
from workbench.optimization import optimizers
from workbench.optimization.objective import Callback, Objective, OptimizationResult
from workbench.projection import project
from workbench.quality.summary import EmbeddingQuality, embedding_quality
from workbench.selection import Selector, selectors
from workbench.spaces import PoseSpace, Space
from workbench.validation import as_embedding, control_point_count, control_point_indices


@dataclass
class Timings:
    """Seconds spent on each step, in the order of the steps."""

    steps: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def step(self, name: str) -> Iterator[None]:
        """Add the time of a ``with`` block to a step."""
        start = time.perf_counter()
        try:
            yield
        finally:
            self.steps[name] = self.steps.get(name, 0.0) + time.perf_counter() - start

    @property
    def total(self) -> float:
        """Seconds spent on all steps."""
        return sum(self.steps.values())


@dataclass(frozen=True, eq=False)
class Result:
    """What a scheme made of a space.

    Attributes
    ----------
    space : Space
        The samples.
    control_points : ndarray of shape (n_control_points,)
        Indices of the samples that are kept as they are.
    reconstruction : ndarray of shape (n_samples, ...)
        All samples rebuilt, the control points exactly.
    timings : Timings
        Seconds of each step.
    """

    space: Space
    control_points: NDArray[np.intp]
    reconstruction: NDArray[np.float64]
    timings: Timings

    @cached_property
    def errors(self) -> NDArray[np.float64]:
        """Error of each sample, 0 for control points: (n_samples,)."""
        return self.space.errors(np.arange(len(self.space)), self.reconstruction)

    @property
    def error(self) -> float:
        """Mean error over all samples; for poses, the error per frame per joint."""
        return float(self.errors.mean())

    @property
    def relative_error(self) -> float:
        """Mean error relative to rebuilding every sample by the mean."""
        return self.error / self.space.mean_prediction_error()


@dataclass(frozen=True, eq=False)
class SpatialResult(Result):
    """What a spatial scheme made of a space.

    Attributes
    ----------
    projected : ndarray of shape (n_samples, n_dimensions)
        The embedding as projected, scaled to the unit square.
    embedding : ndarray of shape (n_samples, n_dimensions)
        The embedding used for the reconstruction: optimized, if there is an optimizer.
    back_projector : back-projector
        Fitted on the control points.
    optimization : OptimizationResult or None
        How the optimizer got there.
    evaluations : int
        Points back-projected, by the optimizer and for the reconstruction.
    """

    projected: NDArray[np.float64]
    embedding: NDArray[np.float64]
    back_projector: BackProjector
    optimization: OptimizationResult | None
    evaluations: int

    @cached_property
    def quality(self) -> EmbeddingQuality:
        """Quality of the embedding."""
        return embedding_quality(self.space.distances, self.embedding)

    @cached_property
    def projected_quality(self) -> EmbeddingQuality:
        """Quality of the embedding before it was optimized."""
        return embedding_quality(self.space.distances, self.projected)


def choose_control_points(
    space: Space,
    selector: str | Selector,
    *,
    count: int | None = None,
    ratio: float | None = None,
    random_state: int | None = None,
) -> NDArray[np.intp]:
    """Select control points by name or with a selector object.

    Parameters
    ----------
    space : Space
        The samples.
    selector : str or selector
        A registered name, or an object with ``select(space, count)``.
    count, ratio : int or float, exactly one
        How many, or which share: max(3, floor(ratio · n_samples)).
    random_state : int, optional
        Seed for a selector that takes one.

    Returns
    -------
    ndarray of shape (n_control_points,)
        Sorted indices.

    Raises
    ------
    WorkbenchError
        If the name, the count or the ratio is not valid.
    """
    wanted = control_point_count(len(space), count=count, ratio=ratio)
    chosen: Selector = (
        _create_seeded(selectors.factory(selector), random_state)
        if isinstance(selector, str)
        else selector
    )
    return control_point_indices(chosen.select(space, wanted), len(space))


@dataclass(frozen=True)
class TemporalScheme:
    """Keep keyframes and interpolate between them in time.

    Parameters
    ----------
    interpolator : str or interpolator
        A registered name or an object with ``interpolate(motion, keyframes)``.
    selector : str or selector
        A registered name or an object with ``select(space, count)``.
    """

    interpolator: str | Interpolator = "slerp"
    selector: str | Selector = "uniform"

    def run(
        self,
        space: Space,
        *,
        count: int | None = None,
        ratio: float | None = None,
        random_state: int | None = None,
    ) -> Result:
        """Select keyframes and rebuild the frames between them.

        Parameters
        ----------
        space : PoseSpace
            The motion; tables have no time.
        count, ratio : int or float, exactly one
            How many keyframes, or which share.
        random_state : int, optional
            Seed of the selector, where it takes one.

        Returns
        -------
        Result

        Raises
        ------
        WorkbenchError
            If the space is no motion or an argument is not valid.
        """
        if not isinstance(space, PoseSpace):
            raise WorkbenchError(
                f"data: got the table {space.name!r}, want a motion: a table has no time to "
                "interpolate in"
            )
        timings = Timings()
        with timings.step("select"):
            keys = choose_control_points(
                space, self.selector, count=count, ratio=ratio, random_state=random_state
            )
        interpolator = self.interpolator
        if isinstance(interpolator, str):
            interpolator = interpolators.create(interpolator)
        with timings.step("interpolate"):
            rebuilt = np.array(interpolator.interpolate(space.motion, keys))
        rebuilt[keys] = space.samples[keys]
        return Result(space, keys, rebuilt, timings)


@dataclass(frozen=True)
class SpatialScheme:
    """Keep control points and rebuild all other samples from positions in an embedding.

    Parameters
    ----------
    projector : str or scikit-learn transformer
        A registered name or an estimator.
    selector : str, selector or None
        A registered name or an object with ``select(space, count)``; by default uniform
        for motions and random for tables, whose rows have no order in time.
    back_projector : str, back-projector or None
        A registered name or an estimator; by default spatial keyframes for motions and RBF
        for tables.
    optimizer : str, optimizer or None
        A registered name or an object with ``optimize``; None leaves the projection as it is.
    """

    projector: Any = "tsne"
    selector: str | Selector | None = None
    back_projector: str | BackProjector | None = None
    optimizer: Any = None

    def run(
        self,
        space: Space,
        *,
        count: int | None = None,
        ratio: float | None = None,
        random_state: int | None = None,
        projected: NDArray[np.float64] | None = None,
        callback: Callback | None = None,
    ) -> SpatialResult:
        """Run the whole pipeline on a space.

        Parameters
        ----------
        space : Space
            The samples.
        count, ratio : int or float, exactly one
            How many control points, or which share.
        random_state : int, optional
            Seed of the selector and the projector, where they take one.
        projected : ndarray of shape (n_samples, n_dimensions), optional
            A projection of the space that is there already, to spare its computation when
            several schemes share it.
        callback : callable, optional
            ``callback(iteration, error, embedding)`` of the optimizer; a true result stops it.

        Returns
        -------
        SpatialResult

        Raises
        ------
        WorkbenchError
            If a name or an argument is not valid.
        """
        timings = Timings()
        selector = self.selector
        if selector is None:
            selector = "uniform" if isinstance(space, PoseSpace) else "random"
        with timings.step("select"):
            control = choose_control_points(
                space, selector, count=count, ratio=ratio, random_state=random_state
            )
        if projected is None:
            with timings.step("project"):
                projected = project(space, self.projector, random_state=random_state)
        else:
            projected = as_embedding(projected, "projected", len(space))

        free = np.setdiff1d(np.arange(len(space)), control)
        back_projector = back_projector_for(space, self.back_projector)
        optimization, embedding = None, projected
        with timings.step("fit"):
            back_projector.fit(projected[control], space.samples[control])
        if self.optimizer is not None:
            optimizer = self.optimizer
            if isinstance(optimizer, str):
                optimizer = _create_seeded(optimizers.factory(optimizer), random_state)
            with timings.step("optimize"):
                optimization = optimizer.optimize(
                    Objective(back_projector, space.errors),
                    projected,
                    free,
                    space.neighbors,
                    callback=callback,
                )
            embedding = optimization.embedding
        with timings.step("back-project"):
            rebuilt = space.samples.copy()
            rebuilt[free] = back_projector.predict(embedding[free])
        return SpatialResult(
            space=space,
            control_points=control,
            reconstruction=rebuilt,
            timings=timings,
            projected=projected,
            embedding=embedding,
            back_projector=back_projector,
            optimization=optimization,
            evaluations=len(free) + (optimization.evaluations if optimization else 0),
        )


def _create_seeded(factory: Any, random_state: int | None) -> Any:
    """Build a method, passing the seed on if it takes one."""
    from inspect import signature

    if "random_state" in signature(factory).parameters:
        return factory(random_state=random_state)
    return factory()
