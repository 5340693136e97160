"""Selectors: which samples become control points or keyframes.

``select(space, count)`` returns sorted indices; see
:class:`~workbench.selection.base.Selector`.
"""

from __future__ import annotations

from workbench.registry import Registry
from workbench.selection.base import Selector

__all__ = ["Selector", "register_selector", "selectors"]

selectors = Registry(
    "selector",
    {
        "uniform": "workbench.selection.uniform:Uniform",
        "random": "workbench.selection.random:Random",
        "scs": "workbench.selection.scs:SimpleCurveSimplification",
        "pb": "workbench.selection.pb:PositionBased",
        "chord": "workbench.selection.chord:ChordSimplification",
        "rols": "workbench.selection.rols:RegularizedOrthogonalLeastSquares",
        "optimal": "workbench.selection.optimal:Optimal",
        "saliency": "workbench.selection.saliency:Saliency",
    },
    needs=("select",),
)
register_selector = selectors.register
