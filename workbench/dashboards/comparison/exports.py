"""What a comparison shows as a table and as a page that needs no kernel."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from workbench.dashboards.comparison.comparison_view import ComparisonView
from workbench.dashboards.comparison.jobs import LOCAL_MEASURES, PanelResult
from workbench.dashboards.comparison.summaries import Summary

if TYPE_CHECKING:
    import pandas as pd


def results_table(
    summary: Summary, results: Mapping[str, PanelResult], selection: np.ndarray
) -> pd.DataFrame:
    """Put positions and local qualities of all panels in a table, one row for each sample.

    Parameters
    ----------
    summary : Summary
        The samples.
    results : mapping of str to PanelResult
        By the letters of panels.
    selection : ndarray of shape (n_selected,)
        Selected samples.

    Returns
    -------
    pandas.DataFrame
        Columns ``sample``, ``class`` (where there are classes), ``selected``,
        ``control point``, and for each panel ``A x``, ``A y`` and ``A stress`` and so on.
    """
    import pandas as pd

    samples = np.arange(summary.n_samples)
    columns: dict[str, object] = {"sample": samples}
    if summary.class_names:
        columns["class"] = np.array(summary.class_names)[summary.classes]
    columns["selected"] = np.isin(samples, selection)
    control = next((result.control_points for result in results.values()), np.empty(0))
    columns["control point"] = np.isin(samples, control)
    for letter, result in results.items():
        columns[f"{letter} x"], columns[f"{letter} y"] = result.embedding.T
        for name in LOCAL_MEASURES:
            columns[f"{letter} {name}"] = result.local[name]
    return pd.DataFrame(columns)


def comparison_page(view: ComparisonView, summary: Summary | None) -> str:
    """Write the views as one HTML page that stays interactive without a kernel."""
    from workbench.widgets.export import html_page

    beside = view.pose if view.pose.layout.display is None else view.details
    name = summary.name if summary else "no data"
    return html_page(
        [[view.scatter, beside], view.quality.table, view.quality.curves],
        title=f"Projections of {name}",
        text="Drag in a panel to mark samples: the same ones are marked in all panels. Hover "
        "one to see what it is. Crosses are control points.",
    )
