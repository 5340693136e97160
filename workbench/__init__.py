"""Interactive multidimensional projection and motion capture.

>>> import workbench
>>> iris = workbench.load_space("uci/iris")
>>> result = workbench.SpatialScheme("pca", optimizer="alg12").run(iris, ratio=0.1, random_state=0)
>>> bool(result.error < workbench.SpatialScheme("pca").run(iris, ratio=0.1, random_state=0).error)
True
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from workbench.backprojection import register_back_projector
    from workbench.datasets import load, load_space, register_dataset
    from workbench.errors import (
        AdjustmentWarning,
        DataError,
        DegenerateDataWarning,
        MotionFormatError,
        WorkbenchError,
    )
    from workbench.interpolation import register_interpolator
    from workbench.mocap import Motion, Skeleton, read_asf_amc, read_bvh, write_bvh
    from workbench.optimization import register_optimizer
    from workbench.projection import (
        project,
        register_control_point_projector,
        register_projector,
    )
    from workbench.quality.summary import embedding_quality
    from workbench.schemes import SpatialScheme, TemporalScheme
    from workbench.selection import register_selector
    from workbench.spaces import PoseSpace, VectorSpace

# Names are imported when first used, so that `import workbench` stays fast.
_HOMES = {
    "AdjustmentWarning": "errors",
    "DataError": "errors",
    "DegenerateDataWarning": "errors",
    "Motion": "mocap",
    "MotionFormatError": "errors",
    "PoseSpace": "spaces",
    "Skeleton": "mocap",
    "SpatialScheme": "schemes",
    "TemporalScheme": "schemes",
    "VectorSpace": "spaces",
    "WorkbenchError": "errors",
    "embedding_quality": "quality.summary",
    "load": "datasets",
    "load_space": "datasets",
    "project": "projection",
    "read_asf_amc": "mocap",
    "read_bvh": "mocap",
    "register_back_projector": "backprojection",
    "register_control_point_projector": "projection",
    "register_dataset": "datasets",
    "register_interpolator": "interpolation",
    "register_optimizer": "optimization",
    "register_projector": "projection",
    "register_selector": "selection",
    "write_bvh": "mocap",
}

__all__ = [
    "AdjustmentWarning",
    "DataError",
    "DegenerateDataWarning",
    "Motion",
    "MotionFormatError",
    "PoseSpace",
    "Skeleton",
    "SpatialScheme",
    "TemporalScheme",
    "VectorSpace",
    "WorkbenchError",
    "embedding_quality",
    "load",
    "load_space",
    "project",
    "read_asf_amc",
    "read_bvh",
    "register_back_projector",
    "register_control_point_projector",
    "register_dataset",
    "register_interpolator",
    "register_optimizer",
    "register_projector",
    "register_selector",
    "write_bvh",
]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        # Reading the metadata imports a mail parser, which takes longer than all the rest.
        from importlib.metadata import version

        value = version("workbench")
    elif name in _HOMES:
        value = getattr(import_module(f"workbench.{_HOMES[name]}"), name)
    else:
        raise AttributeError(f"module 'workbench' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOMES])
