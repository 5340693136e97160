"""Show the quality of embeddings: a table with the best values marked, and a figure."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from html import escape
from typing import Any

import ipywidgets as widgets
import numpy as np
import plotly.graph_objects as go

from workbench.dashboards.session import PanelResult

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
_COLORS = {
    "light": ("#0072b2", "#d55e00", "#009e73", "#cc79a7"),
    "dark": ("#4da6e0", "#ff8540", "#2fc79a", "#e39cc3"),
}
_INK = {"light": ("#333333", "#d0d0d0"), "dark": ("#dddddd", "#4a4a4a")}
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
.wb-curves { overflow: hidden; }
.wb-curves > * { flex: 1 1 0; min-width: 0; width: 100%; }
.wb-quality td.best { font-weight: 700; }
.wb-quality td.best::before { content: "★ "; }
</style>"""


class QualityView:
    """A table of quality values and a figure of neighbourhood preservation against k.

    Attributes
    ----------
    table : ipywidgets.HTML
        One column for each panel.
    figure : plotly FigureWidget
        One curve for each panel, all in one figure, because each figure widget brings
        5 MB of its own.
    """

    def __init__(self) -> None:
        self.table = widgets.HTML()
        traces = [
            go.Scatter(
                mode="lines+markers",
                line={"dash": dash},
                marker={"symbol": symbol, "size": 6},
                visible=False,
            )
            for dash, symbol in zip(_DASHES, _SYMBOLS, strict=True)
        ]
        self.figure: Any = go.FigureWidget(traces)
        # Set here because FigureWidget takes no configuration when it is made.
        self.figure._config = {"displaylogo": False, "displayModeBar": False, "responsive": True}
        self.figure.update_layout(
            title={"text": "Neighbourhood preservation against k", "font": {"size": 14}},
            xaxis={"title": {"text": "k, number of neighbours"}, "rangemode": "tozero"},
            yaxis={"title": {"text": "preserved share"}, "range": [0, 1.02]},
            height=300,
            margin={"l": 55, "r": 10, "t": 40, "b": 45},
            legend={"orientation": "h", "y": 1.02, "yanchor": "bottom", "x": 1, "xanchor": "right"},
            showlegend=True,
        )
        self.use_theme("light")

    def use_theme(self, theme: str) -> None:
        """Draw the figure in colours that suit a light or a dark page."""
        ink, grid = _INK[theme]
        axis = {"gridcolor": grid, "zerolinecolor": grid, "linecolor": grid}
        with self.figure.batch_update():
            self.figure.update_layout(
                paper_bgcolor="rgba(0,0,0,0)",
                plot_bgcolor="rgba(0,0,0,0)",
                font={"color": ink, "size": 12},
                xaxis=axis,
                yaxis=axis,
            )
            for trace, color in zip(self.figure.data, _COLORS[theme], strict=True):
                trace.line.color = color
                trace.marker.color = color

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
        with self.figure.batch_update():
            for index, trace in enumerate(self.figure.data):
                result = results[index] if index < len(results) else None
                trace.visible = result is not None
                if result is not None:
                    trace.name = LETTERS[index]
                    trace.x, trace.y = result.k, result.preservation
                    trace.hovertemplate = (
                        f"{escape(titles[index])}<br>k = %{{x}}: %{{y:.3f}}<extra></extra>"
                    )


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
    shown = [np.nan if value is None else float(f"{value:.3g}") for value in values]
    if np.isfinite(shown).sum() < 2:
        return [False] * len(shown)
    best = np.nanmax(shown) if larger_is_better else np.nanmin(shown)
    return [value == best for value in shown]


def _cell(value: float | None, best: bool) -> str:
    if value is None:
        return "<td>…</td>"
    return f"<td{' class=best' if best else ''}>{value:.3g}</td>"
