"""Rendering: a scene as a motion."""

from __future__ import annotations

from dataclasses import replace

from workbench.authoring.animation import animate
from workbench.authoring.placing import check_clip, spatial_keyframes
from workbench.authoring.scene import Scene
from workbench.mocap.motion import Motion
from workbench.spaces import PoseSpace


def play(scene: Scene, space: PoseSpace) -> Motion:
    """Play a scene's trajectory as a motion of its clip's skeleton.

    Each frame's pose and root are rebuilt from where the trajectory is at that time; if the
    scene keeps the feet, the root is then recomputed from them.

    Parameters
    ----------
    scene : Scene
        The scene.
    space : PoseSpace
        Its clip.

    Returns
    -------
    Motion
        With the clip's frame time; ``write_bvh`` writes it to a file.

    Raises
    ------
    WorkbenchError
        If the clip is another one.
    """
    check_clip(scene, space)
    motion = animate(scene.trajectory, spatial_keyframes(scene), space.motion)
    return replace(motion, name=f"{scene.clip} (authored)")
