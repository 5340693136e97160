"""Figures 4.1 and 4.2 of Halit 2010: the parameters of the saliency method, and its time."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pandas as pd

from workbench.experiments.bootstrap import bootstrap
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.keyframes import KeyframeRun
from workbench.experiments.runs.saliency_times import SaliencyTimeRun
from workbench.quality.animation import GREATEST_ANGLE
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.results import evidence_of
from workbench.reproduction.halit2010.motions import (
    CALM,
    DYNAMIC,
    PARAMETERS,
    kind_of_motion,
    motions,
    saliency_parameters,
    values_of,
)

#: The clip that is repeated for Figure 4.2; it is bundled.
TIMED_CLIP = "cmu/01_01"

_COMPONENTS = {"quick": (1, 2, 3, 5, 7, 10, 12), "full": tuple(range(1, 13))}
_SIGMAS = {"quick": (1, 2, 3, 5, 7, 10, 15), "full": tuple(range(1, 16))}
_LENGTHS = {
    "quick": (10_000, 30_000, 100_000),
    "full": (10_000, 20_000, 30_000, 40_000, 50_000, 60_000, 70_000, 80_000, 90_000, 100_000),
}
_REPETITIONS = 8

#: What is varied, by its name in the library and in figures.
VARIED = {"n_components": "number of components k", "sigma": "σ in frames"}


def planned_runs(
    profile: str,
    seed: int = 0,  # noqa: ARG001 - plans of all notebooks are asked alike
    *,
    clips: Iterable[str] | None = None,
) -> list[Run]:
    """List the runs of Figures 4.1 and 4.2.

    Parameters
    ----------
    profile : {"quick", "full"}
        Which motions, and how finely the parameters vary.
    seed : int
        Without effect: nothing is random here.
    clips : iterable of str, optional
        Names of motions, in place of the profile's.

    Returns
    -------
    list of Run
    """
    runs: list[Run] = []
    for clip in motions(profile) if clips is None else clips:
        for varied in VARIED:
            runs += varied_runs(clip, varied, profile).values()
    runs += [
        SaliencyTimeRun(TIMED_CLIP, n_frames, repetition=repetition)
        for repetition in range(_REPETITIONS)
        for n_frames in _LENGTHS[profile]
    ]
    return list(dict.fromkeys(runs))


def varied_runs(clip: str, varied: str, profile: str) -> dict[int, KeyframeRun]:
    """Give the run for each value of the parameter that varies.

    The other parameter is as Tables 4.1 and 4.2 have it for the kind of motion.
    """
    sigma, n_components = PARAMETERS[kind_of_motion(clip)]
    if varied == "n_components":
        settings = {k: saliency_parameters(sigma, k) for k in _COMPONENTS[profile]}
    else:
        settings = {s: saliency_parameters(s, n_components) for s in _SIGMAS[profile]}
    return {value: KeyframeRun(clip, parameters=found) for value, found in settings.items()}


def varied_values(table: pd.DataFrame, varied: str, column: str = "psnr") -> pd.DataFrame:
    """Arrange a value of the finished runs by motion and value of a parameter.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    varied : {"n_components", "sigma"}
        The parameter.
    column : str
        Such as ``"psnr"`` or ``"n_control_points"``.

    Returns
    -------
    DataFrame of shape (n_motions, n_values)
        Motions that no run has finished on are left out; other missing values are not a
        number.
    """
    timed = table["n_frames"].notna() if "n_frames" in table else pd.Series(False, table.index)
    rows = {}
    for clip in dict.fromkeys(table.loc[~timed, "dataset"]):
        runs = varied_runs(clip, varied, "full")
        rows[clip] = dict(zip(runs, values_of(table, runs.values(), column), strict=True))
    values = pd.DataFrame.from_dict(rows, orient="index", dtype=float)
    return values.dropna(axis="index", how="all").dropna(axis="columns", how="all")


def panels_of_figure_4_1(table: pd.DataFrame) -> dict[str, tuple[str, pd.DataFrame]]:
    """Arrange errors for the four panels of Figure 4.1.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    dict of str to (str, DataFrame)
        For each panel's title what varies, and the root mean squared joint-angle error in
        degrees by motion and value. Panels without a motion are left out.
    """
    panels = {}
    charts = [(varied, kind) for varied in VARIED for kind in (DYNAMIC, CALM)]
    for letter, (varied, kind) in zip("abcd", charts, strict=True):
        values = of_kind(varied_values(table, varied), kind)
        sigma, n_components = PARAMETERS[kind]
        fixed = f"σ = {sigma:g}" if varied == "n_components" else f"k = {n_components}"
        if not values.empty:
            panels[f"{letter}. {kind}, {fixed}"] = (varied, root_mean_square(values))
    return panels


def of_kind(values: pd.DataFrame, kind: str) -> pd.DataFrame:
    """Keep the rows of calm, or of dynamic, motions."""
    return values.loc[[kind_of_motion(str(name)) == kind for name in values.index]]


def root_mean_square(decibels: pd.DataFrame) -> pd.DataFrame:
    """Turn peak signal-to-noise ratios back into root mean squared errors, in degrees."""
    return GREATEST_ANGLE / 10.0 ** (decibels / 20.0)


def parameter_table(table: pd.DataFrame) -> pd.DataFrame:
    """Give the medians over motions that Figure 4.1 shows, with how many frames are keys.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        For each parameter and its values, by kind of motion: the median PSNR in dB and the
        median share of the frames in per cent.
    """
    rows: dict[str, dict[tuple[str, str], float]] = {}
    for varied, short in (("n_components", "k"), ("sigma", "σ")):
        ratios = varied_values(table, varied)
        counts = varied_values(table, varied, "n_control_points")
        shares = 100 * counts / varied_values(table, varied, "n_samples")
        for kind in (DYNAMIC, CALM):
            for value in ratios.columns:
                row = rows.setdefault(f"{short} = {value}", {})
                row[kind, "PSNR, dB"] = of_kind(ratios, kind)[value].median()
                row[kind, "keyframes, %"] = of_kind(shares, kind)[value].median()
    result = pd.DataFrame.from_dict(rows, orient="index")
    result.index.name = "parameter"
    return result


def gain(table: pd.DataFrame, varied: str, better: int, worse: int, kind: str = "") -> Evidence:
    """Estimate the difference of PSNR between two values of a parameter, over motions.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    varied : {"n_components", "sigma"}
        The parameter.
    better, worse : int
        Its values; the difference is that of the former minus the latter.
    kind : {"", "calm", "dynamic"}
        Motions of one kind only.

    Returns
    -------
    Evidence
        Median in dB.
    """
    values = varied_values(table, varied)
    values = of_kind(values, kind) if kind else values
    pair = values.reindex(columns=[better, worse])
    return evidence_of(pair, lambda v: float(np.median(v[:, 0] - v[:, 1])))


def level(table: pd.DataFrame, sigma: int, kind: str) -> Evidence:
    """Estimate the PSNR at a σ over motions of a kind: the median in dB."""
    values = of_kind(varied_values(table, "sigma"), kind).reindex(columns=[sigma])
    return evidence_of(values, lambda v: float(np.median(v)))


def times(table: pd.DataFrame) -> pd.DataFrame:
    """Arrange the running times by repetition and number of frames, in seconds."""
    if "n_frames" not in table:
        return pd.DataFrame(dtype=float)
    rows = table[(table["status"] == "done") & table["n_frames"].notna()]
    values = rows.astype({"n_frames": int, "repetition": int}).pivot_table(
        "seconds_total", "repetition", "n_frames", aggfunc="first"
    )
    return values.astype(float)


def time_table(seconds: pd.DataFrame) -> pd.DataFrame:
    """Summarize the running times for each number of frames."""
    result = pd.DataFrame(
        {
            "seconds, median": seconds.median(),
            "seconds, least": seconds.min(),
            "seconds, most": seconds.max(),
            "microseconds per frame": 1e6 * seconds.median() / seconds.columns.to_numpy(float),
        }
    )
    result.index.name = "frames"
    return result


def growth(seconds: pd.DataFrame) -> Evidence:
    """Estimate the exponent with which the time grows, over repetitions.

    Parameters
    ----------
    seconds : DataFrame
        From :func:`times`.

    Returns
    -------
    Evidence
        Median of the slopes of log(seconds) over log(frames).
    """
    complete = seconds.dropna()
    if complete.empty or complete.shape[1] < 2:
        return Evidence(None, units="repetitions", note="No complete repetition has finished.")
    frames = np.log(complete.columns.to_numpy(float))
    slopes = np.polyfit(frames, np.log(complete.to_numpy(float)).T, 1)[0]
    return Evidence(
        bootstrap(slopes, lambda values: float(np.median(values))),
        units="repetitions",
        note=f"{TIMED_CLIP} played forth and back, one thread in each process.",
    )
