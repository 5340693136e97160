"""Choose what one panel of the comparison shows."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from html import escape
from typing import Any

import ipywidgets as widgets

from workbench.dashboards.comparison.panels import (
    Panel,
    check_parameters,
    offered,
    parameters_text,
    parsed_parameters,
)
from workbench.dashboards.shared.layout import FITTING
from workbench.errors import WorkbenchError


class PanelChooser:
    """Controls of one panel: a projector, its parameters, and what is done beyond.

    Parameters
    ----------
    letter : str
        The panel's name, in every label: a screen reader reads one control at a time.
    projectors : sequence of str
        Names.
    panel : Panel
        What to choose first.

    Attributes
    ----------
    projector, parameters, two_step, optimized : ipywidgets.Widget
        The controls.
    hint : ipywidgets.HTML
        The parameters' usual values.
    view : ipywidgets.Widget
        All of them.
    """

    def __init__(self, letter: str, projectors: Sequence[str], panel: Panel) -> None:
        self.projector = widgets.Dropdown(
            options=projectors,
            value=panel.projector,
            description=f"Projector {letter}",
            style=FITTING,
            layout=widgets.Layout(flex="0 1 165px", min_width="148px"),
        )
        self.parameters = widgets.Text(
            value=parameters_text(panel.parameters),
            description=f"Parameters {letter}",
            continuous_update=False,
            style=FITTING,
            layout=widgets.Layout(flex="1 1 205px", min_width="205px", max_width="440px"),
        )
        # Beside the field and not in it: a field of which anything changes forgets what a
        # person is writing.
        self.hint = widgets.HTML(layout=widgets.Layout(flex="0 1 auto", min_width="0"))
        self.two_step = widgets.Checkbox(
            value=panel.two_step,
            description=f"two-step {letter}",
            indent=False,
            tooltip="Project the control points only, and place the rest around them by RBFP",
            layout=widgets.Layout(width="94px"),
        )
        self.optimized = widgets.Checkbox(
            value=panel.optimized,
            description=f"optimized {letter}",
            indent=False,
            tooltip=f"Optimize the embedding of panel {letter}",
            layout=widgets.Layout(width="104px"),
        )
        self._problem = widgets.HTML(layout=widgets.Layout(display="none", flex="1 1 100%"))
        # What is known, written and used for each projector, so that none loses its own.
        self._known: dict[str, Mapping[str, Any]] = {}
        self._written = {panel.projector: self.parameters.value}
        self._chosen: dict[str, Mapping[str, Any]] = {panel.projector: panel.parameters}
        self._said = ""
        self.projector.observe(self._on_projector, "value")
        self.parameters.observe(self._on_parameters, "value")
        self.view = widgets.Box(
            [
                self.projector,
                self.parameters,
                self.hint,
                widgets.HBox([self.two_step, self.optimized]),  # they wrap together
                self._problem,
            ],
            layout=widgets.Layout(
                flex_flow="row wrap", align_items="center", flex="1 1 100%", grid_gap="0 8px"
            ),
        )

    @property
    def panel(self) -> Panel:
        """What is chosen; parameters that cannot be read leave those before."""
        name = self.projector.value
        return Panel(name, self._chosen.get(name, {}), self.optimized.value, self.two_step.value)

    @panel.setter
    def panel(self, panel: Panel) -> None:
        written = self._written[panel.projector] = parameters_text(panel.parameters)
        self._chosen[panel.projector] = panel.parameters
        self.projector.value, self.parameters.value = panel.projector, written
        self.optimized.value, self.two_step.value = panel.optimized, panel.two_step

    @property
    def problem(self) -> str:
        """Why the parameters are not used; empty if they are."""
        return self._said

    def observe(self, act: Callable[[], None]) -> None:
        """Call back when another panel was chosen."""
        for control in (self.projector, self.parameters, self.two_step, self.optimized):
            control.observe(lambda _: act(), "value")

    def offer(self, projectors: Sequence[str]) -> None:
        """List projectors, those registered meanwhile among them."""
        if list(self.projector.options) != list(projectors):
            chosen = self.projector.value
            self.projector.options = list(projectors)
            self.projector.value = chosen

    def describe(self, projector: str, parameters: Mapping[str, Any]) -> None:
        """Show the usual parameters of a projector, and check those written from now on."""
        if self._known.get(projector) != parameters:
            self._known[projector] = parameters
            self._hint()

    def _on_projector(self, change: Any) -> None:
        self._written[change["old"]] = self.parameters.value
        self._hint()
        self.parameters.value = self._written.get(change["new"], "")
        self._read()

    def _on_parameters(self, _: Any) -> None:
        self._read()

    def _hint(self) -> None:
        known = self._known.get(self.projector.value, {})
        shown = parameters_text(offered(known))
        self.hint.value = f"<small>usual: {escape(shown)}</small>" if shown else ""

    def _read(self) -> None:
        """Take the parameters as they are written, or say what is wrong with them."""
        name = self.projector.value
        try:
            read = parsed_parameters(self.parameters.value)
            if known := self._known.get(name):
                check_parameters(name, read, known)
        except WorkbenchError as error:
            self._say(str(error))
            return
        self._say("")
        self._chosen[name] = read

    def _say(self, problem: str) -> None:
        self._said = problem
        self._problem.layout.display = None if problem else "none"
        self._problem.value = (
            f'<span role="alert" style="color: var(--jp-error-color1, #b71c1c)">'
            f"{escape(problem)}</span>"
            if problem
            else ""
        )
