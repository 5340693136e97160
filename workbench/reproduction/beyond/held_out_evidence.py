"""Claims about held-out samples, and what the gain on them depends on."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pandas as pd

from workbench.experiments.bootstrap import Estimate
from workbench.experiments.grid import describe_failures
from workbench.reproduction.beyond.held_out_comparison import (
    ALL,
    MEAN_SAMPLE,
    RAW_TABLES,
    STANDARDIZED_TABLES,
    STRETCHES,
    as_table,
    by_setting,
    estimate,
    finished,
    log_ratio,
    median_ratio,
)
from workbench.reproduction.claims import Evidence

#: Settings that decide claims: of frames drawn one by one, the neighbours were seen.
_DECISIVE = (STRETCHES, RAW_TABLES, STANDARDIZED_TABLES)

#: The two errors whose ratio decides each claim.
_CLAIMS = {
    "ours:helps-on-held-out": ("error_alg12_mean", "error_raw_mean"),
    "ours:beats-nearest-neighbour-held-out": ("error_alg12_mean", "error_plane_nearest"),
    "ours:beats-mean-of-neighbours-held-out": ("error_alg12_mean", "error_plane_mean"),
    "ours:beats-nearest-control-point-held-out": ("error_alg12_mean", "error_plane_control"),
    "ours:beats-own-inverse-held-out": ("error_alg12_mean", "error_inverse"),
}


def evidence(table: pd.DataFrame) -> dict[str, Evidence]:
    """Give the evidence on the claims about held-out samples.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    dict of str to Evidence
        By claim; over data sets, clips with whole stretches held out. The note tells the
        settings apart.
    """
    rows = finished(table)
    decisive = rows[rows["setting"].isin(_DECISIVE)]
    found = {}
    for claim, columns in _CLAIMS.items():
        medians = {setting: median_ratio(some, *columns) for setting, some in by_setting(rows)}
        note = "; ".join(
            f"{setting}: {value:.2f}" for setting, value in medians.items() if np.isfinite(value)
        )
        found[claim] = Evidence(
            estimate(decisive, *columns), units="data sets", note=f"Medians by setting: {note}."
        )
    return found


def explanation_table(rows: pd.DataFrame) -> pd.DataFrame:
    """Look for what the gain on held-out samples depends on.

    Parameters
    ----------
    rows : DataFrame
        From :func:`finished`.

    Returns
    -------
    DataFrame
        One row for each setting. Medians of the ratios over runs: of the error of training
        samples, of held-out ones, and of held-out ones that move by their own error, each
        over that of raw positions; and of the share of positions that the neighbours leave
        open. Then Spearman's rank correlations, over runs, of the held-out ratio with that
        of what is left open, and with the distance to the nearest training sample.
    """
    described = {}
    for setting, some in by_setting(rows):
        held_out = log_ratio(some, "error_alg12_mean", "error_raw_mean")
        open_part = log_ratio(some, "unexplained_alg12", "unexplained_raw")
        distance = log_ratio(some, "error_data_nearest", MEAN_SAMPLE)
        described[setting] = {
            ("error / raw", "training"): median_ratio(
                some, "training_error_alg12", "training_error_raw"
            ),
            ("error / raw", "held out"): median_ratio(some, "error_alg12_mean", "error_raw_mean"),
            ("error / raw", "held out, looking at the answer"): median_ratio(
                some, "error_self_placed", "error_raw_mean"
            ),
            ("positions that neighbours leave open", "optimized / raw"): float(
                np.exp(open_part.median())
            ),
            ("rank correlation of the held-out ratio with", "what is left open"): _rank_correlation(
                held_out, open_part
            ),
            (
                "rank correlation of the held-out ratio with",
                "distance to the known",
            ): _rank_correlation(held_out, distance),
            ("", "runs"): len(some),
        }
    return as_table(described, "setting")


def _rank_correlation(first: pd.Series, second: pd.Series) -> float:
    """Compute Spearman's correlation; NaN where one does not vary, which defines none."""
    if first.nunique() < 2 or second.nunique() < 2:
        return math.nan
    return float(first.corr(second, method="spearman"))


def describe_data(table: pd.DataFrame) -> str:
    """Say in a sentence what data were used, and what failed."""
    rows = finished(table)
    names = rows.drop_duplicates("dataset")["dataset"]
    tables = [name.removeprefix("uci/") for name in names if name.startswith("uci/")]
    clips = [name.removeprefix("cmu/") for name in names if not name.startswith("uci/")]
    parts = [
        f"{len(found)} {kind}{'' if len(found) == 1 else 's'} ({', '.join(found)})"
        for kind, found in (("CMU clip", clips), ("UCI table", tables))
        if found
    ]
    text = f"{' and '.join(parts)}; 70 % of the samples to train with."
    return f"{text} {describe_failures(table)}".strip()


def in_words(panels: Mapping[str, Mapping[str, Mapping[str, Estimate]]]) -> str:
    """Say the estimates of a figure, for those who do not see it.

    Parameters
    ----------
    panels : mapping of str to mapping of str to mapping of str to Estimate
        By panel, series and row. Of rows for single projectors only that of all is said.

    Returns
    -------
    str
    """
    sentences = []
    for title, panel in panels.items():
        said = [
            f"{series if row == ALL else row} {found.value:.2f}"
            for series, by_row in panel.items()
            for row, found in by_row.items()
            if row == ALL or ALL not in by_row
        ]
        sentences.append(f"{title}: {', '.join(said)}.")
    return " ".join(sentences)
