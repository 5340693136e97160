"""Read the front end of a widget: plain ES modules and one style sheet, no build step."""

from __future__ import annotations

from pathlib import Path

_FOLDER = Path(__file__).resolve().parent / "static"


def es_module(*names: str) -> str:
    """Read a widget's ES module, in one piece with the parts that it needs.

    A module that travels as text cannot import a neighbour, and a single exported HTML file
    has no neighbours either.

    Parameters
    ----------
    *names : str
        File names without ``.js``, parts first; ``shared.js`` comes before them all.

    Returns
    -------
    str
    """
    return "\n".join(_read(f"{name}.js") for name in ("shared", *names))


def style_sheet() -> str:
    """Read the style sheet of all widgets."""
    return _read("widgets.css")


def page_parts() -> tuple[str, str]:
    """Read the style sheet and the script of a page with exported views."""
    return _read("page.css"), _read("page.js")


def _read(name: str) -> str:
    return (_FOLDER / name).read_text(encoding="utf-8")
