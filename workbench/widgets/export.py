"""Write views to a single HTML file that stays interactive without a kernel.

Notebook exports load scripts from elsewhere and are dead without them. A view of ours needs
only its ES module and its traits, so one file can hold all of it.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any, TypeAlias

import anywidget
import ipywidgets

from workbench.errors import WorkbenchError
from workbench.files import write_atomically
from workbench.widgets.figure import FigureView, packed_library
from workbench.widgets.module import page_parts, style_sheet
from workbench.widgets.scatter import ScatterPanels

View: TypeAlias = "anywidget.AnyWidget | ipywidgets.HTML"
Views: TypeAlias = "View | Sequence[View | Sequence[View]]"

_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<title>{title}</title>
<style>
{style}</style>
</head>
<body>
<main>
<h1>{title}</h1>
{text}{rows}
</main>
<script type="application/json" id="wb-content">{content}</script>
<script type="module">
{script}</script>
</body>
</html>
"""

# The browser itself refuses every request, whatever a script may try.
_POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' blob:; style-src 'unsafe-inline'; "
    "img-src data: blob:; font-src data:"
)

# Traits of every widget that mean nothing outside a notebook.
_OWN = frozenset(ipywidgets.DOMWidget.class_trait_names())

# Switches of what needs Python: there is none to make another page or to take edits in.
_NEEDING_PYTHON = ("offers_html", "editable")


def html_page(views: Views, *, title: str, text: str = "") -> str:
    """Make a page that holds views and what they need.

    Views with the same channel follow each other's hovered sample as in the notebook. What
    the person does in the page changes nothing elsewhere.

    Parameters
    ----------
    views : widget or sequence
        A view, or a column of views and rows (sequences) of views. Views whose layout has
        ``display="none"`` are left out.
    title : str
        Heading and title of the page.
    text : str
        A few plain words below the heading.

    Returns
    -------
    str
        The page, which makes no request to anywhere.

    Raises
    ------
    WorkbenchError
        If there is no view, or one of another kind than those of ``workbench.widgets`` and
        ``ipywidgets.HTML``.

    Examples
    --------
    >>> panels = ScatterPanels(panels=[{"title": "PCA"}], points=[[[0, 0], [1, 1]]])
    >>> page = html_page(panels, title="Two samples")
    >>> page.count("<h1>Two samples</h1>"), "http:" in page
    (1, False)
    """
    rows = _rows(views)
    modules: list[str] = []
    packed = []
    lines = []
    for row in rows:
        places = []
        for view in row:
            if isinstance(view, anywidget.AnyWidget):
                packed.append(_packed(view, modules))
                places.append(_place(len(packed) - 1, view))
            else:
                places.append(f'<div class="wb-place wb-still">{view.value}</div>')
        lines.append(f'<div class="wb-row">{"".join(places)}</div>')
    with_figure = any(isinstance(view, FigureView) for row in rows for view in row)
    answers = {"plotly.js": _text(packed_library())} if with_figure else {}
    content = {"modules": modules, "views": packed, "answers": answers}
    style, script = page_parts()
    return _PAGE.format(
        policy=_POLICY,
        title=escape(title),
        style=style + style_sheet(),
        text=f'<p class="wb-text">{escape(text)}</p>\n' if text else "",
        rows="\n".join(lines),
        # No text in it can end the element that holds it.
        content=json.dumps(content).replace("<", "\\u003c"),
        script=script,
    )


def export_html(
    views: Views,
    path: str | Path,
    *,
    title: str,
    text: str = "",
) -> Path:
    """Write views to one HTML file that can be opened, sent and archived.

    Parameters
    ----------
    views : widget or sequence
        As for :func:`html_page`.
    path : path-like
        The file; one that exists is replaced.
    title : str
        Heading and title of the page.
    text : str
        A few plain words below the heading.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    WorkbenchError
        As for :func:`html_page`.
    """
    page = html_page(views, title=title, text=text)
    write_atomically(Path(path), page.encode())
    return Path(path)


def _rows(views: Views) -> list[list[View]]:
    column = [views] if isinstance(views, ipywidgets.Widget) else list(views)
    rows = [[each] if isinstance(each, ipywidgets.Widget) else list(each) for each in column]
    for view in (view for row in rows for view in row):
        if not isinstance(view, (anywidget.AnyWidget, ipywidgets.HTML)):
            raise WorkbenchError(
                f"views: got {type(view).__name__}, want views of workbench.widgets or HTML"
            )
    shown = [[view for view in row if view.layout.display != "none"] for row in rows]
    if not any(shown):
        raise WorkbenchError("views: got no view that is shown, want at least one")
    return [row for row in shown if row]


def _place(number: int, view: anywidget.AnyWidget) -> str:
    wide = " data-wide" if isinstance(view, ScatterPanels) else ""
    kind = escape(type(view).__name__)
    return (
        f'<div class="wb-place" data-view="{number}" data-kind="{kind}"{wide}>'
        "<p>This view needs a browser with JavaScript.</p></div>"
    )


def _packed(view: anywidget.AnyWidget, modules: list[str]) -> dict[str, Any]:
    """Collect a view's traits, and its module unless another view brought it."""
    module = str(view._esm)
    if module not in modules:
        modules.append(module)
    traits: dict[str, Any] = {}
    binary: dict[str, str] = {}
    for name, value in view.get_state().items():
        if name in _OWN or name.startswith("_"):
            continue
        if isinstance(value, bytes):
            binary[name] = _text(value)
        else:
            traits[name] = value
    traits.update({name: False for name in _NEEDING_PYTHON if name in traits})
    try:
        json.dumps(traits, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise WorkbenchError(
            f"views: {type(view).__name__} has a trait that cannot be written: {error}"
        ) from None
    return {"module": modules.index(module), "traits": traits, "binary": binary}


def _text(content: bytes) -> str:
    return base64.b64encode(content).decode("ascii")
