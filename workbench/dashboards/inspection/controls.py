"""The controls of the keyframe inspector."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import ipywidgets as widgets

from workbench.dashboards.inspection.jobs import Method
from workbench.dashboards.shared.data_controls import DataControls
from workbench.dashboards.shared.layout import FITTING, control_row, offer_names, seed_field
from workbench.dashboards.shared.sources import Choice
from workbench.widgets.slider_names import SliderNames

#: Ranges of σ in frames, and of k.
SIGMAS, COMPONENTS = (1.0, 30.0), (1, 30)
_USUAL_COMPONENTS = 7
_MOST_KEYFRAMES = 200


class InspectorControls(DataControls):
    """Choose a clip, a method and how many keyframes.

    Parameters
    ----------
    clips : sequence of Choice
        Motions that can be shown.
    selectors : sequence of str
        Names.

    Attributes
    ----------
    view : ipywidgets.Widget
        All controls.
    """

    def __init__(self, clips: Sequence[Choice], selectors: Sequence[str]) -> None:
        super().__init__(clips, "Clip", "BVH or AMC")
        self.label.layout.display = "none"  # motions have no classes
        self._make_method_controls(selectors)
        self._make_count_controls()
        for part in (self.selector, self.own_rule, self.usual_components):
            part.observe(lambda _: self._show_parts(), "value")
        self._show_parts()
        self.view = widgets.VBox(
            [
                control_row([self.data, self.own]),
                self.own_row,
                control_row([self.selector, self.sigma, self.usual_components, self.components]),
                control_row([self.contacts, self.own_rule, self.count, self.seed, self.exact]),
                SliderNames(),
            ]
        )

    @property
    def method(self) -> Method:
        """How keyframes are to be chosen."""
        components = None if self.usual_components.value else self.components.value
        return Method(
            self.selector.value,
            self.sigma.value,
            components,
            contacts=self.contacts.value,
            seed=self.seed.value,
        )

    @property
    def wanted_count(self) -> int | None:
        """How many keyframes are wanted; None for the saliency method's own rule."""
        return None if self.own_rule.value else self.count.value

    def set_count(self, count: int | None) -> None:
        """Ask for a number of keyframes, or for the own rule."""
        if count is not None:
            self.count.max = max(self.count.max, count)
            self.count.value = count
        self.own_rule.value = count is None

    def set_components(self, components: int | None) -> None:
        """Ask for a number of principal components, or for the usual one."""
        if components is not None:
            self.components.value = components
        self.usual_components.value = components is None

    def on_settings(self, act: Callable[[], None]) -> None:
        """Call back when a setting changed that keyframes depend on."""
        parts = (self.selector, self.sigma, self.usual_components, self.components)
        for part in (*parts, self.contacts, self.own_rule, self.count, self.seed, self.exact):
            part.observe(lambda _: act(), "value")

    def offer(self, selectors: Sequence[str]) -> None:
        """List selectors, those registered meanwhile among them."""
        offer_names(self.selector, selectors)

    def suit(self, n_frames: int) -> None:
        """Offer numbers of keyframes that a clip can have."""
        most = max(3, min(_MOST_KEYFRAMES, n_frames - 1))
        self.count.max = most

    def _make_method_controls(self, selectors: Sequence[str]) -> None:
        self.selector = widgets.Dropdown(
            options=selectors,
            description="Method",
            style=FITTING,
            layout=widgets.Layout(width="190px"),
        )
        self.sigma = widgets.FloatSlider(
            value=10.0,
            min=SIGMAS[0],
            max=SIGMAS[1],
            step=0.5,
            readout_format=".1f",
            description="σ in frames",
            continuous_update=False,
            style=FITTING,
            layout=widgets.Layout(width="260px", max_width="98%"),
        )
        self.usual_components = widgets.Checkbox(
            value=True,
            description="k that keeps 90 % of the variance",
            indent=False,
            layout=widgets.Layout(width="250px"),
        )
        self.components = widgets.IntSlider(
            value=_USUAL_COMPONENTS,
            min=COMPONENTS[0],
            max=COMPONENTS[1],
            description="k components",
            continuous_update=False,
            style=FITTING,
            layout=widgets.Layout(width="260px", max_width="98%"),
        )

        self.contacts = widgets.Checkbox(
            description="handle foot contacts",
            tooltip="Feet get curves of their own, with a window of 3 frames",
            indent=False,
            layout=widgets.Layout(width="180px"),
        )

    def _make_count_controls(self) -> None:
        self.own_rule = widgets.Checkbox(
            value=True,
            description="as many keyframes as saliency finds",
            indent=False,
            layout=widgets.Layout(width="290px"),
        )
        self.count = widgets.IntSlider(
            value=10,
            min=2,
            max=_MOST_KEYFRAMES,
            description="Keyframes",
            continuous_update=False,
            style=FITTING,
            layout=widgets.Layout(width="280px", max_width="98%"),
        )
        self.seed = seed_field()
        self.exact = widgets.Checkbox(
            description="compare with the best of all keyframes",
            indent=False,
            layout=widgets.Layout(width="290px"),
        )

    def _show_parts(self) -> None:
        def shown(part: widgets.Widget, yes: bool) -> None:
            part.layout.display = None if yes else "none"

        shown(self.components, not self.usual_components.value)
        shown(self.count, not self.own_rule.value)
