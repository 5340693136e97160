"""Figures 4.1 and 4.2 of Halit 2010: the parameters of the saliency method, and its time."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import pandas as pd

from workbench.experiments.runs.base import Run
from workbench.experiments.runs.keyframes import KeyframeRun
from workbench.figures.parameter_curves import ParameterPanel
from workbench.quality.animation import GREATEST_ANGLE
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.results import evidence_of
from workbench.reproduction.halit2010 import running_time
from workbench.reproduction.halit2010.motions import (
    CALM,
    DYNAMIC,
    PARAMETERS,
    kind_of_motion,
    motions,
    saliency_parameters,
    values_of,
)

_COMPONENTS = {"quick": (1, 3, 5, 7, 10), "full": tuple(range(1, 13))}
_SIGMAS = {"quick": (1, 2, 3, 5, 7, 10, 15), "full": tuple(range(1, 16))}
#: What section 4.2 recommends, shaded in the figure.
_RECOMMENDED = {
    ("n_components", DYNAMIC): (7.0, 10.0),
    ("n_components", CALM): (7.0, 10.0),
    ("sigma", DYNAMIC): (1.0, 3.0),
    ("sigma", CALM): (7.0, 10.0),
}
#: Motions with a line of their own, the first that is there.
_EXAMPLES = {
    CALM: ("cmu/05_01", "cmu/01_03-walk"),
    DYNAMIC: ("cmu/06_02", "cmu/01_01-two-jumps"),
}

#: What is varied, by its name in the library and in figures.
VARIED = {"n_components": "components k", "sigma": "σ in frames"}


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
    runs += running_time.planned_runs(profile)
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
    clips = list(dict.fromkeys(table.loc[~timed, "dataset"]))
    runs = pd.DataFrame.from_dict(
        {clip: varied_runs(clip, varied, "full") for clip in clips}, orient="index", dtype=object
    )
    found = np.array(values_of(table, runs.to_numpy().ravel(), column), dtype=np.float64)
    values = pd.DataFrame(found.reshape(runs.shape), index=runs.index, columns=runs.columns)
    return values.dropna(axis="index", how="all").dropna(axis="columns", how="all")


def chart_panels(table: pd.DataFrame) -> list[ParameterPanel]:
    """Arrange errors for the four panels of Figure 4.1.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    list of ParameterPanel
        Root mean squared joint-angle errors in degrees; panels without a motion are left out.
    """
    panels = []
    charts = [(varied, kind) for varied in VARIED for kind in (DYNAMIC, CALM)]
    for letter, (varied, kind) in zip("abcd", charts, strict=True):
        values = of_kind(varied_values(table, varied), kind)
        if values.empty:
            continue
        sigma, n_components = PARAMETERS[kind]
        fixed = f"σ = {sigma:g}" if varied == "n_components" else f"k = {n_components}"
        shown = next((clip for clip in _EXAMPLES[kind] if clip in values.index), "")
        panels.append(
            ParameterPanel(
                f"{letter}. {kind} motions, {fixed}",
                VARIED[varied],
                root_mean_square(values),
                _RECOMMENDED[varied, kind],
                shown,
            )
        )
    return panels


def describe_panel(panel: ParameterPanel) -> str:
    """Say where the median of a panel begins and ends."""
    median = panel.curves.median()
    (first, start), *_, (last, end) = median.items()
    return f"{panel.title} from {start:.1f} at {first} to {end:.1f} at {last}"


def describe_examples(panels: Sequence[ParameterPanel]) -> str:
    """Name the motions that have a line of their own: "Examples: 06_02, 05_01."."""
    shown = dict.fromkeys(panel.shown.split("/", 1)[-1] for panel in panels if panel.shown)
    return f"Examples: {', '.join(shown)}." if shown else ""


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


def evidence(table: pd.DataFrame) -> dict[str, Evidence]:
    """Give the evidence on all claims about the parameters and the time, by claim."""
    return {
        "halit2010:seven-components": gain(table, "n_components", 10, 7),
        "halit2010:few-components-lose": gain(table, "n_components", 7, 3),
        "halit2010:small-sigma-for-dynamic": gain(table, "sigma", 3, 7, DYNAMIC),
        "halit2010:large-sigma-for-calm": level(table, 10, CALM),
        "halit2010:linear-time": running_time.growth(running_time.times(table)),
    }


def level(table: pd.DataFrame, sigma: int, kind: str) -> Evidence:
    """Estimate the PSNR at a σ over motions of a kind: the median in dB."""
    values = of_kind(varied_values(table, "sigma"), kind).reindex(columns=[sigma])
    return evidence_of(values, lambda v: float(np.median(v)))
