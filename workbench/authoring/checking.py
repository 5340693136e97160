"""A check that trajectories and scenes share."""

from __future__ import annotations

from numbers import Real
from typing import Any

import numpy as np

from workbench.errors import WorkbenchError


def above_zero(name: str, value: Any) -> float:
    """Refuse what is no finite number above 0.

    Raises
    ------
    WorkbenchError
        If it is not; the message names the argument.
    """
    if not isinstance(value, Real) or isinstance(value, bool) or not 0 < float(value) < np.inf:
        raise WorkbenchError(f"{name}: got {value!r}, want a number above 0")
    return float(value)
