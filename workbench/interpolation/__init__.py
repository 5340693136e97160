"""Interpolators: in-between poses from keyframes and their times.

``interpolate(motion, keyframes)`` rebuilds the rotations of all frames from the keyframes.
"""

from __future__ import annotations

from workbench.interpolation.base import Interpolator
from workbench.registry import Registry

__all__ = ["Interpolator", "interpolators", "register_interpolator"]

interpolators = Registry(
    "interpolator",
    {
        "linear": "workbench.interpolation.linear:Linear",
        "hermite": "workbench.interpolation.hermite:Hermite",
        "hermite-keys": "workbench.interpolation.hermite:HermiteFromKeys",
        "slerp": "workbench.interpolation.slerp:Slerp",
        "rbf": "workbench.interpolation.rbf:RBFInTime",
    },
    needs=("interpolate",),
)
register_interpolator = interpolators.register
