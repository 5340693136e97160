"""Selectors: which samples become control points or keyframes.

``select(space, count)`` returns sorted indices; see
:class:`~workbench.selection.base.Selector`. Each selector is a module of its own:

- any samples: ``uniform``, ``random``, ``rols``;
- frames of a motion: ``scs``, ``pb``, ``chord``, ``optimal``, ``saliency`` (whose method is in
  :mod:`workbench.mocap.motion_saliency`).

The other modules are parts of these: ``base`` of all; ``tracks`` and ``track_errors`` lay a
motion out and measure frames interpolated between two keys; ``splitting`` and
``worst_frames`` split a motion at its worst frame; ``best_paths`` is the dynamic programming
behind ``optimal``.
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
