"""The controls of the projection comparison."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import ipywidgets as widgets

from workbench.dashboards.quality_view import LETTERS
from workbench.dashboards.session import Panel, Summary

_FITTING = {"description_width": "initial"}
_OWN = ""  # the drop-down's value while data come from elsewhere


class Controls:
    """Choose data, panels and settings.

    Parameters
    ----------
    datasets : sequence of (str, str)
        What to show for a data set, and its name.
    projectors : sequence of str
        Names.
    panels : sequence of Panel
        What to show first, 2 to 4.
    """

    def __init__(
        self,
        datasets: Sequence[tuple[str, str]],
        projectors: Sequence[str],
        panels: Sequence[Panel],
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
        self.color_by = widgets.Dropdown(
            options=["class", "time", "none"],
            description="Colour by",
            style=_FITTING,
            layout=widgets.Layout(width="150px"),
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
        self.count = widgets.Dropdown(
            options=[2, 3, 4],
            value=len(panels),
            description="Panels",
            style=_FITTING,
            layout=widgets.Layout(width="95px"),
        )
        self.projector = [
            widgets.Dropdown(
                options=projectors,
                description=f"Projector {letter}",
                style=_FITTING,
                layout=widgets.Layout(width="185px"),
            )
            for letter in LETTERS
        ]
        self.optimized = [
            widgets.Checkbox(
                description=f"optimized {letter}",
                indent=False,
                tooltip=f"Optimize the embedding of panel {letter}",
                layout=widgets.Layout(width="105px"),
            )
            for letter in LETTERS
        ]
        self._choosers = [
            widgets.HBox(list(pair), layout=widgets.Layout(align_items="center"))
            for pair in zip(self.projector, self.optimized, strict=True)
        ]
        for index, panel in enumerate(_filled_up(panels, projectors)):
            self.projector[index].value = panel.projector
            self.optimized[index].value = panel.optimized
        self._own_row = _row([self.path, self.label, self.open])
        self._show_parts()
        self.count.observe(lambda _: self._show_parts(), "value")
        self.own.observe(lambda _: self._show_parts(), "value")
        self.view = widgets.VBox(
            [
                _row([self.data, self.own]),
                self._own_row,
                _row([self.count, *self._choosers]),
                _row([self.color_by, self.standardize, self.ratio, self.seed]),
            ]
        )

    @property
    def panels(self) -> list[Panel]:
        """What the panels are to show."""
        pairs = zip(self.projector, self.optimized, strict=True)
        return [Panel(p.value, o.value) for p, o in pairs][: self.count.value]

    def on_settings(self, act: Callable[[], None]) -> None:
        """Call back when a setting changed that panels depend on."""
        inputs = [self.count, self.ratio, self.seed, *self.projector, *self.optimized]
        for control in inputs:
            control.observe(lambda _: act(), "value")

    def offer_projectors(self, names: Sequence[str]) -> None:
        """List projectors, those registered meanwhile among them."""
        for control in self.projector:
            if list(control.options) != list(names):
                chosen = control.value
                control.options = list(names)
                control.value = chosen

    def choose(self, name: str | None) -> None:
        """Show the name of the data; None or an unlisted name stands for the user's own."""
        listed = {value for _, value in self.data.options}
        self.data.value = name if name in listed else _OWN

    def suit(self, summary: Summary, *, may_standardize: bool) -> None:
        """Offer what makes sense for these samples."""
        offered = ["class"] * bool(summary.class_names) + ["time", "none"]
        if list(self.color_by.options) != offered:
            self.color_by.options = offered
        usual = "class" if summary.class_names else "time" if summary.body else "none"
        if self.color_by.value == "none" or usual == "class":
            self.color_by.value = usual
        self.standardize.disabled = not may_standardize

    def _show_parts(self) -> None:
        for index, chooser in enumerate(self._choosers):
            chooser.layout.display = None if index < self.count.value else "none"
        self._own_row.layout.display = None if self.own.value else "none"


def _row(parts: Sequence[widgets.Widget]) -> widgets.Box:
    """Put controls side by side, in as many lines as the page's width makes necessary."""
    layout = widgets.Layout(flex_flow="row wrap", align_items="center", grid_gap="2px 14px")
    return widgets.Box(list(parts), layout=layout)


def _filled_up(panels: Sequence[Panel], projectors: Sequence[str]) -> list[Panel]:
    """Choose something to show for the panels that may be added."""
    taken = {panel.projector for panel in panels}
    others = [Panel(name) for name in projectors if name not in taken]
    others += [Panel(panel.projector, not panel.optimized) for panel in panels]
    return [*panels, *others][: len(LETTERS)]
