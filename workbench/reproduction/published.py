"""Values that the theses print, for comparison with ours."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from workbench.errors import WorkbenchError

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Published:
    """What is printed for one figure or table.

    Attributes
    ----------
    thesis : str
        Author and year.
    place : str
        Number of the figure or table.
    page : int
        Page as printed in the thesis's lists of figures and tables.
    quantity : str
        What the values are.
    columns : tuple of str
        Columns of a table; empty for a single value.
    rows : dict of str to tuple of float
        Rows of a table.
    value : float or None
        A single value.
    note : str
        What a reader should know of it.
    """

    thesis: str
    place: str
    page: int
    quantity: str
    columns: tuple[str, ...] = ()
    rows: dict[str, tuple[float, ...]] | None = None
    value: float | None = None
    note: str = ""

    @property
    def source(self) -> str:
        """Where to look it up: "Costa 2018, Table 5.1, page 23"."""
        return f"{self.thesis}, {self.place}, page {self.page}"

    def table(self) -> pd.DataFrame:
        """Give the rows as a data frame.

        Raises
        ------
        WorkbenchError
            If a single value was published, not a table.
        """
        if self.rows is None:
            raise WorkbenchError(f"{self.source}: is a single value, not a table")
        # Imported here because the report, which needs no table, should start at once.
        import pandas as pd

        return pd.DataFrame.from_dict(self.rows, orient="index", columns=list(self.columns))


@cache
def _all() -> dict[str, dict[str, Any]]:
    path = Path(__file__).with_name("published.toml")
    return tomllib.loads(path.read_text(encoding="utf-8"))


def published_ids() -> list[str]:
    """List the ids of figures and tables with published values."""
    return list(_all())


def published(item_id: str) -> Published:
    """Look up what is printed for a figure or table.

    Parameters
    ----------
    item_id : str
        Such as ``"costa2018:tab5.1"``.

    Returns
    -------
    Published

    Raises
    ------
    WorkbenchError
        If no values were published, or they have not been entered.

    Examples
    --------
    >>> published("costa2018:fig5.12").value
    0.36
    >>> published("costa2018:tab5.1").table().loc["t-SNE", "Q2"]
    np.float64(0.515)
    """
    if item_id not in _all():
        raise WorkbenchError(f"{item_id}: no published values, want one of {', '.join(_all())}")
    return Published(**_all()[item_id])
