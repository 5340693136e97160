"""The controls of the authoring dashboard."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import ipywidgets as widgets

from workbench.backprojection.radial import KERNELS
from workbench.dashboards.authoring.jobs import CIRCLE, Methods
from workbench.dashboards.shared.data_controls import DataControls
from workbench.dashboards.shared.layout import FITTING, control_row, offer_names, seed_field
from workbench.dashboards.shared.sources import Choice
from workbench.errors import WorkbenchError
from workbench.validation import whole_number

#: How many markers can be placed at once; the browser refits radial functions of so many while
#: one is dragged.
COUNTS = (3, 60)


class AuthorControls(DataControls):
    """Choose a clip, how its markers are placed, and what edits do.

    Parameters
    ----------
    clips : sequence of Choice
        Motions that can be opened.
    selectors, projectors : sequence of str
        Names.

    Attributes
    ----------
    selector, projector, kernel : ipywidgets.Dropdown
        Names.
    count, seed : ipywidgets.BoundedIntText
        How many markers, and the seed of everything random.
    place : ipywidgets.Button
        Places markers anew.
    refine, keep_feet : ipywidgets.Checkbox
        Whether the optimizer follows RBFP, and whether feet are kept from sliding.
    follow : ipywidgets.Button
        Gives up a trajectory that was drawn, deformed or retimed.
    session : ipywidgets.Text
        Path of a session's file.
    open_session : ipywidgets.Button
        To open it.
    start, edits : ipywidgets.Widget
        The controls of the clip and its markers, and of edits.
    """

    def __init__(
        self, clips: Sequence[Choice], selectors: Sequence[str], projectors: Sequence[str]
    ) -> None:
        super().__init__(clips, "Clip", "BVH or AMC")
        self.label.layout.display = "none"  # motions have no classes
        self.quiet = False
        self._make_start(selectors, projectors)
        self._make_edits()
        self._make_opening()
        self.start = widgets.VBox(
            [
                control_row([self.data, self.own]),
                self.own_row,
                control_row([self.selector, self.count, self.projector, self.seed, self.place]),
            ]
        )
        self.edits = control_row([self.refine, self.kernel, self.follow])

    def offer(self, selectors: Sequence[str], projectors: Sequence[str]) -> None:
        """List methods, those registered meanwhile among them."""
        offer_names(self.selector, selectors)
        offer_names(self.projector, [*projectors, CIRCLE])

    def set_placing(
        self, methods: Methods, selector: str, count: int, projector: str, seed: int
    ) -> None:
        """Show how markers are to be placed.

        Raises
        ------
        WorkbenchError
            If a name is unknown, or a number is out of range.
        """
        methods.selectors.factory(selector)  # refuses it and says which there are
        if projector != CIRCLE:
            methods.projectors.factory(projector)
        low, high = COUNTS
        if not low <= whole_number("count", count) <= high:
            raise WorkbenchError(f"count: got {count}, want {low} to {high}")
        whole_number("random_state", seed, at_least=0)
        self.offer(methods.selectors.names(), methods.projectors.names())
        self.selector.value, self.count.value = selector, count
        self.projector.value, self.seed.value = projector, seed

    @contextmanager
    def silence(self) -> Iterator[None]:
        """Change what is shown without taking it for a person's wish."""
        before, self.quiet = self.quiet, True
        try:
            yield
        finally:
            self.quiet = before

    def _make_start(self, selectors: Sequence[str], projectors: Sequence[str]) -> None:
        self.selector = widgets.Dropdown(
            options=selectors,
            description="Key poses by",
            style=FITTING,
            layout=widgets.Layout(width="190px"),
        )
        self.count = widgets.BoundedIntText(
            value=12,
            min=COUNTS[0],
            max=COUNTS[1],
            description="How many",
            style=FITTING,
            layout=widgets.Layout(width="130px"),
        )
        self.projector = widgets.Dropdown(
            options=[*projectors, CIRCLE],
            description="Placed by",
            style=FITTING,
            layout=widgets.Layout(width="170px"),
        )
        self.seed = seed_field()
        self.place = widgets.Button(
            description="Place markers",
            tooltip="Choose key poses of the clip and place them anew; can be undone",
            button_style="primary",
            layout=widgets.Layout(width="130px"),
        )

    def _make_edits(self) -> None:
        self.keep_feet = widgets.Checkbox(
            description="keep the feet from sliding",
            indent=False,
            layout=widgets.Layout(width="200px"),
        )
        self.refine = widgets.Checkbox(
            value=True,
            description="optimize in-between frames",
            tooltip="After RBFP has placed them, let the optimizer move them to lower the error",
            indent=False,
            layout=widgets.Layout(width="220px"),
        )
        self.kernel = widgets.Dropdown(
            options=list(KERNELS),
            description="Radial function",
            style=FITTING,
            layout=widgets.Layout(width="210px"),
        )
        self.follow = widgets.Button(
            description="Back to the clip's curve",
            tooltip="Give up a trajectory that was drawn, deformed or retimed; can be undone",
            icon="history",
            layout=widgets.Layout(width="190px"),
        )

    def _make_opening(self) -> None:
        self.session = widgets.Text(
            placeholder="path of a session's file",
            description="Session",
            style=FITTING,
            layout=widgets.Layout(flex="1 1 220px", max_width="420px"),
        )
        self.open_session = widgets.Button(
            description="Open",
            tooltip="Open this session; what is shown can be had back by undo",
            layout=widgets.Layout(width="80px"),
        )
