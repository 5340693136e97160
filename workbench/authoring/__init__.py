"""Authoring: making new motions from those that were captured (Costa 2018, chapter 6).

>>> from workbench import load_space
>>> from workbench.authoring import edits, play, scene_on_circle
>>> jump = load_space("cmu/01_01-jump")
>>> scene = scene_on_circle(jump, selector="uniform", count=8)
>>> scene = edits.move_marker(scene, jump, 3, [0.5, 0.5])
>>> scene = edits.stretch(scene, 0.0, 1.0, 2.0)
>>> len(play(scene, jump)) > len(jump)
True
"""

from __future__ import annotations

from workbench.authoring import edits
from workbench.authoring.animation import animate, poses_at
from workbench.authoring.grounding import find_support, foot_speeds, keep_feet
from workbench.authoring.history import History
from workbench.authoring.new_poses import best_place
from workbench.authoring.placing import (
    Refinement,
    influence,
    placed,
    reconstruction_error,
    refined,
    spatial_keyframes,
)
from workbench.authoring.rendering import FootSlide, foot_slide, play
from workbench.authoring.scene import Marker, Scene
from workbench.authoring.session_file import (
    Session,
    read_session,
    save_session,
    session_bytes,
    session_from_bytes,
)
from workbench.authoring.starts import scene_from_clip, scene_on_circle
from workbench.authoring.trajectories import Trajectory

__all__ = [
    "FootSlide",
    "History",
    "Marker",
    "Refinement",
    "Scene",
    "Session",
    "Trajectory",
    "animate",
    "best_place",
    "edits",
    "find_support",
    "foot_slide",
    "foot_speeds",
    "influence",
    "keep_feet",
    "placed",
    "play",
    "poses_at",
    "read_session",
    "reconstruction_error",
    "refined",
    "save_session",
    "scene_from_clip",
    "scene_on_circle",
    "session_bytes",
    "session_from_bytes",
    "spatial_keyframes",
]
