"""Tables of ratios show the numbers they are given."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from workbench.errors import WorkbenchError
from workbench.figures.ratios import ratio_tables

RATIOS = pd.DataFrame({"PCA": [0.5, 1.0], "MDS": [2.0, np.nan]}, index=["Iris", "Wine"])


def test_cells_hold_the_ratios():
    """Numbers are written as given and coloured by their logarithm, rows from the top."""
    figure = ratio_tables({"ours": RATIOS, "published": RATIOS * 2}, title="after / before")
    ours, theirs = figure.data
    assert list(ours.y) == ["Iris", "Wine"]
    assert [list(line) for line in ours.text] == [["0.50", "2.00"], ["1.00", ""]]
    assert np.allclose(ours.z, [[-1, 1], [0, np.nan]], equal_nan=True)
    assert theirs.text[0][1] == "4.00"
    assert figure.layout.yaxis.autorange == "reversed"


def test_up_and_down_are_equally_strong():
    """The scale is symmetric about 1, so that half and twice have equally strong colours."""
    axis = ratio_tables({"ours": RATIOS}, title="after / before").layout.coloraxis
    assert axis.cmin == -axis.cmax
    assert axis.colorscale[1] == (0.5, "#FFFFFF")


def test_tiny_ratios_are_not_written_as_nothing():
    """A ratio of 0.002 is not rounded to 0.00."""
    assert ratio_tables({"": RATIOS * 0.004}, title="").data[0].text[0][0] == "0.002"


@pytest.mark.parametrize(
    "tables", [{}, {"a": RATIOS.iloc[:0]}, {"a": -RATIOS}], ids=["none", "empty", "negative"]
)
def test_what_is_no_ratio_is_refused(tables):
    """Nothing to draw and a ratio without a logarithm are errors."""
    with pytest.raises(WorkbenchError, match=r"table"):
        ratio_tables(tables, title="")
