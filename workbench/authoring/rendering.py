"""Rendering: a scene as a motion."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from workbench.authoring.animation import animate
from workbench.authoring.grounding import (
    Support,
    find_support,
    foot_speeds,
    ground_level,
    keep_feet,
)
from workbench.authoring.placing import check_clip, spatial_keyframes
from workbench.authoring.scene import Scene
from workbench.mocap.contacts import find_feet
from workbench.mocap.motion import Motion
from workbench.spaces import PoseSpace


@dataclass(frozen=True, eq=False)
class FootSlide:
    """How fast the supporting foot slides, without and with keeping it in place.

    Attributes
    ----------
    before, after : ndarray of shape (n_frames,)
        Horizontal speed in each frame, in file units per second; 0 where no foot stands.
    """

    before: NDArray[np.float64]
    after: NDArray[np.float64]


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
        If the clip is another one, or the feet are to be kept and none are found below its root.

    Examples
    --------
    >>> from workbench import load_space
    >>> from workbench.authoring import scene_on_circle
    >>> jump = load_space("cmu/01_01-jump")
    >>> scene = scene_on_circle(jump, selector="uniform", count=6)
    >>> motion = play(scene, jump)
    >>> len(motion) == len(jump), bool(np.allclose(motion.rotations[0], jump.samples[0]))
    (True, True)
    """
    check_clip(scene, space)
    motion = _as_rebuilt(scene, space)
    return keep_feet(motion, *_support(motion, space)) if scene.keep_feet else motion


def foot_slide(scene: Scene, space: PoseSpace) -> FootSlide:
    """Compare how feet slide before and after the root is recomputed.

    Parameters
    ----------
    scene : Scene
        The scene, whether it keeps the feet or not.
    space : PoseSpace
        Its clip.

    Returns
    -------
    FootSlide

    Raises
    ------
    WorkbenchError
        If the clip is another one, or no feet are found below its root.
    """
    motion = _as_rebuilt(scene, space)
    support, feet = _support(motion, space)
    kept = keep_feet(motion, support, feet)
    return FootSlide(foot_speeds(motion, support, feet), foot_speeds(kept, support, feet))


def _as_rebuilt(scene: Scene, space: PoseSpace) -> Motion:
    """Play a scene with the root as it is interpolated between the markers."""
    check_clip(scene, space)
    motion = animate(scene.trajectory, spatial_keyframes(scene), space.motion)
    return replace(motion, name=f"{scene.clip} (authored)")


def _support(motion: Motion, space: PoseSpace) -> tuple[Support, tuple[str, ...]]:
    """Find the supporting feet, and their names: feet and ground are those of the clip.

    Other ends of the body may be the lowest ones of the motion that is made of it.
    """
    clip = space.motion
    feet = tuple(clip.skeleton.names[joint] for joint in find_feet(clip))
    return find_support(motion, ground_level(clip, feet), feet), feet
