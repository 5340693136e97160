"""Edits: each makes another scene of one scene, and leaves the one before as it was.

Those of markers and of the trajectory have modules of their own; here they are all together,
with the settings. :func:`~workbench.authoring.placing.refined` may follow any of them.
"""

from __future__ import annotations

from dataclasses import replace

from workbench.authoring.marker_edits import (
    add_frame,
    add_pose,
    move_marker,
    remove_marker,
    rename_marker,
    turn_joint,
    turned,
)
from workbench.authoring.scene import Scene
from workbench.authoring.trajectory_edits import deform, draw, follow_clip, retime, stretch

__all__ = [
    "add_frame",
    "add_pose",
    "deform",
    "draw",
    "follow_clip",
    "move_marker",
    "remove_marker",
    "rename_marker",
    "retime",
    "set_keep_feet",
    "set_kernel",
    "stretch",
    "turn_joint",
    "turned",
]


def set_keep_feet(scene: Scene, keep: bool) -> Scene:
    """Choose whether the root is recomputed so that the feet do not slide."""
    return replace(scene, keep_feet=keep)


def set_kernel(scene: Scene, kernel: str, epsilon: float | None = None) -> Scene:
    """Choose the radial kernel of the spatial keyframes.

    Parameters
    ----------
    scene : Scene
        The scene.
    kernel : str
        See :class:`~workbench.backprojection.rbf.RBF`.
    epsilon : float or None
        Inverse width of those that have one; None for the usual one.

    Returns
    -------
    Scene

    Raises
    ------
    WorkbenchError
        If there is no such kernel, or the width is not above 0.
    """
    return replace(scene, kernel=kernel, epsilon=epsilon)
