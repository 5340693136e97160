"""Motion capture: skeletons, motions, motion files, kinematics.

Names are imported when they are used, because the compiled kernels behind some of them
take longer to import than a command line may take to answer.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from workbench.mocap.amc import JointAngles, read_amc, read_asf_amc
    from workbench.mocap.asf import AcclaimSkeleton, read_asf
    from workbench.mocap.bvh import read_bvh
    from workbench.mocap.bvh_writer import write_bvh
    from workbench.mocap.channels import (
        channels_from_rotations,
        motion_to_euler,
        rotations_from_channels,
    )
    from workbench.mocap.kinematics import (
        body_positions,
        end_site_positions,
        forward_kinematics,
        joint_positions,
        root_relative_positions,
    )
    from workbench.mocap.motion import Motion
    from workbench.mocap.reading import read_motion
    from workbench.mocap.resampling import resample
    from workbench.mocap.skeleton import EndSite, Skeleton
    from workbench.mocap.tpose import drop_tpose, has_tpose

__all__ = [
    "AcclaimSkeleton",
    "EndSite",
    "JointAngles",
    "Motion",
    "Skeleton",
    "body_positions",
    "channels_from_rotations",
    "drop_tpose",
    "end_site_positions",
    "forward_kinematics",
    "has_tpose",
    "joint_positions",
    "motion_to_euler",
    "read_amc",
    "read_asf",
    "read_asf_amc",
    "read_bvh",
    "read_motion",
    "resample",
    "root_relative_positions",
    "rotations_from_channels",
    "write_bvh",
]

_MODULES = {
    "amc": ("JointAngles", "read_amc", "read_asf_amc"),
    "asf": ("AcclaimSkeleton", "read_asf"),
    "bvh": ("read_bvh",),
    "bvh_writer": ("write_bvh",),
    "channels": ("channels_from_rotations", "motion_to_euler", "rotations_from_channels"),
    "kinematics": (
        "body_positions",
        "end_site_positions",
        "forward_kinematics",
        "joint_positions",
        "root_relative_positions",
    ),
    "motion": ("Motion",),
    "reading": ("read_motion",),
    "resampling": ("resample",),
    "skeleton": ("EndSite", "Skeleton"),
    "tpose": ("drop_tpose", "has_tpose"),
}


def __getattr__(name: str) -> Any:
    for module, names in _MODULES.items():
        if name in names:
            return getattr(import_module(f"workbench.mocap.{module}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
