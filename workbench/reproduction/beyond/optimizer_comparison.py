"""Optimizers compared, from the results of :mod:`workbench.reproduction.beyond.optimizer_runs`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd

from workbench.experiments.runs.schemes import scheme_name
from workbench.experiments.statistics import boxplot_statistics
from workbench.figures.boxplots import Box
from workbench.reproduction.beyond.optimizer_runs import (
    BASELINE,
    BEFORE_MARKERS,
    MARKER_SEARCHES,
    OURS,
    PROJECTORS,
    scheme_of,
)
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.results import evidence_of, geometric_mean, listed

#: A method of the comparison: its name, its optimizer and its search for markers.
_Kind = tuple[str, str, str | None]

#: What is claimed of searches for markers.
_MARKER_CLAIMS = {
    "move": "ours:moving-markers-helps",
    "exchange": "ours:exchanging-markers-helps",
}
#: Relative difference of errors that is rounding and not a worse result.
_ROUNDING = 1e-9
#: Name of the rows over all projectors.
ALL = "all"


def compare_optimizers(table: pd.DataFrame) -> pd.DataFrame:
    """Set every finished run of our optimizers beside that of Alg. 12 from the same start.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        One row for each clip, projector and optimizer, Alg. 12 among them, where all of them
        are finished: ``error``, ``baseline_error``, ``error_ratio``, ``effort_ratio``,
        ``seconds_ratio`` (of the optimization alone), and what optimization does to the
        projection: ``stress_ratio``, ``scale_normalized_stress_ratio``,
        ``trustworthiness_change``, ``neighborhood_preservation_change``.
    """
    compared = _side_by_side(
        table, [(name, name, None) for name in (BASELINE, *OURS)], _optimize_seconds
    )
    for name in ("trustworthiness", "neighborhood_preservation"):
        compared[f"{name}_change"] = compared[name] - compared[f"projected_{name}"]
    return compared


def compare_markers(table: pd.DataFrame) -> pd.DataFrame:
    """Set every finished search for markers beside the global optimizer alone.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        One row for each clip, projector and search where all are finished, with the columns
        of :func:`compare_optimizers` relative to the global optimizer.
    """
    kinds: list[_Kind] = [(BEFORE_MARKERS, BEFORE_MARKERS, None)]
    kinds += [(search, BEFORE_MARKERS, search) for search in MARKER_SEARCHES]
    compared = _side_by_side(table, kinds, _search_seconds)
    return compared[compared["method"] != BEFORE_MARKERS]


def optimizer_table(compared: pd.DataFrame) -> pd.DataFrame:
    """Summarize the comparison per projector and over all.

    Parameters
    ----------
    compared : DataFrame
        From :func:`compare_optimizers`.

    Returns
    -------
    DataFrame
        One row for each projector and optimizer.
    """
    return _summary(
        compared,
        lambda rows: {
            ("error / Alg. 12", "median"): rows["error_ratio"].median(),
            ("error / Alg. 12", "largest"): rows["error_ratio"].max(),
            ("error / Alg. 12", "runs above 1"): f"{_is_higher(rows).sum()} of {len(rows)}",
            ("cost / Alg. 12", "effort, mean"): rows["effort_ratio"].mean(),
            # The first run of a process loads its kernels, which would rule a mean.
            ("cost / Alg. 12", "seconds, median"): rows["seconds_ratio"].median(),
            ("stress, after / before, median", "Eq. 4.1"): rows["stress_ratio"].median(),
            ("stress, after / before, median", "scale-normalised"): rows[
                "scale_normalized_stress_ratio"
            ].median(),
            ("change, median", "trustworthiness"): rows["trustworthiness_change"].median(),
            ("change, median", "neighbours kept"): rows[
                "neighborhood_preservation_change"
            ].median(),
        },
        "projector, optimizer",
    )


def marker_table(compared: pd.DataFrame) -> pd.DataFrame:
    """Summarize what markers gain, per projector and over all.

    Parameters
    ----------
    compared : DataFrame
        From :func:`compare_markers`.

    Returns
    -------
    DataFrame
        One row for each projector and search.
    """
    return _summary(
        compared,
        lambda rows: {
            ("error / global alone", "median"): rows["error_ratio"].median(),
            ("error / global alone", "smallest"): rows["error_ratio"].min(),
            ("error / global alone", "largest"): rows["error_ratio"].max(),
            ("cost / global alone", "effort, mean"): rows["effort_ratio"].mean(),
            ("cost / global alone", "seconds, median"): rows["seconds_ratio"].median(),
            ("runs", ""): len(rows),
        },
        "projector, markers",
    )


def higher_runs(compared: pd.DataFrame) -> pd.DataFrame:
    """List the runs that end higher than Alg. 12, the worst first.

    Parameters
    ----------
    compared : DataFrame
        From :func:`compare_optimizers`.

    Returns
    -------
    DataFrame
        One row for each run; empty if there is none.
    """
    rows = compared[_is_higher(compared)].sort_values("error_ratio", ascending=False)
    clips = rows["dataset"].str.removeprefix("cmu/")
    names = clips + ", " + rows["projector"] + ", " + rows["method"]
    listed = rows[["baseline_error", "error", "error_ratio"]].set_axis(
        ["error of Alg. 12", "error", "error / Alg. 12"], axis="columns"
    )
    return listed.set_axis(pd.Index(names, name="clip, projector, optimizer"), axis="index")


def ratio_boxes(compared: pd.DataFrame) -> dict[str, dict[str, Box]]:
    """Compute, for each of our optimizers, a box of error ratios over clips per projector."""
    return {
        method: {
            str(name): boxplot_statistics(rows["error_ratio"])
            for name, rows in compared[compared["method"] == method].groupby(
                "projector", sort=False
            )
        }
        for method in OURS
    }


def medians_in_words(compared: pd.DataFrame) -> str:
    """Say the medians of :func:`ratio_boxes`, for those who do not see the figure."""
    return " ".join(
        f"Medians, {method}: "
        + ", ".join(f"{name} {box.median:.3f}" for name, box in boxes.items())
        + "."
        for method, boxes in ratio_boxes(compared).items()
    )


def evidence(table: pd.DataFrame) -> dict[str, Evidence]:
    """Give the evidence on the claims about our optimizers.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    dict of str to Evidence
        By claim.
    """
    optimized, moved = compare_optimizers(table), compare_markers(table)
    works = optimized.loc[optimized["method"] == "global", "effort_ratio"]
    found = {
        "ours:better-optimizer": _median_over_clips(
            optimized, "global", f"Its effort is {works.mean():.2f} of that of Alg. 12 in the mean."
        )
    }
    for search, claim in _MARKER_CLAIMS.items():
        rows = moved[moved["method"] == search]
        costs = f"At {rows['effort_ratio'].mean():.0f} times the effort of the global optimizer."
        found[claim] = _median_over_clips(moved, search, costs if len(rows) else "")
    return found


def _median_over_clips(compared: pd.DataFrame, method: str, note: str) -> Evidence:
    """Estimate the median over clips of the geometric mean over projectors of error ratios."""
    rows = compared[compared["method"] == method]
    if rows.empty:
        return Evidence(None, note="No run of it is finished.")
    by_projector = rows.pivot_table("error_ratio", "dataset", "projector", aggfunc="mean")
    projectors = list(by_projector.columns)
    means = geometric_mean(by_projector).dropna()
    if means.empty:
        return Evidence(None, note="No clip has finished runs with all projectors.")
    return evidence_of(
        means,
        lambda values: float(np.median(values)),
        f"{listed(projectors)}. {note}",
    )


def _side_by_side(
    table: pd.DataFrame,
    kinds: list[_Kind],
    seconds: Callable[[pd.DataFrame], pd.Series],
) -> pd.DataFrame:
    """Line up runs of several methods from the same start; ratios are to the first method.

    Only starts from which all have finished count.
    """
    done = table[table["status"] == "done"]
    parts = []
    for name, projector in PROJECTORS.items():
        found = []
        for method, optimizer, markers in kinds:
            wanted = scheme_name(scheme_of(projector, optimizer, markers))
            rows = done[done["scheme"] == wanted].set_index("dataset", drop=False)
            found.append(rows.assign(projector=name, method=method))
        common = found[0].index
        for rows in found[1:]:
            common = common.intersection(rows.index, sort=False)
        first = found[0].loc[common]
        for rows in found:
            mine = rows.loc[common]
            ratios = {
                "baseline_error": first["error"],
                "error_ratio": mine["error"] / first["error"],
                "effort_ratio": _effort(mine) / _effort(first),
                "seconds_ratio": seconds(mine) / seconds(first),
            }
            parts.append(mine.assign(**ratios))
    return pd.concat(parts, ignore_index=True)


def _effort(rows: pd.DataFrame) -> pd.Series:
    """Count back-projections and distances of the search, a Jacobian as what it replaces.

    By finite differences it would take a back-projection for each of the plane's dimensions.
    The reconstruction at the end back-projects every free sample once, whatever the search.
    """
    reconstruction = rows["n_samples"] - rows["n_control_points"]
    return rows["evaluations"] - reconstruction + 2 * rows["jacobians"] + rows["distances"]


def _optimize_seconds(rows: pd.DataFrame) -> pd.Series:
    return rows["seconds_optimize"]


def _search_seconds(rows: pd.DataFrame) -> pd.Series:
    return rows[["seconds_optimize", "seconds_markers"]].sum(axis="columns")


def _is_higher(rows: pd.DataFrame) -> pd.Series:
    return rows["error_ratio"] > 1 + _ROUNDING


def _summary(
    compared: pd.DataFrame,
    describe: Callable[[pd.DataFrame], dict[tuple[str, str], Any]],
    index_name: str,
) -> pd.DataFrame:
    """Describe the rows of each projector and method, and those of all projectors."""
    described = {}
    for name in (*PROJECTORS, ALL):
        of_projector = compared if name == ALL else compared[compared["projector"] == name]
        for method, rows in of_projector.groupby("method", sort=False):
            described[f"{name}, {method}"] = describe(rows)
    result = pd.DataFrame.from_dict(described, orient="index")
    if described:
        result.columns = pd.MultiIndex.from_tuples(list(next(iter(described.values()))))
    result.index.name = index_name
    return result
