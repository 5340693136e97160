"""Schemes: named compositions of the pipeline's steps, run on a space.

    samples → select → project → optimize → back-project → measure

A temporal scheme has time in place of the embedding. The command line, the notebooks and
the dashboards run these two classes and nothing else.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from inspect import signature
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection import BackProjector, back_projector_for
from workbench.errors import WorkbenchError
from workbench.interpolation import Interpolator, interpolators
from workbench.optimization import optimizers
from workbench.optimization.markers import marker_searches
from workbench.optimization.objective import Callback, Objective
from workbench.projection import fit_projection, projectors
from workbench.projection.two_step import project_in_two_steps
from workbench.results import Result, SpatialResult, Timings
from workbench.selection import Selector, selectors
from workbench.spaces import PoseSpace, Space, check_space
from workbench.validation import as_embedding, control_point_count, control_point_indices


def choose_control_points(
    space: Space,
    selector: str | Selector,
    *,
    count: int | None = None,
    ratio: float | None = None,
    fixed: Iterable[int] = (),
    random_state: int | None = None,
) -> NDArray[np.intp]:
    """Select control points by name or with a selector object.

    Parameters
    ----------
    space : Space
        The samples.
    selector : str or selector
        A registered name, or an object with ``select(space, count)``.
    count, ratio : int or float, at most one
        How many, or which share: max(3, floor(ratio · n_samples)). Neither is for a selector
        that has a rule of its own for the number, such as ``saliency``.
    fixed : iterable of int
        Samples that must be among them.
    random_state : int, optional
        Seed for a selector that takes one.

    Returns
    -------
    ndarray of shape (n_control_points,)
        Sorted indices.

    Raises
    ------
    WorkbenchError
        If the name, the count, the ratio or a fixed sample is not valid.
    """
    check_space(space)
    built = selectors.build(selector, random_state)
    fixed = list(fixed)
    # A user's own selector may know nothing of fixed samples; it is asked only if there are any.
    options = {"fixed": fixed} if fixed else {}
    if fixed and "fixed" not in signature(built.select).parameters:
        raise WorkbenchError(f"fixed: selector {selector!r} cannot keep samples (no `fixed`)")
    if count is None and ratio is None and getattr(built, "chooses_count", False):
        return control_point_indices(built.select(space, None, **options), len(space), at_least=2)
    wanted = control_point_count(len(space), count=count, ratio=ratio)
    indices = control_point_indices(built.select(space, wanted, **options), len(space))
    if len(indices) != wanted:
        raise WorkbenchError(f"selector {selector!r}: gave {len(indices)} samples, want {wanted}")
    return indices


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
        fixed: Iterable[int] = (),
        random_state: int | None = None,
    ) -> Result:
        """Select keyframes and rebuild the frames between them.

        Parameters
        ----------
        space : PoseSpace
            The motion; tables have no time.
        count, ratio : int or float, exactly one
            How many keyframes, or which share; neither, for a selector with its own rule.
        fixed : iterable of int
            Frames that must be keyframes.
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
                space,
                self.selector,
                count=count,
                ratio=ratio,
                fixed=fixed,
                random_state=random_state,
            )
        interpolator = interpolators.build(self.interpolator, random_state)
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
    two_step : str, control-point projector or None
        A registered name such as ``"rbfp"``: the projector then places the control points
        only, and this method the rest around them. None projects all samples in one step.
    dimensions : int or None
        Dimensions of the embedding, 2 or 3; None for the projector's own, usually 2.
    markers : str, marker search or None
        ``"move"`` or ``"exchange"``: after the optimization the control points move too, or
        neighbouring samples take their place. None leaves them.
    """

    projector: Any = "tsne"
    selector: str | Selector | None = None
    back_projector: str | BackProjector | None = None
    optimizer: Any = None
    two_step: Any = None
    dimensions: int | None = None
    markers: Any = None

    def run(
        self,
        space: Space,
        *,
        count: int | None = None,
        ratio: float | None = None,
        fixed: Iterable[int] = (),
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
            How many control points, or which share; neither, for a selector with its own rule.
        fixed : iterable of int
            Samples that must be control points.
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
        check_space(space)
        selector = self.selector
        if selector is None:
            selector = "uniform" if isinstance(space, PoseSpace) else "random"
        # Methods are made before the clock starts: the first of a kind imports its package.
        projector = None
        if projected is None:
            projector = projectors.build(self.projector, random_state)
        back_projector = back_projector_for(space, self.back_projector, random_state=random_state)
        optimizer = None
        if self.optimizer is not None:
            optimizer = optimizers.build(self.optimizer, random_state)

        timings = Timings()
        with timings.step("select"):
            control = choose_control_points(
                space,
                selector,
                count=count,
                ratio=ratio,
                fixed=fixed,
                random_state=random_state,
            )
        projection = None
        if projected is not None:
            projected = as_embedding(projected, "projected", len(space))
        elif self.two_step is not None:
            with timings.step("project"):
                projected = project_in_two_steps(
                    space,
                    projector,
                    self.two_step,
                    control,
                    dimensions=self.dimensions,
                    random_state=random_state,
                )
        else:
            with timings.step("project"):
                projection = fit_projection(space, projector, dimensions=self.dimensions)
            projected = projection.embedding
        if hasattr(back_projector, "use_projection"):
            back_projector.use_projection(projection)
        free = np.setdiff1d(np.arange(len(space)), control)
        with timings.step("fit"):
            back_projector.fit(projected[control], space.samples[control])
        optimization, embedding = None, projected
        if optimizer is not None:
            objective = Objective.of(space, back_projector)
            with timings.step("optimize"):
                optimization = optimizer.optimize(
                    objective, projected, free, space.neighbors, callback=callback
                )
            embedding = optimization.embedding
        marker_result = None
        if self.markers is not None:
            search = marker_searches.build(self.markers, random_state)
            with timings.step("markers"):
                marker_result = search.search(space, back_projector, control, embedding)
            found = marker_result.markers
            control, free, embedding = found.control_points, found.free, found.embedding
            back_projector = found.back_projector
        with timings.step("back-project"):
            rebuilt = space.samples.copy()
            _, rebuilt[free] = space.matched(free, back_projector.predict(embedding[free]))
        return SpatialResult(
            space=space,
            control_points=control,
            reconstruction=rebuilt,
            timings=timings,
            projected=projected,
            embedding=embedding,
            back_projector=back_projector,
            optimization=optimization,
            marker_result=marker_result,
            evaluations=len(free)
            + (optimization.evaluations if optimization else 0)
            + (marker_result.effort.evaluations if marker_result else 0),
        )
