"""The controls of the projection comparison."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import ipywidgets as widgets

from workbench.dashboards.comparison.jobs import LOCAL_MEASURES
from workbench.dashboards.comparison.panel_controls import PanelChooser
from workbench.dashboards.comparison.panels import LETTERS, Panel
from workbench.dashboards.comparison.summaries import Summary
from workbench.dashboards.shared.data_controls import DataControls
from workbench.dashboards.shared.layout import FITTING, control_row, seed_field, share_field
from workbench.dashboards.shared.sources import Choice, Source

_USUAL = ""  # the back-projector that suits the samples

#: What colours can stand for.
COLORS = ("class", "time", "none", *LOCAL_MEASURES)


class Controls(DataControls):
    """Choose data, panels and settings.

    Parameters
    ----------
    datasets : sequence of Choice
        Data sets that can be shown.
    projectors, back_projectors : sequence of str
        Names.
    panels : sequence of Panel
        What to show first, 1 to 6.
    color_by : str or None
        One of ``COLORS``, or what is usual for the samples.

    Attributes
    ----------
    choosers : list of PanelChooser
        The controls of each panel, also of those that may be added.
    """

    def __init__(
        self,
        datasets: Sequence[Choice],
        projectors: Sequence[str],
        back_projectors: Sequence[str],
        panels: Sequence[Panel],
        color_by: str | None = None,
    ) -> None:
        self._clips = [choice.name for choice in datasets if choice.clip]
        self._keeps_color = color_by is not None
        super().__init__(datasets)
        self._make_clip_controls()
        self._make_settings(back_projectors, color_by)
        self._make_repeat_controls()
        self.count = widgets.Dropdown(
            options=range(1, len(LETTERS) + 1),
            value=len(panels),
            description="Panels",
            style=FITTING,
            layout=widgets.Layout(width="95px"),
        )
        filled = zip(LETTERS, _filled_up(panels, projectors), strict=True)
        self.choosers = [PanelChooser(letter, projectors, panel) for letter, panel in filled]
        self._further_row = control_row([self.further])
        self._show_parts()
        for part in (self.count, self.several):
            part.observe(lambda _: self._show_parts(), "value")
        panel_rows = control_row([chooser.view for chooser in self.choosers])
        self.view = widgets.VBox(
            [
                control_row([self.data, self.own, self.several, self.standardize]),
                self.own_row,
                self._further_row,
                control_row(
                    [self.count, self.ratio, self.seed, self.back_projector, self.color_by]
                ),
                panel_rows,
            ]
        )

    @property
    def n_repeats(self) -> int:
        """Over how many seeds quality is measured; 1 for the shown one only."""
        return self.n_seeds.value if self.repeat.value else 1

    @property
    def panels(self) -> list[Panel]:
        """What the panels are to show."""
        return [chooser.panel for chooser in self.choosers[: self.count.value]]

    def on_settings(self, act: Callable[[], None]) -> None:
        """Call back when a setting changed that panels depend on."""
        settings = (self.ratio, self.seed, self.back_projector, self.repeat, self.n_seeds)
        for control in (self.count, *settings):
            control.observe(lambda _: act(), "value")
        for chooser in self.choosers:
            chooser.observe(act)

    def offer(self, projectors: Sequence[str], back_projectors: Sequence[str]) -> None:
        """List methods, those registered meanwhile among them."""
        for chooser in self.choosers:
            chooser.offer(projectors)
        listed = _with_usual(back_projectors)
        if list(self.back_projector.options) != listed:
            chosen = self.back_projector.value
            self.back_projector.options = listed
            self.back_projector.value = chosen

    def choose(self, source: Source) -> None:
        """Show the name of the data; what is not listed is the user's own."""
        super().choose(source)
        first, *further = source.names
        others = [name for name in self._clips if name != first]
        if list(self.further.options) != others:
            self.further.options = others
        self.further.value = [name for name in further if name in others]
        if further:
            self.several.value = True

    def suit(self, summary: Summary, *, may_standardize: bool) -> None:
        """Offer what makes sense for these samples."""
        offered = ["class"] * bool(summary.class_names) + ["time", "none", *LOCAL_MEASURES]
        chosen = self.color_by.value
        if list(self.color_by.options) != offered:
            self.color_by.options = offered
        usual = "class" if summary.class_names else "time" if summary.body else "none"
        kept = chosen in LOCAL_MEASURES or (self._keeps_color and chosen in offered)
        self._keeps_color = False
        if kept or (chosen == "time" and usual != "class"):
            self.color_by.value = chosen
        else:
            self.color_by.value = usual
        self.standardize.disabled = not may_standardize
        self.several.layout.display = None if summary.body else "none"
        self._show_parts()

    def _make_clip_controls(self) -> None:
        self.several = widgets.ToggleButton(
            description="Further clips",
            icon="plus",
            tooltip="Show further clips of the same skeleton on the same map",
            layout=widgets.Layout(width="130px", display="none"),
        )
        self.further = widgets.SelectMultiple(
            description="Further clips",
            rows=5,
            style=FITTING,
            layout=widgets.Layout(flex="1 1 300px", max_width="520px"),
        )
        self.standardize = widgets.Checkbox(
            description="standardize columns", indent=False, layout=widgets.Layout(width="160px")
        )

    def _make_settings(self, back_projectors: Sequence[str], color_by: str | None) -> None:
        self.color_by = widgets.Dropdown(
            options=COLORS,
            value=color_by or COLORS[0],
            description="Colour by",
            style=FITTING,
            layout=widgets.Layout(width="265px"),
        )
        self.ratio = share_field()
        self.seed = seed_field()
        self.back_projector = widgets.Dropdown(
            options=_with_usual(back_projectors),
            description="Back-projector",
            tooltip="What rebuilds samples from their positions in the plane",
            style=FITTING,
            layout=widgets.Layout(width="245px"),
        )

    def _make_repeat_controls(self) -> None:
        self.repeat = widgets.ToggleButton(
            description="Repeat over seeds",
            icon="random",
            tooltip="Measure the quality with further seeds, and show its spread",
            layout=widgets.Layout(width="165px"),
        )
        self.n_seeds = widgets.BoundedIntText(
            value=5,
            min=2,
            max=100,
            description="Seeds",
            style=FITTING,
            layout=widgets.Layout(width="100px"),
        )

    def _show_parts(self) -> None:
        for index, chooser in enumerate(self.choosers):
            chooser.view.layout.display = None if index < self.count.value else "none"
        several = self.several.value and self.several.layout.display is None
        self._further_row.layout.display = None if several else "none"


def _with_usual(back_projectors: Sequence[str]) -> list[tuple[str, str]]:
    return [("the usual one", _USUAL), *((name, name) for name in back_projectors)]


def _filled_up(panels: Sequence[Panel], projectors: Sequence[str]) -> list[Panel]:
    """Choose something to show for the panels that may be added."""
    taken = {panel.projector for panel in panels}
    others = [Panel(name) for name in projectors if name not in taken]
    others += [Panel(panel.projector, panel.parameters, not panel.optimized) for panel in panels]
    others += [Panel(name, optimized=True) for name in projectors]
    return [*panels, *others][: len(LETTERS)]
