"""Whether the same error needs fewer keyframes with contact handling (Halit 2010, 5.1.3)."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from workbench.experiments.bootstrap import bootstrap
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.keyframes import KeyframeRun
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.results import evidence_of
from workbench.reproduction.halit2010.motions import (
    CALM,
    DYNAMIC,
    PARAMETERS,
    kind_of_motion,
    saliency_parameters,
    values_of,
)

_SIGMAS = {"quick": (1, 2, 3, 5, 7, 10, 15), "full": tuple(range(1, 16))}
#: σ of the runs with contact handling, fewer because each is compared with all of the others.
_CONTACT_SIGMAS = {"quick": (2, 5, 10), "full": (1, 2, 3, 5, 7, 10)}


def planned_runs(clips: Iterable[str], profile: str) -> list[Run]:
    """List the runs over σ, with contact handling and without."""
    runs: list[Run] = []
    for clip in clips:
        runs += contact_runs(clip, _SIGMAS[profile], contacts=False)
        runs += contact_runs(clip, _CONTACT_SIGMAS[profile], contacts=True)
    return runs


def contact_runs(clip: str, sigmas: Iterable[int], *, contacts: bool) -> list[KeyframeRun]:
    """Give the runs of the saliency method over σ, with or without contact handling."""
    _, k = PARAMETERS[kind_of_motion(clip)]
    return [
        KeyframeRun(clip, parameters=saliency_parameters(sigma, k, contacts=contacts))
        for sigma in sigmas
    ]


def contact_ratios(table: pd.DataFrame) -> pd.Series:
    """Compare how many keyframes the same error needs with and without contact handling.

    For each σ, the keyframes that contact handling chooses, over those that the method without
    it would need for the same error (Eq. 4.1), read off the line through its counts and
    errors over σ, both logarithmic. What lies outside that line's range is left out.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    Series
        Geometric mean over σ, by motion.
    """
    ratios = {}
    for clip in dict.fromkeys(table.loc[table["selector"].notna(), "dataset"]):
        with_handling = _counts_and_errors(table, clip, contacts=True)
        without = _counts_and_errors(table, clip, contacts=False)
        if len(with_handling) and len(without) > 1:
            # Errors that rise with the count are no line to read off: the lower ones count.
            order = np.argsort(without[:, 0], kind="stable")
            counts = np.log(without[order, 0])
            errors = np.minimum.accumulate(np.log(without[order, 1]))
            wanted = np.log(with_handling[:, 1])
            inside = (wanted >= errors[-1]) & (wanted <= errors[0])
            if inside.any():
                needed = np.interp(-wanted[inside], -errors, counts)
                ratios[clip] = float(np.exp(np.mean(np.log(with_handling[inside, 0]) - needed)))
    return pd.Series(ratios, dtype=float)


def _counts_and_errors(table: pd.DataFrame, clip: str, *, contacts: bool) -> NDArray[np.float64]:
    runs = contact_runs(clip, _SIGMAS["full"], contacts=contacts)
    columns = [values_of(table, runs, name) for name in ("n_control_points", "body_error")]
    found = np.column_stack(columns)
    return found[np.all(found > 0, axis=1)]


def evidence(ratios: pd.Series) -> Evidence:
    """Estimate the median of :func:`contact_ratios` over motions."""
    return evidence_of(ratios, lambda v: float(np.median(v)))


def contact_table(ratios: pd.Series) -> pd.DataFrame:
    """Summarize :func:`contact_ratios` for all, calm and dynamic motions."""
    rows = {}
    for kind in ("all", CALM, DYNAMIC):
        chosen = ratios[[kind in ("all", kind_of_motion(str(name))) for name in ratios.index]]
        if len(chosen):
            found = bootstrap(chosen.to_numpy(float), lambda v: float(np.median(v)))
            rows[kind] = {
                "motions": len(chosen),
                "with / without, median": found.value,
                "95 %": f"{found.low:.2f} to {found.high:.2f}",
                "fewer on": f"{(chosen < 1).sum()} of {len(chosen)}",
            }
    return pd.DataFrame.from_dict(rows, orient="index").rename_axis("kind")
