"""How dashboards are laid out: rows that wrap, and messages in their own words."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import ipywidgets as widgets

#: Style of a control whose description is as wide as its words.
FITTING = {"description_width": "initial"}

_ALERT = (
    '<div role="alert" style="border-left: 4px solid var(--jp-error-color1, #b71c1c); '
    'padding: 2px 8px; line-height: 1.4">{words}</div>'
)


def control_row(parts: Sequence[widgets.Widget]) -> widgets.Box:
    """Put controls side by side, in as many lines as the page's width makes necessary."""
    layout = widgets.Layout(flex_flow="row wrap", align_items="center", grid_gap="2px 14px")
    return widgets.Box(list(parts), layout=layout)


def view_row(parts: Sequence[widgets.Widget]) -> widgets.Box:
    """Put views side by side, in as many lines as the page's width makes necessary."""
    layout = widgets.Layout(flex_flow="row wrap", grid_gap="8px 16px", align_items="flex-start")
    return widgets.Box(list(parts), layout=layout)


def alert(words: str) -> str:
    """Write as HTML what went wrong, so that a screen reader speaks it at once."""
    return _ALERT.format(words=escape(words))


def remark(name: str, words: str, further: str = "") -> str:
    """Write as HTML what is shown: its name, what it is, and on a line below what else is said."""
    below = f"<br>{escape(further)}" if further else ""
    return f'<div style="line-height: 1.4"><b>{escape(name)}</b>: {escape(words)}{below}</div>'


def share_field() -> widgets.BoundedFloatText:
    """Ask for the share of control points, 1 % to 50 %.

    A field and no slider: nothing can name the handle of ipywidgets' sliders for a screen
    reader.
    """
    return widgets.BoundedFloatText(
        min=0.01,
        max=0.5,
        step=0.01,
        description="Share of control points",
        style=FITTING,
        layout=widgets.Layout(width="225px"),
    )


def seed_field() -> widgets.BoundedIntText:
    """Ask for the seed of everything random."""
    return widgets.BoundedIntText(
        min=0,
        max=2**31 - 1,
        description="Seed",
        style=FITTING,
        layout=widgets.Layout(width="110px"),
    )


def offer_names(control: widgets.Dropdown, names: Sequence[str]) -> None:
    """List other names in a drop-down, and keep what is chosen if it is among them."""
    if list(control.options) != list(names):
        chosen = control.value
        control.options = list(names)
        control.value = chosen if chosen in names else names[0]
