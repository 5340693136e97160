"""Figures 5.12 to 5.17 of Costa 2018: tables projected, and optimized."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import pandas as pd

from workbench.experiments.grid import describe_failures
from workbench.experiments.runs.schemes import Scheme, SchemeRun, scheme_name
from workbench.experiments.store import ResultStore
from workbench.figures.embeddings import Panel
from workbench.reproduction.published import published, published_ids
from workbench.schemes import SpatialScheme

#: Share of the rows that are control points.
RATIO = 0.03


@dataclass(frozen=True)
class UciFigure:
    """A figure of a table projected raw and optimized.

    Attributes
    ----------
    item : str
        Id of the figure.
    dataset : str
        Name of the table.
    title : str
        What the thesis calls it.
    projector : str
        Registered name of the projector used here.
    method : str
        What the projector is called.
    note : str
        How it differs from the thesis, beyond being projected in one step.
    """

    item: str
    dataset: str
    title: str
    projector: str
    method: str
    note: str = ""

    @property
    def raw(self) -> SpatialScheme:
        """The scheme without optimization."""
        return SpatialScheme(self.projector, selector="random")

    @property
    def optimized(self) -> SpatialScheme:
        """The scheme with the optimizer of Alg. 12."""
        return SpatialScheme(self.projector, selector="random", optimizer="alg12")

    @property
    def published_ratio(self) -> float | None:
        """The stress ratio in the caption of the published figure."""
        return published(self.item).value if self.item in published_ids() else None


UCI_FIGURES = (
    UciFigure("costa2018:fig5.12", "uci/ionosphere", "Ionosphere", "mds", "MDS"),
    UciFigure("costa2018:fig5.13", "uci/iris", "Iris", "isomap", "Isomap"),
    UciFigure("costa2018:fig5.14", "uci/seeds", "Seeds", "lle", "LLE"),
    UciFigure("costa2018:fig5.15", "uci/wine", "Wine", "force", "Force"),
    UciFigure("costa2018:fig5.16", "uci/page-blocks", "Page blocks", "pca", "PCA"),
    UciFigure("costa2018:fig5.17", "uci/yeast", "Yeast", "tsne", "t-SNE"),
    UciFigure(
        "extra:uci-cloud",
        "uci/cloud",
        "Cloud",
        "lle",
        "LLE",
        "Not a figure of the thesis, whose Table 5.3 reports a change for this table with LLE.",
    ),
)

#: What every caption of these figures has to say.
ONE_STEP = (
    "One-step projection, not the two-step RBFP of the thesis, and control points are a seeded "
    "random sample of 3 %, not chosen by ROLS: the ratios show the effect of the optimizer, "
    "they do not repeat the published experiment."
)


def uci_runs(figures: Iterable[UciFigure], *, seed: int = 0) -> list[SchemeRun]:
    """List the runs of figures: raw and optimized, on data as they are and standardised.

    Parameters
    ----------
    figures : iterable of UciFigure
        Those whose data are there.
    seed : int
        Seed of the control points and of the projectors that take one.

    Returns
    -------
    list of SchemeRun
    """
    return [
        SchemeRun(figure.dataset, scheme, ratio=RATIO, seed=seed, standardize=standardize)
        for figure in figures
        for standardize in (False, True)
        for scheme in (figure.raw, figure.optimized)
    ]


def uci_panels(table: pd.DataFrame, figure: UciFigure, store: ResultStore) -> list[Panel]:
    """Read the embeddings of a figure: raw beside optimized, data as they are above standardised.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    figure : UciFigure
        The figure.
    store : ResultStore
        Where the grid kept its results.

    Returns
    -------
    list of Panel
        Only those whose run is finished.
    """
    panels = []
    for row in _finished(table, figure, figure.optimized):
        arrays = store.arrays(row["key"])
        control = arrays["control_points"]
        panels += [
            Panel(f"{figure.method}, {_data(row)}", arrays["projected"], control),
            Panel(f"optimized, {_data(row)}", arrays["embedding"], control),
        ]
    return panels


def uci_table(table: pd.DataFrame, figures: Iterable[UciFigure]) -> pd.DataFrame:
    """Compare embeddings of tables before and after optimization.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    figures : iterable of UciFigure
        The rows, two for each.

    Returns
    -------
    DataFrame
        Stress ratio by Eq. 4.1, the published one, the scale-normalised one, and error and
        neighbourhood quality before and after.
    """
    rows: dict[str, dict[tuple[str, str], Any]] = {}
    for figure in figures:
        raw = {row["standardize"]: row for row in _finished(table, figure, figure.raw)}
        for row in _finished(table, figure, figure.optimized):
            rows[f"{figure.title}, {figure.method}, {_data(row)}"] = {
                ("samples", "all"): int(row["n_samples"]),
                ("samples", "control"): int(row["n_control_points"]),
                ("stress, after / before", "Eq. 4.1"): row["stress_ratio"],
                ("stress, after / before", "published"): figure.published_ratio,
                ("stress, after / before", "scale-normalised"): row[
                    "scale_normalized_stress_ratio"
                ],
                ("error", "before"): raw.get(row["standardize"], {}).get("error"),
                ("error", "after"): row["error"],
                ("trustworthiness", "before"): row["projected_trustworthiness"],
                ("trustworthiness", "after"): row["trustworthiness"],
                ("continuity", "before"): row["projected_continuity"],
                ("continuity", "after"): row["continuity"],
                ("neighbours kept", "before"): row["projected_neighborhood_preservation"],
                ("neighbours kept", "after"): row["neighborhood_preservation"],
            }
    result = pd.DataFrame.from_dict(rows, orient="index")
    if rows:
        result.columns = pd.MultiIndex.from_tuples(list(next(iter(rows.values()))))
    result.index.name = "table, projector, data"
    return result


def uci_ratios(table: pd.DataFrame, figure: UciFigure) -> dict[str, float]:
    """Give the stress ratios (Eq. 4.1) of a figure by what they were computed on.

    Data whose projection had no stress have none.
    """
    rows = _finished(table, figure, figure.optimized)
    return {
        f"one step, {_data(row)}": row["stress_ratio"]
        for row in rows
        if pd.notna(row["stress_ratio"])
    }


def uci_caption(table: pd.DataFrame, figure: UciFigure) -> str:
    """Write the caption of a figure: what was done to how many rows, and the ratios.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    figure : UciFigure
        The figure.

    Returns
    -------
    str
    """
    rows = _finished(table, figure, figure.optimized)
    parts = []
    if rows:
        parts.append(
            f"{figure.title}: {int(rows[0]['n_samples'])} rows, "
            f"{int(rows[0]['n_control_points'])} control points (crosses), projected by "
            f"{figure.method}."
        )
        ratios = ", ".join(
            f"{'none' if pd.isna(row['stress_ratio']) else format(row['stress_ratio'], '.2f')} "
            f"on {_data(row)}"
            for row in rows
        )
        parts.append(f"Stress (Eq. 4.1) after / before optimization: {ratios}.")
    remark = published(figure.item).note if figure.item in published_ids() else ""
    parts += [
        ONE_STEP,
        figure.note,
        remark,
        describe_failures(table[table["dataset"] == figure.dataset]),
    ]
    return " ".join(part for part in parts if part)


def _finished(table: pd.DataFrame, figure: UciFigure, scheme: Scheme) -> list[dict[Any, Any]]:
    """Find the finished runs of a scheme on a figure's table, unscaled data first."""
    rows = table[
        (table["status"] == "done")
        & (table["dataset"] == figure.dataset)
        & (table["scheme"] == scheme_name(scheme))
    ]
    return rows.sort_values("standardize").to_dict("records")


def _data(row: dict[Any, Any]) -> str:
    return "standardised data" if row["standardize"] else "data as they are"
