"""Show the quality of embeddings: a table with the best values marked, and a figure."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from html import escape
from typing import TYPE_CHECKING

import ipywidgets as widgets
import numpy as np

from workbench.dashboards.session import PanelResult
from workbench.widgets import FigureView

if TYPE_CHECKING:
    import plotly.graph_objects as go

#: Names of the panels.
LETTERS = "ABCD"

_MEASURES: tuple[tuple[str, str, bool, Callable[[PanelResult], float]], ...] = (
    (
        "stress",
        "Costa 2018, Eq. 4.1; depends on the scale of the embedding",
        False,
        lambda result: result.quality.stress,
    ),
    (
        "scale-normalised stress",
        "stress of the embedding at its best scale",
        False,
        lambda result: result.quality.scale_normalized_stress,
    ),
    (
        "trustworthiness",
        "how few false neighbours the embedding shows",
        True,
        lambda result: result.quality.trustworthiness,
    ),
    (
        "continuity",
        "how few neighbours the embedding tears apart",
        True,
        lambda result: result.quality.continuity,
    ),
    (
        "neighbourhood preservation",
        "share of the nearest neighbours that stay nearest",
        True,
        lambda result: result.quality.neighborhood_preservation,
    ),
    (
        "reconstruction error",
        "mean error of the samples back-projected from the embedding",
        False,
        lambda result: result.error,
    ),
)
_DASHES = ("solid", "dash", "dot", "dashdot")
_SYMBOLS = ("circle", "square", "diamond", "triangle-up")
_STYLE = """<style>
.wb-quality { overflow-x: auto; color: var(--jp-ui-font-color0, inherit); }
.wb-quality table { border-collapse: collapse; font-variant-numeric: tabular-nums; width: 100%; }
.wb-quality caption { text-align: left; color: var(--jp-ui-font-color1, inherit); padding: 4px 0; }
.wb-quality th, .wb-quality td { padding: 3px 8px; text-align: right; line-height: 1.35;
  border-bottom: 1px solid var(--jp-border-color2, #cccccc); }
.wb-quality thead th { vertical-align: bottom; font-weight: 600; }
.wb-quality tbody th { text-align: left; font-weight: 400; }
.wb-quality td { white-space: nowrap; }
.wb-quality caption { line-height: 1.35; }
.wb-quality td.best { font-weight: 700; }
.wb-quality td.best::before { content: "★ "; }
</style>"""


class QualityView:
    """A table of quality values and a figure of neighbourhood preservation against k.

    Attributes
    ----------
    table : ipywidgets.HTML
        One column for each panel.
    curves : FigureView
        One curve for each panel.
    """

    def __init__(self) -> None:
        self.table = widgets.HTML(layout=widgets.Layout(width="100%"))
        self.curves = FigureView()

    def show(self, titles: Sequence[str], results: Sequence[PanelResult | None]) -> None:
        """Show the results of the panels; None where there is none yet.

        Parameters
        ----------
        titles : sequence of str
            What each panel shows.
        results : sequence of PanelResult or None
            As many.
        """
        self.table.value = _STYLE + quality_table(titles, results)
        shown = [title for title, result in zip(titles, results, strict=True) if result]
        self.curves.description = f"Neighbourhood preservation against k of {'; '.join(shown)}"
        self.curves.figure = preservation_figure(titles, results).to_json()


def preservation_figure(titles: Sequence[str], results: Sequence[PanelResult | None]) -> go.Figure:
    """Draw neighbourhood preservation against k, one curve for each panel.

    A panel without a result has an empty curve, so that the others keep their colours.

    Parameters
    ----------
    titles : sequence of str
        What each panel shows.
    results : sequence of PanelResult or None
        As many.

    Returns
    -------
    plotly Figure
        Without colours; :class:`workbench.widgets.FigureView` gives them.
    """
    import plotly.graph_objects as go

    figure = go.Figure(layout={"template": "none"})
    for index, (title, result) in enumerate(zip(titles, results, strict=True)):
        figure.add_scatter(
            name=LETTERS[index],
            x=[] if result is None else result.k.tolist(),
            y=[] if result is None else result.preservation.tolist(),
            mode="lines+markers",
            line={"dash": _DASHES[index]},
            marker={"symbol": _SYMBOLS[index], "size": 6},
            hovertemplate=f"{escape(title)}<br>k = %{{x}}: %{{y:.3f}}<extra></extra>",
            showlegend=result is not None,
        )
    figure.update_layout(
        title={
            "text": "Neighbourhood preservation against k",
            "font": {"size": 14},
            "x": 0.02,
            "xanchor": "left",
        },
        xaxis={"title": {"text": "k, number of neighbours"}, "rangemode": "tozero"},
        yaxis={"title": {"text": "preserved share"}, "range": [0, 1.02]},
        font={"size": 12},
        height=300,
        margin={"l": 55, "r": 10, "t": 40, "b": 45},
        legend={"orientation": "h", "y": 0.02, "yanchor": "bottom", "x": 1, "xanchor": "right"},
    )
    return figure


def quality_table(titles: Sequence[str], results: Sequence[PanelResult | None]) -> str:
    """Write the quality values as an HTML table, the best of each measure marked.

    Parameters
    ----------
    titles : sequence of str
        What each panel shows.
    results : sequence of PanelResult or None
        As many.

    Returns
    -------
    str
    """
    there = [result for result in results if result is not None]
    if not there:
        return ""
    heads = "".join(f'<th scope="col">{escape(title)}</th>' for title in titles)
    rows = []
    for name, meaning, larger_is_better, value in _MEASURES:
        values = [None if result is None else value(result) for result in results]
        arrow = "↑" if larger_is_better else "↓"
        hint = f"{meaning}; {'larger' if larger_is_better else 'smaller'} is better"
        best = _best(values, larger_is_better)
        cells = "".join(_cell(v, b) for v, b in zip(values, best, strict=True))
        rows.append(
            f'<tr><th scope="row" title="{escape(hint)}">{escape(name)} '
            f'<span aria-hidden="true">{arrow}</span></th>{cells}</tr>'
        )
    k = there[0].quality.k
    return (
        f'<div class="wb-quality"><table><caption>★ best. Neighbourhood measures at k = {k}. '
        "↑ larger is better, ↓ smaller is better.</caption>"
        f'<thead><tr><th scope="col"></th>{heads}</tr></thead>'
        f"<tbody>{''.join(rows)}</tbody></table></div>"
    )


def _best(values: Sequence[float | None], larger_is_better: bool) -> list[bool]:
    """Mark the best values; values that are shown alike are equally good."""
    shown = [np.nan if value is None else _rounded(value) for value in values]
    if np.isfinite(shown).sum() < 2:
        return [False] * len(shown)
    best = np.nanmax(shown) if larger_is_better else np.nanmin(shown)
    return [value == best for value in shown]


def _cell(value: float | None, best: bool) -> str:
    if value is None:
        return "<td>…</td>"
    return f"<td{' class=best' if best else ''}>{_rounded(value):,.10g}</td>"


def _rounded(value: float) -> float:
    """Keep three digits: more would pretend a precision that seeds take away."""
    return float(f"{value:.3g}")
