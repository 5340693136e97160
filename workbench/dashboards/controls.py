"""The controls of the projection comparison."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import ipywidgets as widgets

from workbench.dashboards.quality_view import LETTERS
from workbench.dashboards.session import Panel, Summary

_WRAP = widgets.Layout(flex_flow="row wrap", align_items="center", grid_gap="4px 12px")
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
            options=[("your own (below)", _OWN), *datasets],
            description="Data",
            layout=widgets.Layout(width="440px", max_width="98%"),
        )
        self.path = widgets.Text(
            placeholder="path of a CSV, TSV, Parquet, ARFF, BVH or AMC file, or a name",
            description="File",
            layout=widgets.Layout(flex="1 1 320px", min_width="240px"),
        )
        self.label = widgets.Text(
            placeholder="optional",
            description="Class column",
            style={"description_width": "initial"},
            layout=widgets.Layout(width="220px"),
        )
        self.open = widgets.Button(description="Open", tooltip="Load this file")
        self.standardize = widgets.Checkbox(
            description="standardize columns", indent=False, layout=widgets.Layout(width="170px")
        )
        self.color_by = widgets.Dropdown(
            options=["class", "time", "none"],
            description="Colour by",
            layout=widgets.Layout(width="190px"),
        )
        self.ratio = widgets.FloatSlider(
            min=0.01,
            max=0.5,
            step=0.01,
            readout_format=".0%",
            description="Control points",
            continuous_update=False,
            style={"description_width": "initial"},
            layout=widgets.Layout(width="330px", max_width="98%"),
        )
        self.seed = widgets.BoundedIntText(
            min=0,
            max=2**31 - 1,
            description="Seed",
            layout=widgets.Layout(width="180px"),
        )
        self.count = widgets.ToggleButtons(
            options=[2, 3, 4],
            value=len(panels),
            description="Panels",
            style={"button_width": "42px"},
        )
        self.projector = [
            widgets.Dropdown(
                options=projectors, description=letter, layout=widgets.Layout(width="210px")
            )
            for letter in LETTERS
        ]
        self.optimized = [
            widgets.Checkbox(
                description="optimized",
                indent=False,
                tooltip=f"Optimize the embedding of panel {letter}",
                layout=widgets.Layout(width="100px"),
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
        self._show_choosers()
        self.count.observe(lambda _: self._show_choosers(), "value")
        own = widgets.Accordion([widgets.Box([self.path, self.label, self.open], layout=_WRAP)])
        own.set_title(0, "Your own file")
        self.own = own
        settings = [self.color_by, self.standardize, self.ratio, self.seed]
        self.view = widgets.VBox(
            [
                widgets.Box([self.data, self.count], layout=_WRAP),
                own,
                widgets.Box(self._choosers, layout=_WRAP),
                widgets.Box(settings, layout=_WRAP),
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

    def _show_choosers(self) -> None:
        for index, chooser in enumerate(self._choosers):
            chooser.layout.display = None if index < self.count.value else "none"


def _filled_up(panels: Sequence[Panel], projectors: Sequence[str]) -> list[Panel]:
    """Choose something to show for the panels that may be added."""
    taken = {panel.projector for panel in panels}
    others = [Panel(name) for name in projectors if name not in taken]
    others += [Panel(panel.projector, not panel.optimized) for panel in panels]
    return [*panels, *others][: len(LETTERS)]
