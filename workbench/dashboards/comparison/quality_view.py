"""Show the quality of embeddings: a table with the best values marked, and figures."""

from __future__ import annotations

from collections.abc import Sequence

import ipywidgets as widgets

from workbench.dashboards.comparison.jobs import PanelResult, Values
from workbench.dashboards.comparison.quality_figures import preservation_figure, shepard_figure
from workbench.dashboards.comparison.quality_table import quality_table
from workbench.widgets import FigureView

_FIGURES = {
    "Neighbourhoods": ("Neighbourhood preservation against k", preservation_figure),
    "Shepard diagram": ("Shepard diagram", shepard_figure),
}


class QualityView:
    """A table of quality values, and a figure of one's choice.

    Attributes
    ----------
    table : ipywidgets.HTML
        One column for each panel.
    choice : ipywidgets.ToggleButtons
        Which figure to show.
    curves : FigureView
        The figure.
    figures : ipywidgets.Widget
        The choice and the figure.
    """

    def __init__(self) -> None:
        self.table = widgets.HTML(layout=widgets.Layout(width="100%"))
        self.curves = FigureView()
        self.choice = widgets.ToggleButtons(
            options=list(_FIGURES),
            tooltips=[words for words, _ in _FIGURES.values()],
            style={"button_width": "155px"},
        )
        self.figures = widgets.VBox([self.choice, self.curves])
        self._shown: tuple[list[str], list[PanelResult | None]] = ([], [])
        self.choice.observe(lambda _: self._draw(), "value")

    def show(
        self,
        titles: Sequence[str],
        results: Sequence[PanelResult | None],
        repeated: Sequence[Sequence[Values]] = (),
    ) -> None:
        """Show the results of the panels; None where there is none yet.

        Parameters
        ----------
        titles : sequence of str
            What each panel shows.
        results : sequence of PanelResult or None
            As many.
        repeated : sequence of sequence of Values
            For each panel, its quality with other seeds.
        """
        self.table.value = quality_table(titles, results, repeated)
        shown = (list(titles), list(results))
        # Drawn only if it changed: a busy panel reports often.
        if shown != self._shown:
            self._shown = shown
            self._draw()

    def _draw(self) -> None:
        titles, results = self._shown
        words, figure = _FIGURES[self.choice.value]
        shown = [title for title, result in zip(titles, results, strict=True) if result]
        self.curves.description = f"{words} of {'; '.join(shown)}"
        self.curves.figure = figure(titles, results).to_json()
