"""Selectors at the counts that the saliency method chooses."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import rankdata

from workbench.experiments.bootstrap import Estimate, bootstrap
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.keyframes import KeyframeRun
from workbench.reproduction.halit2010.comparison import interval
from workbench.reproduction.halit2010.motions import (
    STRETCHING,
    has_skeleton,
    recommended,
    values_of,
)
from workbench.reproduction.published import published

#: Selectors by the names they are shown under. What is exact for joint angles has the highest
#: PSNR that there is, what is exact for D_q the lowest D_q error.
SELECTORS = {
    "Saliency": "saliency",
    "Uniform": "uniform",
    "Chord": "chord",
    "SCS": "scs",
    "PB": "pb",
    "Exact, D_q": "optimal",
    "Exact, angles": "exact",
}


def planned_runs(clip: str) -> list[Run]:
    """List the runs of the selectors that a motion allows: D_q needs its poses."""
    names = [name for name in SELECTORS if name != "Exact, D_q" or has_skeleton(clip)]
    return [selector_run(clip, name) for name in names]


def selector_run(clip: str, name: str) -> KeyframeRun:
    """Give the run of a selector, with as many keyframes as saliency chooses."""
    parameters = recommended(clip)
    if name == "Saliency":
        return KeyframeRun(clip, parameters=parameters)
    return KeyframeRun(clip, SELECTORS[name], counted_by=parameters)


def selector_values(table: pd.DataFrame, column: str) -> pd.DataFrame:
    """Arrange a value of the selectors by motion, at the counts that saliency chooses.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    column : str
        Such as ``"psnr"``, or ``"error"`` for D_q.

    Returns
    -------
    DataFrame of shape (n_motions, n_selectors)
        Not a number where there is no such value.
    """
    if "selector" not in table:
        return pd.DataFrame(columns=list(SELECTORS), dtype=float)
    clips = list(dict.fromkeys(table.loc[table["selector"].notna(), "dataset"]))
    values = {
        name: values_of(table, [selector_run(clip, name) for clip in clips], column)
        for name in SELECTORS
    }
    return pd.DataFrame(values, index=pd.Index(clips, name="motion"), dtype=float)


def against_saliency(table: pd.DataFrame, column: str) -> dict[str, pd.Series]:
    """Compare each selector with saliency, motion by motion.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    column : {"psnr", "error"}
        PSNR gives differences in dB, D_q errors give ratios.

    Returns
    -------
    dict of str to Series
        For each other selector its value minus that of saliency, or over it, by motion.
    """
    values = selector_values(table, column)
    found = {}
    for name in list(SELECTORS)[1:]:
        pair = values[[name, "Saliency"]].dropna()
        if len(pair):
            first, second = pair[name], pair["Saliency"]
            found[name] = first - second if column == "psnr" else first / second
    return found


def median_estimates(values: Mapping[str, pd.Series]) -> dict[str, Estimate]:
    """Estimate the median of each series, over motions."""
    return {
        name: bootstrap(series.to_numpy(float), lambda v: float(np.median(v)))
        for name, series in values.items()
    }


def selector_table(table: pd.DataFrame) -> pd.DataFrame:
    """Compare the selectors over all motions, at the counts that saliency chooses.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        For each selector, by PSNR and by D_q error: its mean rank (1 is best), the median
        difference to saliency, or ratio, with its interval, and on how many motions it is
        better than saliency.
    """
    rows: dict[str, dict[tuple[str, str], Any]] = {name: {} for name in SELECTORS}
    for column, title, effect, sign in (
        ("psnr", "PSNR", "minus saliency, dB", -1.0),
        ("error", "D_q error", "over saliency", 1.0),
    ):
        complete = selector_values(table, column)
        shown = complete.dropna(axis="columns", how="all").dropna()
        if len(shown):
            ranks = rankdata(sign * shown.to_numpy().round(9), axis=1).mean(axis=0)
            for name, rank in zip(shown.columns, ranks, strict=True):
                rows[name][title, "mean rank"] = float(rank)
        compared = against_saliency(table, column)
        for name, found in median_estimates(compared).items():
            better = compared[name] > 0 if column == "psnr" else compared[name] < 1
            rows[name][title, effect] = found.value
            rows[name][title, "95 %"] = interval(found.low, found.high)
            rows[name][title, "better on"] = f"{better.sum()} of {len(better)}"
    result = pd.DataFrame.from_dict(rows, orient="index").rename_axis("selector")
    return result.sort_index(axis="columns", level=0, sort_remaining=False, ascending=False)


def stretching_table(table: pd.DataFrame) -> pd.DataFrame | None:
    """Compare the selectors on the clip of the thesis; None if it is not at hand.

    Returns
    -------
    DataFrame
        PSNR of each selector in dB, and the published one of those that the thesis has.
    """
    values = selector_values(table, "psnr")
    if STRETCHING not in values.index:
        return None
    theirs = published("halit2010:tab4.2").table()["Stretching"]
    printed = {"Saliency": "Saliency", "Chord": "Curve simplification", "PB": "Frame decimation"}
    rows = {}
    for name, ours in values.loc[STRETCHING].dropna().items():
        their = float(theirs[printed[str(name)]]) if name in printed else None
        rows[name] = {
            "PSNR, dB, ours": ours,
            "published": their,
            "difference": None if their is None else ours - their,
        }
    return pd.DataFrame.from_dict(rows, orient="index").rename_axis("selector")


def points_on(table: pd.DataFrame, clip: str) -> dict[str, tuple[float, float]]:
    """Give the keyframes and the PSNR of the other selectors on a motion."""
    found = {}
    for name in list(SELECTORS)[1:]:
        run = [selector_run(clip, name)]
        [count], [ratio] = (values_of(table, run, c) for c in ("n_control_points", "psnr"))
        if np.isfinite(ratio):
            found[name] = (count, ratio)
    return found
