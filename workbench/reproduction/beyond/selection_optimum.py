"""How far keyframe selectors are from the best keyframes that there are."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pandas as pd

from workbench.experiments.bootstrap import Estimate, bootstrap
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.schemes import Scheme, SchemeRun
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.results import evidence_of, values_by_clip
from workbench.reproduction.profiles import motion_clips
from workbench.schemes import TemporalScheme

#: Share of the frames that are keyframes.
RATIO = 0.03

OPTIMUM = "Exact"

_SELECTORS = {
    "Uniform": "uniform",
    "SCS": "scs",
    "PB": "pb",
    "Chord": "chord",
    "Saliency": "saliency",
    OPTIMUM: "optimal",
}

#: Schemes that interpolate by slerp between the keyframes of each selector.
SCHEMES: dict[str, Scheme] = {
    name: TemporalScheme("slerp", selector=selector) for name, selector in _SELECTORS.items()
}

#: Selectors that look at slerp errors, or at nothing: the best of them is what a user has who
#: does not wait for the exact method.
GREEDY = ("Uniform", "SCS", "PB")


def planned_runs(profile: str, seed: int = 0, *, clips: Iterable[str] | None = None) -> list[Run]:
    """List the runs: every selector on every clip, at 3 % of the frames.

    Parameters
    ----------
    profile : {"quick", "full"}
        Which clips.
    seed : int
        Written with the runs; no selector here is random.
    clips : iterable of str, optional
        Names of clips, in place of the profile's.

    Returns
    -------
    list of Run
    """
    return [
        SchemeRun(clip, scheme, ratio=RATIO, seed=seed)
        for clip in (motion_clips(profile) if clips is None else clips)
        for scheme in SCHEMES.values()
    ]


def ratios_to_optimum(table: pd.DataFrame) -> pd.DataFrame:
    """Divide the error of each selector by that of the exact selection, clip by clip.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame of shape (n_clips, n_selectors)
        At least 1, but for rounding; clips without a finished exact selection are left out.
    """
    errors = values_by_clip(table, SCHEMES)
    errors = errors[errors[OPTIMUM] > 0]
    return errors.drop(columns=OPTIMUM).div(errors[OPTIMUM], axis="index")


def optimum_table(ratios: pd.DataFrame) -> pd.DataFrame:
    """Summarize the ratios over clips.

    Parameters
    ----------
    ratios : DataFrame
        From :func:`ratios_to_optimum`.

    Returns
    -------
    DataFrame
        For each selector, and for the best of :data:`GREEDY` on each clip: the median error
        over the optimum's with its interval, mean, least and most, and how often it is the
        best of the selectors.
    """
    best = ratios.min(axis=1)
    shown = ratios.assign(**{"Best of uniform, SCS, PB": ratios[list(GREEDY)].min(axis=1)})
    rows = {}
    for name, values in shown.items():
        found = values.dropna()
        if found.empty:
            continue
        median = bootstrap(found.to_numpy(), lambda v: float(np.median(v)))
        rows[name] = {
            "median": median.value,
            "95 %": f"{median.low:.3f} to {median.high:.3f}",
            "mean": found.mean(),
            "least": found.min(),
            "most": found.max(),
            "best on": f"{(found <= best[found.index]).sum()} of {len(found)}",
        }
    result = pd.DataFrame.from_dict(rows, orient="index")
    return result.rename_axis("selector")


def medians(ratios: pd.DataFrame) -> dict[str, Estimate]:
    """Estimate the median ratio of each selector, over clips."""
    found = {str(name): values.dropna().to_numpy(float) for name, values in ratios.items()}
    return {
        name: bootstrap(values, lambda v: float(np.median(v)))
        for name, values in found.items()
        if len(values)
    }


def greedy_gap(ratios: pd.DataFrame) -> Evidence:
    """Estimate the error of the best of uniform, SCS and PB over the optimum: median."""
    return evidence_of(ratios[list(GREEDY)].dropna(), lambda v: float(np.median(v.min(axis=1))))
