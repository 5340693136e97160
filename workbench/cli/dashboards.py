"""Which notebooks are dashboards, and what they say of themselves."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import nbformat

#: Notebooks that are dashboards, in the order of the index.
DASHBOARDS = (
    "compare_projections",
    "explain_optimizer",
    "inspect_keyframes",
    "author_motion",
    "user_study",
    "take_part",
)


@dataclass(frozen=True)
class Dashboard:
    """A dashboard as the index shows it.

    Attributes
    ----------
    file : str
        Name of its notebook's file.
    title, summary : str
        Heading and first two sentences of its notebook.
    """

    file: str
    title: str
    summary: str


def describe_dashboard(path: Path) -> Dashboard:
    """Read the heading and the first two sentences of a dashboard's notebook.

    Parameters
    ----------
    path : Path
        A notebook that begins with a heading and a paragraph of text.

    Examples
    --------
    >>> from workbench.resources import bundled
    >>> path = bundled("notebooks") / "compare_projections.ipynb"
    >>> describe_dashboard(path).title
    'Compare projections'
    """
    heading, text = nbformat.read(path, as_version=4).cells[0].source.split("\n\n")[:2]
    words = " ".join(text.split()).replace("*", "")
    sentences = words.split(". ")[:2]
    return Dashboard(path.name, heading.lstrip("# "), ". ".join(sentences).rstrip(".") + ".")
