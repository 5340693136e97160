"""Table 5.3 of Costa 2018: stress of projected tables after optimization over stress before."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from workbench.experiments.bootstrap import bootstrap
from workbench.experiments.grid import describe_failures
from workbench.experiments.runs.schemes import scheme_name
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.results import PROJECTORS
from workbench.reproduction.costa2018.uci_projections import (
    TABLE_5_3,
    TWO_STEPS,
    data_name,
    finished,
    scheme_of,
)
from workbench.reproduction.costa2018.uci_tables import UCI_TABLES, UciTable
from workbench.reproduction.published import published

EQ_4_1 = "stress_ratio"
SCALE_NORMALIZED = "scale_normalized_stress_ratio"

#: Claims, the formula that decides them, and whether the data are standardised.
CLAIMS = (
    ("costa2018:uci-stress-falls-raw", EQ_4_1, False),
    ("costa2018:uci-stress-falls-standardized", EQ_4_1, True),
    ("costa2018:uci-stress-falls-raw-normalized", SCALE_NORMALIZED, False),
    ("costa2018:uci-stress-falls-standardized-normalized", SCALE_NORMALIZED, True),
)

_NAMES = {EQ_4_1: "Eq. 4.1", SCALE_NORMALIZED: "scale-normalised"}


def ratios_of(
    results: pd.DataFrame, column: str = EQ_4_1, *, standardize: bool
) -> dict[tuple[str, str], list[float]]:
    """Gather stress ratios by table and seed projector, one for each seed."""
    done = results[(results["status"] == "done") & (results["standardize"] == standardize)]
    known = done.dropna(subset=column).sort_values("seed")
    by_run = {
        run: rows.astype(float).tolist()
        for run, rows in known.groupby(["dataset", "scheme"])[column]
    }
    names = {method: scheme_name(scheme_of(method)) for method in PROJECTORS}
    found = {
        (table.title, method): by_run.get((table.dataset, name), [])
        for table in UCI_TABLES
        for method, name in names.items()
    }
    return {run: values for run, values in found.items() if values}


def table_5_3(results: pd.DataFrame, *, standardize: bool) -> pd.DataFrame:
    """Set our Table 5.3 beside the published one.

    Parameters
    ----------
    results : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    standardize : bool
        Which of our runs: on data as they are or with columns at unit variance.

    Returns
    -------
    DataFrame
        One row for each table and seed projector that has finished: the median over seeds by
        Eq. 4.1 and its range, the published value and the difference, the median by the
        scale-normalised formula and its range, and the error after optimization over before.
    """
    theirs = published(TABLE_5_3).table().astype(float)
    others = ratios_of(results, SCALE_NORMALIZED, standardize=standardize)
    rows: dict[str, dict[tuple[str, str], Any]] = {}
    for (title, method), values in ratios_of(results, standardize=standardize).items():
        median, printed = float(np.median(values)), theirs[method][title]
        normalized = others.get((title, method), [np.nan])
        rows[f"{title}, {method}"] = {
            ("Eq. 4.1", "ours"): median,
            ("Eq. 4.1", "published"): printed,
            ("Eq. 4.1", "difference"): median - printed,
            ("Eq. 4.1", "lowest"): min(values),
            ("Eq. 4.1", "highest"): max(values),
            ("scale-normalised", "ours"): float(np.median(normalized)),
            ("scale-normalised", "lowest"): min(normalized),
            ("scale-normalised", "highest"): max(normalized),
            ("error", "after / before"): _error_ratio(results, title, method, standardize),
            ("seeds", ""): len(values),
        }
    frame = pd.DataFrame.from_dict(rows, orient="index")
    if rows:
        frame.columns = pd.MultiIndex.from_tuples(list(next(iter(rows.values()))))
    frame.index.name = "table, seed projector"
    return frame


def ratio_panels(results: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Arrange published and our ratios as Table 5.3 does, for the figure."""
    theirs = published(TABLE_5_3).table()[list(PROJECTORS)]
    panels = {"published, Eq. 4.1": theirs}
    for column, name in _NAMES.items():
        for standardize in (False, True):
            ours = pd.DataFrame(np.nan, index=theirs.index, columns=theirs.columns)
            found = ratios_of(results, column, standardize=standardize)
            for (title, method), values in found.items():
                ours.loc[title, method] = float(np.median(values))
            if found:
                data = data_name({"standardize": standardize})
                panels[f"ours, {data}, {name}"] = ours.dropna(how="all")
    return panels


def ratio_alt(results: pd.DataFrame) -> str:
    """Say what a reader who does not see the figure of all ratios should know."""
    parts = ["Tables of stress ratios, one cell for each data set and seed projector."]
    for name, panel in ratio_panels(results).items():
        values = panel.to_numpy(dtype=float)
        values = values[np.isfinite(values)]
        parts.append(
            f"{name[0].upper()}{name[1:]}: median {np.median(values):.2f}, "
            f"{(values < 1).sum()} of {len(values)} below 1."
        )
    return " ".join(parts)


def stress_evidence(results: pd.DataFrame, column: str, *, standardize: bool) -> Evidence:
    """Estimate what optimization does to the stress of tables.

    The geometric mean over projectors, median over tables, from those tables that all
    projectors have finished on. Seeds are averaged first, since the largest table has one.

    Parameters
    ----------
    results : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    column : str
        :data:`EQ_4_1` or :data:`SCALE_NORMALIZED`.
    standardize : bool
        Which runs.

    Returns
    -------
    Evidence
    """
    found = ratios_of(results, column, standardize=standardize)
    titles, logarithms = [], []
    for table in UCI_TABLES:
        values = [found.get((table.title, method)) for method in PROJECTORS]
        complete = [np.mean(np.log(ratios)) for ratios in values if ratios]
        if len(complete) == len(PROJECTORS):
            titles.append(table.title)
            logarithms.append(complete)
    if not titles:
        return Evidence(None, "tables", "No table was run with all six projectors.")
    return Evidence(
        bootstrap(logarithms, _median_of_means),
        "tables",
        f"{', '.join(titles)}. {_falling(found)}",
    )


def describe_tables(results: pd.DataFrame, tables: Iterable[UciTable] = UCI_TABLES) -> str:
    """Say which tables were used with how many rows and seeds, which are missing, and how."""
    sizes = results[results["status"] == "done"].groupby("dataset")
    used, missing = [], []
    for table in tables:
        if table.dataset in sizes.groups:
            rows = sizes.get_group(table.dataset)
            seeds = rows["seed"].nunique()
            used.append(
                f"{table.title} ({int(rows['n_samples'].iloc[0])} rows, {seeds} "
                f"{'seed' if seeds == 1 else 'seeds'})"
            )
        else:
            missing.append(table.title)
    parts = [f"{len(used)} of 7 tables: {', '.join(used)}." if used else "No table."]
    if missing:
        parts.append(f"Not here: {', '.join(missing)}.")
    parts += [TWO_STEPS, describe_failures(results)]
    return " ".join(part for part in parts if part)


def _median_of_means(logarithms: NDArray[np.float64]) -> float:
    return float(np.exp(np.median(logarithms.mean(axis=1))))


def _falling(found: dict[tuple[str, str], list[float]]) -> str:
    below = sum(float(np.median(values)) < 1.0 for values in found.values())
    return f"It falls on {below} of {len(found)} pairs of table and projector."


def _error_ratio(results: pd.DataFrame, title: str, method: str, standardize: bool) -> float:
    table = next(table for table in UCI_TABLES if table.title == title)
    rows = finished(results, table, method)
    rows = rows[(rows["standardize"] == standardize) & (rows["projected_error"] > 0)]
    return float((rows["error"] / rows["projected_error"]).median())
