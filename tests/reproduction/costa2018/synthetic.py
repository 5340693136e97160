"""Tables of results with known values, in place of computed ones."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import pandas as pd

from workbench.experiments.runs.base import Run

Values = Callable[[dict[str, Any]], dict[str, Any] | str]


def results_of(runs: Iterable[Run], values: Values) -> pd.DataFrame:
    """Make the table of a grid whose runs gave known values.

    Parameters
    ----------
    runs : iterable of Run
        The runs.
    values : callable
        Takes a run's specification and gives its values, or why it failed.
    """
    rows = []
    for number, run in enumerate(runs):
        specification = run.specification()
        found = values(specification)
        outcome: dict[str, Any] = {"status": "done", "message": ""}
        if isinstance(found, str):
            outcome, found = {"status": "failed", "message": found}, {}
        rows.append({"key": str(number), "n_samples": 300, **specification, **outcome, **found})
    return pd.DataFrame(rows)
