"""Figures 5.12 to 5.17 of Costa 2018: tables projected in two steps, and optimized."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import pandas as pd

from workbench.experiments.grid import describe_failures
from workbench.experiments.runs.before_after import BeforeAfterRun
from workbench.experiments.runs.schemes import scheme_name
from workbench.experiments.store import ResultStore
from workbench.figures.embeddings import Panel
from workbench.reproduction.costa2018.results import PROJECTORS
from workbench.reproduction.costa2018.uci_tables import UCI_TABLES, UciTable
from workbench.reproduction.profiles import absent_tables
from workbench.reproduction.published import published, published_ids
from workbench.schemes import SpatialScheme

#: Share of the rows that are control points.
RATIO = 0.03
#: The item whose table takes every projector.
TABLE_5_3 = "costa2018:tab5.3"

#: What every caption of these figures has to say of the method.
TWO_STEPS = (
    "Two steps: the seed projector sees half of the rows, ROLS chooses 3 % of all as control "
    "points, RBFP places the others around them; the optimizer is Alg. 12."
)


def scheme_of(method: str) -> SpatialScheme:
    """Make the optimized two-step scheme of Table 5.3 with a seed projector."""
    return SpatialScheme(PROJECTORS[method], selector="rols", two_step="rbfp", optimizer="alg12")


def planned_runs(profile: str, seed: int) -> list[BeforeAfterRun]:
    """List the runs that the notebook reads for its default parameters, on the tables found."""
    absent = absent_tables([table.dataset for table in UCI_TABLES])
    found = [table for table in UCI_TABLES if table.dataset not in absent]
    return uci_runs(found, profile, seed=seed)


def uci_runs(
    tables: Iterable[UciTable],
    profile: str,
    *,
    seed: int = 0,
    items: Sequence[str] | None = None,
) -> list[BeforeAfterRun]:
    """List the runs of Table 5.3 and its figures, on data as they are and standardised.

    The quick profile runs large tables with the projector of their figure only, on data as
    they are, and everything from one seed.

    Parameters
    ----------
    tables : iterable of UciTable
        Those whose data are there.
    profile : {"quick", "full"}
        How much to run.
    seed : int
        The first seed; one of the subset, the control points and the projector.
    items : sequence of str, optional
        Ids; without that of Table 5.3 a figure needs its own projector and the first seed only.

    Returns
    -------
    list of BeforeAfterRun
    """
    runs = []
    for table in tables:
        only_figure = items is not None and TABLE_5_3 not in items
        small = profile == "quick" and table.large
        methods = [table.method] if only_figure or small else list(PROJECTORS)
        n_seeds = 1 if only_figure or profile == "quick" else table.n_seeds
        runs += [
            BeforeAfterRun(
                table.dataset,
                scheme_of(method),
                ratio=RATIO,
                seed=seed + further,
                standardize=standardize,
            )
            for standardize in ((False,) if small else (False, True))
            for method in methods
            for further in range(n_seeds)
        ]
    return runs


def finished(results: pd.DataFrame, table: UciTable, method: str | None = None) -> pd.DataFrame:
    """Find the finished runs of a table with a seed projector, by default its figure's.

    Data as they are come first, and the first seed.
    """
    rows = results[
        (results["status"] == "done")
        & (results["dataset"] == table.dataset)
        & (results["scheme"] == scheme_name(scheme_of(method or table.method)))
    ]
    return rows.sort_values(["standardize", "seed"])


def uci_panels(results: pd.DataFrame, table: UciTable, store: ResultStore) -> list[Panel]:
    """Read the embeddings of a figure: raw beside optimized, data as they are above standardised.

    Parameters
    ----------
    results : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    table : UciTable
        The table.
    store : ResultStore
        Where the grid kept its results.

    Returns
    -------
    list of Panel
        From the first seed, and only those whose run is finished.
    """
    panels = []
    for row in _first_seeds(results, table):
        arrays = store.arrays(row["key"])
        control = arrays["control_points"]
        panels += [
            Panel(f"2-step ROLS, {data_name(row)}", arrays["projected"], control),
            Panel("optimized", arrays["embedding"], control),
        ]
    return panels


def uci_quality(results: pd.DataFrame, table: UciTable) -> pd.DataFrame:
    """Compare the embeddings of a figure before and after optimization.

    Parameters
    ----------
    results : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    table : UciTable
        The table.

    Returns
    -------
    DataFrame
        One row for data as they are and one for standardised data, first seed: stress by
        both formulas, error, and how neighbourhoods are kept.
    """
    rows: dict[str, dict[tuple[str, str], float]] = {}
    for row in _first_seeds(results, table):
        values = rows[data_name(row)] = {}
        for title, column in _QUALITY.items():
            values[title, "before"] = row[f"projected_{column}"]
            values[title, "after"] = row[column]
    frame = pd.DataFrame.from_dict(rows, orient="index")
    if rows:
        frame.columns = pd.MultiIndex.from_tuples(list(next(iter(rows.values()))))
    frame.index.name = table.title
    return frame


_QUALITY = {
    "stress, Eq. 4.1": "stress",
    "stress, scale-normalised": "scale_normalized_stress",
    "error": "error",
    "trustworthiness": "trustworthiness",
    "continuity": "continuity",
    "neighbours kept": "neighborhood_preservation",
}


def uci_ratios(results: pd.DataFrame, table: UciTable) -> dict[str, float]:
    """Give the stress ratios (Eq. 4.1) of a figure by what they were computed on.

    Data whose projection had no stress have none.
    """
    return {
        data_name(row): row["stress_ratio"]
        for row in _first_seeds(results, table)
        if pd.notna(row["stress_ratio"])
    }


def uci_caption(results: pd.DataFrame, table: UciTable) -> str:
    """Write the caption of a figure: what was done to how many rows, and the ratios.

    Parameters
    ----------
    results : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    table : UciTable
        The table.

    Returns
    -------
    str
    """
    rows = _first_seeds(results, table)
    parts = []
    if rows:
        parts.append(
            f"{table.title}: {int(rows[0]['n_samples'])} rows, "
            f"{int(rows[0]['n_control_points'])} control points (crosses), seed projector "
            f"{table.method}; left before, right after optimization."
        )
        ratios = "; ".join(f"{data_name(row)} {_ratios(row)}" for row in rows)
        parts.append(f"Stress after / before by Eq. 4.1 (scale-normalised): {ratios}.")
        if table.published_ratio is not None:
            parts.append(f"Published: {table.published_ratio:.2f}, scaling of the data not stated.")
    remark = published(table.item).note if table.item in published_ids() else ""
    parts += [
        TWO_STEPS,
        table.note,
        remark,
        describe_failures(results[results["dataset"] == table.dataset]),
    ]
    return " ".join(part for part in parts if part)


def uci_alt(results: pd.DataFrame, table: UciTable) -> str:
    """Say what a reader who does not see the figure should know."""
    parts = [
        f"Scatter plots of {table.title} projected by RBFP from {table.method} seeds, before "
        "optimization on the left and after it on the right."
    ]
    for row in _first_seeds(results, table):
        parts.append(
            f"With {data_name(row)} the mean error falls from {row['projected_error']:.3g} to "
            f"{row['error']:.3g}, and stress by Eq. 4.1 goes from {row['projected_stress']:.3g} to "
            f"{row['stress']:.3g}."
        )
    return " ".join(parts)


def data_name(row: dict[Any, Any]) -> str:
    """Say what a run was computed on."""
    return "standardised data" if row["standardize"] else "data as they are"


def _first_seeds(results: pd.DataFrame, table: UciTable) -> list[dict[Any, Any]]:
    return finished(results, table).drop_duplicates("standardize").to_dict("records")


def _ratios(row: dict[Any, Any]) -> str:
    names = ("stress_ratio", "scale_normalized_stress_ratio")
    one, other = ("none" if pd.isna(row[name]) else f"{row[name]:.2g}" for name in names)
    return f"{one} ({other})"
