"""The controls of the explained optimizer."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import ipywidgets as widgets

from workbench.dashboards.shared.data_controls import DataControls
from workbench.dashboards.shared.layout import (
    FITTING,
    control_row,
    offer_names,
    seed_field,
    share_field,
)
from workbench.dashboards.shared.sources import Choice


class ExplainControls(DataControls):
    """Choose data, methods, the sample and settings.

    Parameters
    ----------
    datasets : sequence of Choice
        Data sets that can be shown.
    projectors, back_projectors : sequence of str
        Names.
    """

    def __init__(
        self,
        datasets: Sequence[Choice],
        projectors: Sequence[str],
        back_projectors: Sequence[str],
    ) -> None:
        super().__init__(datasets)
        self.standardize = widgets.Checkbox(
            description="standardize columns", indent=False, layout=widgets.Layout(width="160px")
        )
        self.projector = widgets.Dropdown(
            options=projectors,
            description="Projector",
            style=FITTING,
            layout=widgets.Layout(width="190px"),
        )
        self.back_projector = widgets.Dropdown(
            options=back_projectors,
            description="Back-projector",
            style=FITTING,
            layout=widgets.Layout(width="310px", max_width="98%"),
        )
        self.sample = widgets.BoundedIntText(
            min=0,
            max=0,
            description="Sample",
            style=FITTING,
            layout=widgets.Layout(width="130px"),
        )
        self.ratio = share_field()
        self.seed = seed_field()
        self.view = widgets.VBox(
            [
                control_row([self.data, self.own]),
                self.own_row,
                control_row([self.projector, self.back_projector, self.sample]),
                control_row([self.ratio, self.seed, self.standardize]),
            ]
        )

    def on_settings(self, act: Callable[[], None]) -> None:
        """Call back when a setting changed that the plane depends on."""
        for control in (self.projector, self.back_projector, self.ratio, self.seed):
            control.observe(lambda _: act(), "value")

    def offer(self, projectors: Sequence[str], back_projectors: Sequence[str]) -> None:
        """List methods, those registered meanwhile among them."""
        offer_names(self.projector, projectors)
        offer_names(self.back_projector, back_projectors)

    def suit(self, n_samples: int, word: str, *, may_standardize: bool) -> None:
        """Offer what makes sense for these samples."""
        self.sample.max = n_samples - 1
        self.sample.description = word.capitalize()
        self.standardize.disabled = not may_standardize
