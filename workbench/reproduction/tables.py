"""Tables as text: for a reader, in Markdown, and for a paper, in LaTeX."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd


def format_cell(value: Any, *, signed: bool = False) -> str:
    """Write a value as a reader of a table expects it.

    Parameters
    ----------
    value : object
        A number, a text or None.
    signed : bool
        Whether a positive number shows its sign.

    Returns
    -------
    str
        Three decimals for numbers that are not whole, a dash for None, a true minus.

    Examples
    --------
    >>> format_cell(0.5), format_cell(-0.0123, signed=True), format_cell(3), format_cell(None)
    ('0.500', '−0.012', '3', '–')
    """
    if value is None:
        return "\N{EN DASH}"
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return str(value)
    sign = "+" if signed else ""
    if isinstance(value, int):
        text = f"{value:{sign}d}"
    elif math.isfinite(value) and abs(value) >= 1e5:
        text = f"{value:{sign}.3g}"
    else:
        text = f"{value:{sign}.3f}"
    return text.replace("-", "\N{MINUS SIGN}")


def as_markdown(table: pd.DataFrame, caption: str) -> str:
    """Write a table in Markdown, its caption below it.

    Parameters
    ----------
    table : DataFrame
        One level of columns.
    caption : str
        What it shows.

    Returns
    -------
    str
    """
    rows = _cells(table)
    head = [str(table.index.name or ""), *map(str, table.columns)]
    ruler = ["---", *("---:" for _ in table.columns)]
    lines = [
        "| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |"
        for row in [head, ruler, *rows]
    ]
    return "\n".join([*lines, "", caption, ""])


def as_latex(table: pd.DataFrame, caption: str, label: str) -> str:
    """Write a table in LaTeX, for the package booktabs.

    Parameters
    ----------
    table : DataFrame
        One level of columns.
    caption, label : str
        What it shows, and the name to refer to it by.

    Returns
    -------
    str
    """
    head = [str(table.index.name or ""), *map(str, table.columns)]
    body = [" & ".join(map(_escape, row)) + r" \\" for row in [head, *_cells(table)]]
    return "\n".join(
        [
            r"\begin{table}",
            rf"\caption{{{_escape(caption)}}}",
            rf"\label{{tab:{label}}}",
            rf"\begin{{tabular}}{{l{'r' * len(table.columns)}}}",
            r"\toprule",
            body[0],
            r"\midrule",
            *body[1:],
            r"\bottomrule",
            r"\end{tabular}",
            r"\end{table}",
            "",
        ]
    )


def _cells(table: pd.DataFrame) -> list[list[str]]:
    import pandas as pd

    return [
        [str(name), *(format_cell(None if pd.isna(value) else value) for value in row)]
        for name, row in zip(table.index, table.astype(object).to_numpy().tolist(), strict=True)
    ]


#: Characters that LaTeX reads as commands. Others, such as Greek letters, are its input too.
_LATEX = {
    "\\": r"\textbackslash{}",
    "&": r"\&",
    "%": r"\%",
    "$": r"\$",
    "#": r"\#",
    "_": r"\_",
    "{": r"\{",
    "}": r"\}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
}


def _escape(text: str) -> str:
    return "".join(_LATEX.get(character, character) for character in text)
