"""The controls of the keyframe inspector."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import ipywidgets as widgets

from workbench.dashboards.inspector_jobs import Method
from workbench.dashboards.sources import Choice, Source

_FITTING = {"description_width": "initial"}
_OWN = ""  # the drop-down's value while the clip comes from elsewhere

#: Ranges of σ in frames, and of k.
SIGMAS, COMPONENTS = (1.0, 30.0), (1, 30)
_USUAL_COMPONENTS = 7
_MOST_KEYFRAMES = 200


class InspectorControls:
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
        self._make_clip_controls(clips)
        self._make_method_controls(selectors)
        self._make_count_controls()
        self._own_row = _row([self.path, self.open])
        for part in (self.own, self.selector, self.own_rule, self.usual_components):
            part.observe(lambda _: self._show_parts(), "value")
        self._show_parts()
        self.view = widgets.VBox(
            [
                _row([self.clip, self.own]),
                self._own_row,
                _row([self.selector, self.sigma, self.usual_components, self.components]),
                _row([self.own_rule, self.count, self.seed, self.exact]),
            ]
        )

    @property
    def method(self) -> Method:
        """How keyframes are to be chosen."""
        components = None if self.usual_components.value else self.components.value
        return Method(self.selector.value, self.sigma.value, components, self.seed.value)

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
        for part in (*parts, self.own_rule, self.count, self.seed, self.exact):
            part.observe(lambda _: act(), "value")

    def offer(self, selectors: Sequence[str]) -> None:
        """List selectors, those registered meanwhile among them."""
        if list(self.selector.options) != list(selectors):
            chosen = self.selector.value
            self.selector.options = selectors
            self.selector.value = chosen if chosen in selectors else selectors[0]

    def choose(self, source: Source) -> None:
        """Show the name of the clip; what is not listed is the user's own."""
        listed = {value for _, value in self.clip.options}
        known = source.registered or not source.token
        self.clip.value = source.name if known and source.name in listed else _OWN

    def suit(self, n_frames: int) -> None:
        """Offer numbers of keyframes that a clip can have."""
        most = max(3, min(_MOST_KEYFRAMES, n_frames - 1))
        self.count.max = most

    def _make_clip_controls(self, clips: Sequence[Choice]) -> None:
        self.clip = widgets.Dropdown(
            options=[("your own", _OWN), *((choice.text, choice.name) for choice in clips)],
            description="Clip",
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
            placeholder="path of a BVH or AMC file",
            description="File",
            style=_FITTING,
            layout=widgets.Layout(flex="1 1 300px"),
        )
        self.open = widgets.Button(
            description="Open", tooltip="Load this file", layout=widgets.Layout(width="80px")
        )

    def _make_method_controls(self, selectors: Sequence[str]) -> None:
        self.selector = widgets.Dropdown(
            options=selectors,
            description="Method",
            style=_FITTING,
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
            style=_FITTING,
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
            style=_FITTING,
            layout=widgets.Layout(width="260px", max_width="98%"),
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
        self.exact = widgets.Checkbox(
            description="compare with the best of all keyframes",
            indent=False,
            layout=widgets.Layout(width="290px"),
        )

    def _show_parts(self) -> None:
        def shown(part: widgets.Widget, yes: bool) -> None:
            part.layout.display = None if yes else "none"

        shown(self._own_row, self.own.value)
        shown(self.components, not self.usual_components.value)
        shown(self.count, not self.own_rule.value)


def _row(parts: Sequence[widgets.Widget]) -> widgets.Box:
    """Put controls side by side, in as many lines as the page's width makes necessary."""
    layout = widgets.Layout(flex_flow="row wrap", align_items="center", grid_gap="2px 14px")
    return widgets.Box(list(parts), layout=layout)
