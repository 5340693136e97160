"""The controls of the explained optimizer."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import ipywidgets as widgets

_FITTING = {"description_width": "initial"}
_OWN = ""  # the drop-down's value while data come from elsewhere


class ExplainControls:
    """Choose data, methods, the sample and settings.

    Parameters
    ----------
    datasets : sequence of (str, str)
        What to show for a data set, and its name.
    projectors, back_projectors : sequence of str
        Names.
    """

    def __init__(
        self,
        datasets: Sequence[tuple[str, str]],
        projectors: Sequence[str],
        back_projectors: Sequence[str],
    ) -> None:
        self.data = widgets.Dropdown(
            options=[("your own", _OWN), *datasets],
            description="Data",
            style=_FITTING,
            layout=widgets.Layout(flex="1 1 300px", max_width="520px"),
        )
        self.own = widgets.ToggleButton(
            description="Own file",
            icon="folder-open",
            tooltip="Open a file of your own",
            layout=widgets.Layout(width="110px"),
        )
        self.path = widgets.Text(
            placeholder="path of a CSV, TSV, Parquet, ARFF, BVH or AMC file",
            description="File",
            style=_FITTING,
            layout=widgets.Layout(flex="1 1 300px"),
        )
        self.label = widgets.Text(
            placeholder="optional",
            description="Class column",
            style=_FITTING,
            layout=widgets.Layout(width="200px"),
        )
        self.open = widgets.Button(
            description="Open", tooltip="Load this file", layout=widgets.Layout(width="80px")
        )
        self.standardize = widgets.Checkbox(
            description="standardize columns", indent=False, layout=widgets.Layout(width="160px")
        )
        self.projector = widgets.Dropdown(
            options=projectors,
            description="Projector",
            style=_FITTING,
            layout=widgets.Layout(width="190px"),
        )
        self.back_projector = widgets.Dropdown(
            options=back_projectors,
            description="Back-projector",
            style=_FITTING,
            layout=widgets.Layout(width="310px", max_width="98%"),
        )
        self.sample = widgets.BoundedIntText(
            min=0,
            max=0,
            description="Sample",
            style=_FITTING,
            layout=widgets.Layout(width="130px"),
        )
        self.ratio = widgets.FloatSlider(
            min=0.01,
            max=0.5,
            step=0.01,
            readout_format=".0%",
            description="Control points",
            continuous_update=False,
            style=_FITTING,
            layout=widgets.Layout(width="280px", max_width="98%"),
        )
        self.seed = widgets.BoundedIntText(
            min=0,
            max=2**31 - 1,
            description="Seed",
            style=_FITTING,
            layout=widgets.Layout(width="110px"),
        )
        self._own_row = _row([self.path, self.label, self.open])
        self._show_own()
        self.own.observe(lambda _: self._show_own(), "value")
        self.view = widgets.VBox(
            [
                _row([self.data, self.own]),
                self._own_row,
                _row([self.projector, self.back_projector, self.sample]),
                _row([self.ratio, self.seed, self.standardize]),
            ]
        )

    def on_settings(self, act: Callable[[], None]) -> None:
        """Call back when a setting changed that the plane depends on."""
        for control in (self.projector, self.back_projector, self.ratio, self.seed):
            control.observe(lambda _: act(), "value")

    def offer(self, projectors: Sequence[str], back_projectors: Sequence[str]) -> None:
        """List methods, those registered meanwhile among them."""
        for control, names in (
            (self.projector, projectors),
            (self.back_projector, back_projectors),
        ):
            if list(control.options) != list(names):
                chosen = control.value
                control.options = list(names)
                control.value = chosen

    def choose(self, name: str | None) -> None:
        """Show the name of the data; None or an unlisted name stands for the user's own."""
        listed = {value for _, value in self.data.options}
        self.data.value = name if name in listed else _OWN

    def suit(self, n_samples: int, word: str, *, may_standardize: bool) -> None:
        """Offer what makes sense for these samples."""
        self.sample.max = n_samples - 1
        self.sample.description = word.capitalize()
        self.standardize.disabled = not may_standardize

    def _show_own(self) -> None:
        self._own_row.layout.display = None if self.own.value else "none"


def _row(parts: Sequence[widgets.Widget]) -> widgets.Box:
    """Put controls side by side, in as many lines as the page's width makes necessary."""
    layout = widgets.Layout(flex_flow="row wrap", align_items="center", grid_gap="2px 14px")
    return widgets.Box(list(parts), layout=layout)
