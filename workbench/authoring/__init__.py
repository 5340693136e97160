"""Authoring: making new motions from those that were captured (Costa 2018, chapter 6)."""

from __future__ import annotations

from workbench.authoring.animation import animate, poses_at
from workbench.authoring.trajectories import Trajectory

__all__ = ["Trajectory", "animate", "poses_at"]
