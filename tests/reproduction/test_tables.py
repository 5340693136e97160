"""Tables as text."""

from __future__ import annotations

import pandas as pd

from workbench.reproduction.tables import as_latex, as_markdown

TABLE = pd.DataFrame(
    {"error_ours": [0.5, None], "a|b": ["10 %", "x_1 & y"]}, index=pd.Index(["t-SNE", "σ"])
)


def test_markdown_has_a_row_for_each_row():
    """Bars inside cells do not end them, and what is missing is a dash."""
    assert as_markdown(TABLE, "Errors.").splitlines() == [
        "|  | error_ours | a\\|b |",
        "| --- | ---: | ---: |",
        "| t-SNE | 0.500 | 10 % |",
        "| σ | – | x_1 & y |",
        "",
        "Errors.",
    ]


def test_latex_escapes_what_it_would_take_for_commands():
    """Per cent signs, underscores and ampersands of cells and captions are text."""
    text = as_latex(TABLE, "3 % of {x}.", "errors")
    assert r"\caption{3 \% of \{x\}.}" in text
    assert r"t-SNE & 0.500 & 10 \% \\" in text
    assert r"σ & – & x\_1 \& y \\" in text
    assert r" & error\_ours & a|b \\" in text
    assert text.count(r"\\") == 3
