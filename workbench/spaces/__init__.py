"""Spaces of samples: what every step of the pipeline works on.

A space knows its samples, how far apart they are, how wrong a reconstruction of one is,
and which samples are next to each other. Motion capture and tables differ in nothing
else, so all other steps serve both.
"""

from __future__ import annotations

from workbench.spaces.base import Space, check_space
from workbench.spaces.clips import ClipSpace
from workbench.spaces.poses import PoseSpace
from workbench.spaces.vectors import VectorSpace

__all__ = ["ClipSpace", "PoseSpace", "Space", "VectorSpace", "check_space"]
