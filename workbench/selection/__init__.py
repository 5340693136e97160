"""Selectors: which samples become control points or keyframes.

A selector has one method, ``select(space, count)``, which returns sorted indices.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from workbench.registry import Registry
from workbench.spaces import Space


class Selector(Protocol):
    """What a selector offers."""

    def select(self, space: Space, count: int) -> NDArray[np.intp]:
        """Pick ``count`` samples of the space; return their sorted indices."""
        ...


selectors = Registry(
    "selector",
    {
        "uniform": "workbench.selection.uniform:Uniform",
        "random": "workbench.selection.random:Random",
    },
    needs=("select",),
)
register_selector = selectors.register
