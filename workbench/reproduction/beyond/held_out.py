"""Runs that judge raw and optimized projections by samples that were held out."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import pandas as pd

from workbench.errors import WorkbenchError
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.held_out import HeldOutRun
from workbench.reproduction import profiles
from workbench.reproduction.costa2018.keyframe_errors import RATIO

#: Projectors by their names in Table 5.1 of Costa 2018.
PROJECTORS = {
    "PCA": "pca",
    "MDS": "mds",
    "Isomap": "isomap",
    "LLE": "lle",
    "Force": "force",
    "t-SNE": "tsne",
}
#: Without Page blocks, whose 5473 rows take longer than all others together.
TABLES = (
    "uci/iris",
    "uci/wine",
    "uci/seeds",
    "uci/ionosphere",
    "uci/cloud",
    "uci/yeast",
)

#: Share of control points at which tables are judged too: 3 % of Iris are three rows.
TABLE_RATIO = 0.1

#: The quick profile takes what is bundled and what is projected fast, the shortest clips, and
#: tables at one share of control points.
_QUICK_PROJECTORS = ("PCA", "Isomap")
_QUICK_TABLES = ("uci/iris", "uci/wine", "uci/ionosphere")
_QUICK_CLIPS = 4


def planned_runs(
    profile: str,
    seed: int,
    *,
    clips: Iterable[str] | None = None,
    tables: Iterable[str] | None = None,
    projectors: Iterable[str] | None = None,
) -> list[Run]:
    """List the runs that the notebook reads.

    Parameters
    ----------
    profile : {"quick", "full"}
        Which data and projectors.
    seed : int
        Seed of the splits, of the control points of tables and of projectors.
    clips, tables, projectors : iterable of str, optional
        In place of the profile's.

    Returns
    -------
    list of Run
    """
    return list(
        held_out_runs(
            profiles.some_clips(profile, _QUICK_CLIPS) if clips is None else clips,
            tables_of(profile) if tables is None else tables,
            projectors=projectors_of(profile) if projectors is None else projectors,
            seed=seed,
            table_ratios=table_ratios_of(profile),
        )
    )


def held_out_runs(
    clips: Iterable[str],
    tables: Iterable[str],
    *,
    projectors: Iterable[str],
    seed: int,
    table_ratios: Sequence[float] = (RATIO, TABLE_RATIO),
) -> list[HeldOutRun]:
    """List the runs on clips, split in two ways, and on tables, raw and standardised.

    Parameters
    ----------
    clips, tables : iterable of str
        Names of data sets.
    projectors : iterable of str
        Some of :data:`PROJECTORS`.
    seed : int
        Another one draws another split, and other control points of tables.
    table_ratios : sequence of float
        Shares of control points for tables.

    Returns
    -------
    list of HeldOutRun

    Raises
    ------
    WorkbenchError
        If a projector is unknown.
    """
    names = list(projectors)
    for name in names:
        if name not in PROJECTORS:
            raise WorkbenchError(f"projectors: got {name!r}, want some of {', '.join(PROJECTORS)}")
    methods = [PROJECTORS[name] for name in names]
    return [
        HeldOutRun(clip, projector, split=split, ratio=RATIO, seed=seed)
        for clip in clips
        for projector in methods
        for split in ("blocks", "random")
    ] + [
        HeldOutRun(table, projector, ratio=ratio, seed=seed, standardized=standardized)
        for table in tables
        for projector in methods
        for standardized in (False, True)
        for ratio in table_ratios
    ]


def tables_of(profile: str) -> list[str]:
    """Choose the tables of a profile that are on this machine."""
    tables = _QUICK_TABLES if profile == "quick" else TABLES
    absent = profiles.absent_tables(tables)
    return [table for table in tables if table not in absent]


def projectors_of(profile: str) -> list[str]:
    """Choose the projectors of a profile."""
    return list(_QUICK_PROJECTORS if profile == "quick" else PROJECTORS)


def table_ratios_of(profile: str) -> list[float]:
    """Choose the shares of control points of tables."""
    return [RATIO] if profile == "quick" else [RATIO, TABLE_RATIO]


def other_ratios(table: pd.DataFrame) -> list[float]:
    """List the shares of control points, beside the usual one, at which runs have finished."""
    done = table[table["status"] == "done"]
    return sorted(set(done["ratio"]) - {RATIO})
