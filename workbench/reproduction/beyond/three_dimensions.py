"""Embeddings in three dimensions: what the third coordinate gains, and what it costs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from workbench.experiments.runs.base import Run
from workbench.experiments.runs.before_after import BeforeAfterRun
from workbench.experiments.runs.compaction import CompactionRun
from workbench.experiments.runs.equal_size import EqualSizeRun
from workbench.experiments.runs.schemes import scheme_name
from workbench.experiments.statistics import boxplot_statistics
from workbench.figures.boxplots import Box
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.compression import RATIO, clips_of
from workbench.reproduction.costa2018.results import evidence_of
from workbench.reproduction.profiles import absent_tables
from workbench.schemes import SpatialScheme

#: Schemes in two dimensions; those of section 5.1 are the same, so they are run once.
FLAT = {
    name: SpatialScheme(projector, selector="uniform", optimizer="alg12")
    for name, projector in (
        ("t-SNE", "tsne"),
        ("Isomap", "isomap"),
        ("MDS", "mds"),
        ("PCA", "pca"),
    )
}
#: The same in three.
SOLID = {name: replace(scheme, dimensions=3) for name, scheme in FLAT.items()}

#: The projector that decides the claims.
DECIDING = "t-SNE"
_QUICK = ("t-SNE", "PCA")

#: Tables, which take a larger share of control points: 3 % of Iris are four, as many as a
#: space of three dimensions needs to be spanned.
TABLES = ("uci/iris", "uci/wine", "uci/seeds", "uci/ionosphere")
_QUICK_TABLES = ("uci/iris", "uci/wine")
TABLE_RATIO = 0.1

#: Clips, the first of those of section 5.1; three dimensions take t-SNE several times as long.
_N_CLIPS = {"quick": 1, "full": 10}

EQUAL_KEYFRAMES = "equal keyframes"
EQUAL_BYTES = "equal bytes"


def planned_runs(profile: str, seed: int) -> list[Run]:
    """List the runs that the notebook reads for its default parameters."""
    tables = _QUICK_TABLES if profile == "quick" else TABLES
    absent = absent_tables(tables)
    found = [name for name in tables if name not in absent]
    return dimension_runs(clips_of(profile)[: _N_CLIPS[profile]], found, profile, seed=seed)


def dimension_runs(
    clips: Iterable[str], tables: Iterable[str], profile: str, *, seed: int = 0
) -> list[Run]:
    """List the runs in two and three dimensions, at equal keyframes and at equal bytes.

    Parameters
    ----------
    clips, tables : iterable of str
        Names of data sets.
    profile : {"quick", "full"}
        How many projectors.
    seed : int
        Seed of the projectors and selectors that take one.

    Returns
    -------
    list of Run
    """
    names = _QUICK if profile == "quick" else tuple(FLAT)
    runs: list[Run] = []
    for clip in clips:
        for name in names:
            runs += [
                CompactionRun(clip, FLAT[name], ratio=RATIO, seed=seed),
                CompactionRun(clip, SOLID[name], ratio=RATIO, seed=seed),
                EqualSizeRun(clip, FLAT[name], SOLID[name], RATIO, seed=seed),
            ]
    runs += [
        BeforeAfterRun(
            table,
            replace(scheme, selector="rols"),
            ratio=TABLE_RATIO,
            seed=seed,
            standardize=True,
        )
        for table in tables
        for name in names
        for scheme in (FLAT[name], SOLID[name])
    ]
    return runs


def compare_dimensions(results: pd.DataFrame) -> pd.DataFrame:
    """Set every clip and projector in three dimensions beside two.

    Parameters
    ----------
    results : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        One row for each clip and projector whose three runs have finished: ``clip``,
        ``projector``, ``flat_error``, ``solid_error``, ``flat_bytes``, ``solid_bytes``,
        ``equal_keyframes`` (how many two dimensions have at equal bytes), ``equal_error``,
        and the ratios three over two, ``equal keyframes``, ``equal bytes`` and ``size``.
        Errors are those of what the files give.
    """
    done = results[results["status"] == "done"]
    rows = []
    for name in FLAT:
        flat, solid = (_compactions(done, schemes[name]) for schemes in (FLAT, SOLID))
        equal = done[(done["kind"] == "equal size") & (done["scheme"] == scheme_name(FLAT[name]))]
        if "reference" in equal:
            equal = equal[equal["reference"] == scheme_name(SOLID[name])]
        equal = equal.set_index("dataset")
        for clip in [c for c in flat.index if c in solid.index and c in equal.index]:
            rows.append(
                {
                    "clip": clip,
                    "projector": name,
                    "keyframes": int(flat["n_control_points"][clip]),
                    "flat_error": flat["file_error"][clip],
                    "solid_error": solid["file_error"][clip],
                    "flat_bytes": int(flat["bytes"][clip]),
                    "solid_bytes": int(solid["bytes"][clip]),
                    "equal_keyframes": int(equal["n_control_points"][clip]),
                    "equal_error": equal["file_error"][clip],
                    EQUAL_KEYFRAMES: solid["file_error"][clip] / flat["file_error"][clip],
                    EQUAL_BYTES: solid["file_error"][clip] / equal["file_error"][clip],
                    "size": solid["bytes"][clip] / flat["bytes"][clip],
                }
            )
    columns = ["clip", "projector", EQUAL_KEYFRAMES, EQUAL_BYTES, "size"]
    return pd.DataFrame(rows) if rows else pd.DataFrame(columns=columns)


def dimension_table(compared: pd.DataFrame) -> pd.DataFrame:
    """Summarize per projector what the third dimension does, over clips.

    Parameters
    ----------
    compared : DataFrame
        From :func:`compare_dimensions`.

    Returns
    -------
    DataFrame
        One row for each projector.
    """
    rows: dict[str, dict[tuple[str, str], Any]] = {}
    for name, group in compared.groupby("projector", sort=False):
        rows[str(name)] = {
            ("median error", "2-D"): group["flat_error"].median(),
            ("median error", "3-D"): group["solid_error"].median(),
            ("3-D / 2-D, equal keyframes", "median"): group[EQUAL_KEYFRAMES].median(),
            ("3-D / 2-D, equal keyframes", "lower on"): _below(group[EQUAL_KEYFRAMES]),
            ("bytes", "3-D / 2-D"): group["size"].median(),
            ("bytes", "more keyframes in 2-D, %"): 100
            * (group["equal_keyframes"] / group["keyframes"] - 1).median(),
            ("3-D / 2-D, equal bytes", "median"): group[EQUAL_BYTES].median(),
            ("3-D / 2-D, equal bytes", "lower on"): _below(group[EQUAL_BYTES]),
        }
    frame = pd.DataFrame.from_dict(rows, orient="index")
    if rows:
        frame.columns = pd.MultiIndex.from_tuples(list(next(iter(rows.values()))))
    frame.index.name = "projector"
    return frame


def dimension_boxes(compared: pd.DataFrame) -> dict[str, dict[str, Box]]:
    """Compute the boxes of the figure: error in three dimensions over that in two."""
    return {
        kind: {
            str(name): boxplot_statistics(group[kind])
            for name, group in compared.groupby("projector", sort=False)
        }
        for kind in (EQUAL_KEYFRAMES, EQUAL_BYTES)
    }


def table_errors(results: pd.DataFrame) -> pd.DataFrame:
    """Compare errors on tables in two and three dimensions, before and after optimization.

    Parameters
    ----------
    results : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        One row for each table and projector whose runs have finished.
    """
    done = results[(results["status"] == "done") & results["standardize"].astype(bool)]
    rows: dict[str, dict[tuple[str, str], float]] = {}
    for dataset in dict.fromkeys(done["dataset"]):
        for name in FLAT:
            found = [
                done[
                    (done["dataset"] == dataset)
                    & (done["scheme"] == scheme_name(replace(scheme, selector="rols")))
                ]
                for scheme in (FLAT[name], SOLID[name])
            ]
            if any(part.empty for part in found):
                continue
            flat, solid = (part.iloc[0] for part in found)
            rows[f"{dataset.removeprefix('uci/')}, {name}"] = {
                ("before", "2-D"): flat["projected_error"],
                ("before", "3-D"): solid["projected_error"],
                ("before", "3-D / 2-D"): solid["projected_error"] / flat["projected_error"],
                ("optimized", "2-D"): flat["error"],
                ("optimized", "3-D"): solid["error"],
                ("optimized", "3-D / 2-D"): solid["error"] / flat["error"],
            }
    frame = pd.DataFrame.from_dict(rows, orient="index")
    if rows:
        frame.columns = pd.MultiIndex.from_tuples(list(next(iter(rows.values()))))
    frame.index.name = "table, projector"
    return frame


def dimension_evidence(compared: pd.DataFrame, kind: str) -> Evidence:
    """Give the error of t-SNE in three dimensions over two, at equal keyframes or bytes."""
    ratios = compared.loc[compared["projector"] == DECIDING, kind].astype(float)
    return evidence_of(
        ratios,
        lambda values: float(np.median(values)),
        f"Lower on {_below(ratios)} clips." if len(ratios) else "",
    )


def _compactions(done: pd.DataFrame, scheme: SpatialScheme) -> pd.DataFrame:
    chosen = (done["kind"] == "spatial") & (done["scheme"] == scheme_name(scheme))
    chosen &= done["ratio"] == RATIO
    return done[chosen].set_index("dataset")


def _below(ratios: pd.Series) -> str:
    return f"{int((ratios < 1).sum())} of {len(ratios)}"
