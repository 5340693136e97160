"""Runs of schemes: one scheme on one data set, at one number of control points."""

from __future__ import annotations

import warnings
from dataclasses import asdict, dataclass
from typing import Any

from workbench.errors import WorkbenchError
from workbench.experiments.runs.shared import Projection, SharedSteps, messages
from workbench.experiments.store import Arrays, Row
from workbench.optimization.objective import Effort
from workbench.quality.summary import EmbeddingQuality
from workbench.results import Result, SpatialResult
from workbench.schemes import SpatialScheme, TemporalScheme

Scheme = TemporalScheme | SpatialScheme

#: Stress up to which an embedding is perfect: a plane, projected by PCA, has about 1e-15.
_NO_STRESS = 1e-12


@dataclass(frozen=True)
class SchemeRun:
    """One scheme on one data set, at one number of control points, from one seed.

    Parameters
    ----------
    dataset : str
        Name that :func:`workbench.load_space` knows, or the path of a file.
    scheme : TemporalScheme or SpatialScheme
        Its methods are given by their registered names: an object could not be stored with
        the result, nor told apart from another when the result is looked up.
    ratio : float, optional
        Share of the samples that become control points, between 0 and 1.
    count : int, optional
        Their number, in place of a ratio.
    seed : int
        Seed of the selector, the projector and the optimizer, where they take one.
    standardize : bool
        Whether the columns of a table are brought to unit variance first.

    Raises
    ------
    WorkbenchError
        If a method is not a name, or not exactly one of ratio and count is given.

    Examples
    --------
    >>> print(SchemeRun("uci/iris", SpatialScheme("pca", optimizer="alg12"), ratio=0.03))
    uci/iris, pca + alg12, 3 %, seed 0
    """

    dataset: str
    scheme: Scheme
    ratio: float | None = None
    count: int | None = None
    seed: int = 0
    standardize: bool = False

    def __post_init__(self) -> None:
        if (self.ratio is None) == (self.count is None):
            raise WorkbenchError(f"run on {self.dataset!r}: want exactly one of ratio and count")
        for step, method in asdict(self.scheme).items():
            # The number of dimensions is no method.
            if step != "dimensions" and not (method is None or isinstance(method, str)):
                raise WorkbenchError(
                    f"{step} of a run: got {type(method).__name__}, want a registered name "
                    "(see workbench.register_projector and its like)"
                )

    def __str__(self) -> str:
        amount = f"{self.count} control points" if self.ratio is None else f"{self.ratio:.4g}"
        if self.ratio is not None:
            amount = f"{100 * self.ratio:.4g} %"
        scaling = ", standardized" if self.standardize else ""
        return f"{self.dataset}{scaling}, {scheme_name(self.scheme)}, {amount}, seed {self.seed}"

    def specification(self) -> dict[str, Any]:
        """Describe the run by plain values, as stored with its result."""
        return {
            "dataset": self.dataset,
            "kind": "temporal" if isinstance(self.scheme, TemporalScheme) else "spatial",
            **asdict(self.scheme),
            "scheme": scheme_name(self.scheme),
            "ratio": self.ratio,
            "count": self.count,
            "seed": self.seed,
            "standardize": self.standardize,
        }

    def execute(self, shared: SharedSteps) -> tuple[Row, Arrays]:
        """Execute the run.

        Parameters
        ----------
        shared : SharedSteps
            The space and what is known of it already.

        Returns
        -------
        row : dict
            ``error`` and ``relative_error``, for spatial schemes also the quality of the
            embedding (``stress``, …), of the projection before optimization
            (``projected_stress``, …) and their ratios, ``evaluations`` (points
            back-projected, for the reconstruction too), ``jacobians`` and ``distances`` (of
            the optimizer and the search for markers; None if one does not tell);
            ``warnings``; ``seconds_…`` of each step.
        arrays : dict of str to ndarray
            ``errors`` (n_samples,), ``control_points`` (n_control_points,) and, for spatial
            schemes, ``projected`` and ``embedding`` (n_samples, n_components).
        """
        amount: dict[str, Any] = {
            "ratio": self.ratio,
            "count": self.count,
            "random_state": self.seed,
        }
        seconds: dict[str, float] = {}
        projection: Projection | None = None
        result: Result
        with warnings.catch_warnings(record=True) as caught:
            if isinstance(self.scheme, SpatialScheme):
                seconds["distances"] = shared.distance_seconds()
                if _starts_from_shared_projection(self.scheme):
                    projection = shared.projection(
                        self.scheme.projector, self.seed, self.scheme.dimensions
                    )
                    seconds["project"] = projection.seconds
                    result = self.scheme.run(shared.space, projected=projection.embedding, **amount)
                else:
                    result = self.scheme.run(shared.space, **amount)
            else:
                result = self.scheme.run(shared.space, **amount)
        said = [*(projection.warnings if projection else ()), *messages(caught)]
        seconds.update(result.timings.steps)
        row: Row = {
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
        return row, arrays


def scheme_name(scheme: Scheme) -> str:
    """Name a scheme after its methods.

    Examples
    --------
    >>> scheme_name(SpatialScheme("tsne", selector="uniform", optimizer="alg12"))
    'tsne + alg12, uniform'
    """
    if isinstance(scheme, TemporalScheme):
        return f"{scheme.interpolator}, {scheme.selector}"
    parts = [f"{scheme.projector} + {scheme.optimizer}" if scheme.optimizer else scheme.projector]
    parts += [part for part in (scheme.two_step, scheme.selector, scheme.back_projector) if part]
    if scheme.dimensions is not None:
        parts.append(f"{scheme.dimensions}-D")
    if scheme.markers:
        parts.append(f"{scheme.markers} markers")
    return ", ".join(str(part) for part in parts)


def _starts_from_shared_projection(scheme: SpatialScheme) -> bool:
    """Tell whether a projection of all samples is all that a scheme needs to start.

    Two steps start from the control points, whose number and choice differ between runs, and
    a projector's own inverse needs the projector, not only where it put the samples.
    """
    return scheme.two_step is None and scheme.back_projector != "inverse"


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
