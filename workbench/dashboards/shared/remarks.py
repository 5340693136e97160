"""What a computation says beside its result."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager

from workbench.errors import AdjustmentWarning, DegenerateDataWarning


@contextmanager
def said_by_warnings() -> Iterator[list[str]]:
    """Collect what the package tells about adjusted parameters and degenerate data."""
    said: list[str] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield said
    ours = (AdjustmentWarning, DegenerateDataWarning)
    said.extend(dict.fromkeys(str(w.message) for w in caught if issubclass(w.category, ours)))
