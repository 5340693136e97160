"""Measure what a panel of the comparison shows."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.comparison.jobs import PanelResult, Run, Values
from workbench.dashboards.shared.background import Report

if TYPE_CHECKING:
    from workbench.results import SpatialResult

_LARGEST_K = 100
_SIZES = 24


def panel_result(
    run: Run, result: SpatialResult, notes: tuple[str, ...], report: Report
) -> PanelResult:
    """Measure everything that a panel shows of a scheme's result.

    Parameters
    ----------
    run : Run
        What was run.
    result : SpatialResult
        What came of it.
    notes : tuple of str
        What to tell of it.
    report : callable
        Gets the progress.
    """
    from workbench.quality.local_stress import local_stress
    from workbench.quality.neighborhoods import (
        local_neighborhood_quality,
        neighborhood_quality,
    )
    from workbench.quality.shepard_diagram import shepard_diagram

    report("measuring quality", 0.86)
    distances, embedding = result.space.distances, result.embedding
    quality = result.quality
    curve = neighborhood_quality(distances, embedding, curve_sizes(len(embedding)))
    report("measuring the quality of samples", 0.94)
    near = local_neighborhood_quality(distances, embedding, quality.k)
    local = {
        "stress": local_stress(distances, embedding),
        "trustworthiness": near.trustworthiness,
        "continuity": near.continuity,
        "neighbourhood preservation": near.preservation,
        "reconstruction error": result.errors,
    }
    optimized = run.panel.optimized
    return PanelResult(
        embedding=embedding,
        projected=result.projected if optimized else None,
        before=Values(result.projected_quality, result.projected_error) if optimized else None,
        control_points=result.control_points,
        errors=result.errors,
        error=result.error,
        quality=quality,
        local={name: values.astype(np.float32) for name, values in local.items()},
        k=curve.k,
        preservation=curve.preservation,
        shepard=shepard_diagram(distances, embedding, random_state=run.seed),
        seconds=result.timings.total,
        notes=notes,
    )


def curve_sizes(n_samples: int) -> NDArray[np.intp]:
    """Choose neighbourhood sizes for a curve, closer together where they are small."""
    largest = max(1, min(_LARGEST_K, (n_samples - 1) // 2))
    return np.unique(np.geomspace(1, largest, _SIZES).round().astype(np.intp))
