"""Execute runs on one space, computing what they share only once."""

from __future__ import annotations

import time
import warnings
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.experiments.runs import Run, scheme_name
from workbench.experiments.store import Arrays, Row
from workbench.experiments.versions import versions
from workbench.optimization.objective import Effort
from workbench.projection import project
from workbench.quality.summary import EmbeddingQuality, embedding_quality
from workbench.results import Result, SpatialResult
from workbench.schemes import SpatialScheme
from workbench.spaces import Space

#: Stress up to which an embedding is perfect: a plane, projected by PCA, has about 1e-15.
_NO_STRESS = 1e-12


@dataclass(frozen=True)
class Projection:
    """A projection that several runs start from.

    Attributes
    ----------
    embedding : ndarray of shape (n_samples, n_components)
        Scaled to the unit square.
    quality : EmbeddingQuality
        Its quality, before any optimization.
    seconds : float
        Time taken to project, without that of the distance matrix.
    warnings : tuple of str
        What the projector warned of.
    """

    embedding: NDArray[np.float64]
    quality: EmbeddingQuality
    seconds: float
    warnings: tuple[str, ...]


class SharedSteps:
    """Distances and projections, computed once for all runs on a space.

    Raw and optimized schemes start from the same projection, so their results differ by the
    optimizer alone.

    Parameters
    ----------
    space : Space
        The samples.
    """

    def __init__(self, space: Space) -> None:
        self.space = space
        self._distance_seconds: float | None = None
        self._projections: dict[tuple[str, int, int | None], Projection] = {}

    def distance_seconds(self) -> float:
        """Compute the distance matrix, which the space keeps, and tell how long it took."""
        if self._distance_seconds is None:
            start = time.perf_counter()
            _ = self.space.distances
            self._distance_seconds = time.perf_counter() - start
        return self._distance_seconds

    def projection(self, projector: str, seed: int, dimensions: int | None = None) -> Projection:
        """Project the space in one step, or give the projection that is there already."""
        key = (projector, seed, dimensions)
        if key not in self._projections:
            with warnings.catch_warnings(record=True) as caught:
                start = time.perf_counter()
                embedding = project(self.space, projector, dimensions=dimensions, random_state=seed)
                seconds = time.perf_counter() - start
            self._projections[key] = Projection(
                embedding,
                embedding_quality(self.space.distances, embedding),
                seconds,
                _messages(caught),
            )
        return self._projections[key]


def execute(run: Run, shared: SharedSteps) -> tuple[Row, Arrays]:
    """Execute one run.

    Parameters
    ----------
    run : Run
        What to run; its data set is the one of ``shared``.
    shared : SharedSteps
        The space and what is known of it already.

    Returns
    -------
    row : dict
        Names of the methods, ``error`` and ``relative_error``, for spatial schemes also
        the quality of the embedding (``stress``, …), of the projection before optimization
        (``projected_stress``, …) and their ratios, ``evaluations`` (points back-projected,
        for the reconstruction too), ``jacobians`` and ``distances`` (of the optimizer and the
        search for markers; None if one does not tell); ``warnings``; ``seconds_…`` of each
        step; versions.
    arrays : dict of str to ndarray
        ``errors`` (n_samples,), ``control_points`` (n_control_points,) and, for spatial
        schemes, ``projected`` and ``embedding`` (n_samples, n_components).
    """
    amount: dict[str, Any] = {"ratio": run.ratio, "count": run.count, "random_state": run.seed}
    seconds: dict[str, float] = {}
    projection: Projection | None = None
    result: Result
    with warnings.catch_warnings(record=True) as caught:
        if isinstance(run.scheme, SpatialScheme):
            seconds["distances"] = shared.distance_seconds()
            if _starts_from_shared_projection(run.scheme):
                projection = shared.projection(
                    run.scheme.projector, run.seed, run.scheme.dimensions
                )
                seconds["project"] = projection.seconds
                result = run.scheme.run(shared.space, projected=projection.embedding, **amount)
            else:
                result = run.scheme.run(shared.space, **amount)
        else:
            result = run.scheme.run(shared.space, **amount)
    said = [*(projection.warnings if projection else ()), *_messages(caught)]
    seconds.update(result.timings.steps)
    row: Row = {
        **run.specification(),
        "scheme": scheme_name(run.scheme),
        "n_samples": len(result.space),
        "n_control_points": len(result.control_points),
        "error": result.error,
        "relative_error": result.relative_error,
        "warnings": "; ".join(said),
    }
    arrays: Arrays = {"errors": result.errors, "control_points": result.control_points}
    if isinstance(result, SpatialResult):
        before = result.projected_quality if projection is None else projection.quality
        row.update(_spatial_values(result, before))
        arrays.update(projected=result.projected, embedding=result.embedding)
    row.update({f"seconds_{step.replace('-', '_')}": value for step, value in seconds.items()})
    row["seconds_total"] = sum(seconds.values())
    row.update({f"version_{name}": value for name, value in versions().items()})
    return row, arrays


def _starts_from_shared_projection(scheme: SpatialScheme) -> bool:
    """Tell whether a projection of all samples is all that a scheme needs to start.

    Two steps start from the control points, whose number and choice differ between runs, and
    a projector's own inverse needs the projector, not only where it put the samples.
    """
    return scheme.two_step is None and scheme.back_projector != "inverse"


def _messages(caught: list[warnings.WarningMessage]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(str(warning.message) for warning in caught))


def _spatial_values(result: SpatialResult, before: EmbeddingQuality) -> Row:
    after = before if result.embedding is result.projected else result.quality
    effort = _effort(result)
    return {
        **asdict(after),
        **{f"projected_{name}": value for name, value in asdict(before).items() if name != "k"},
        "stress_ratio": _ratio(after.stress, before.stress),
        "scale_normalized_stress_ratio": _ratio(
            after.scale_normalized_stress, before.scale_normalized_stress
        ),
        "evaluations": result.evaluations,
        "jacobians": effort.jacobians if effort else None,
        "distances": effort.distances if effort else None,
        "iterations": result.optimization.iterations if result.optimization else 0,
    }


def _effort(result: SpatialResult) -> Effort | None:
    """Add up what the searches computed; None where an optimizer does not tell."""
    effort = Effort()
    for search in (result.optimization, result.marker_result):
        if search is not None:
            if search.effort is None:
                return None
            effort += search.effort
    return effort


def _ratio(after: float, before: float) -> float | None:
    """Divide two stresses; None where there was no stress but noise of rounding."""
    return after / before if before > _NO_STRESS else None
