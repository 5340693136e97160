"""What the authoring dashboard asks to be computed beside the kernel, and what it gets."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from workbench.authoring import FootSlide, Scene
from workbench.dashboards.shared.sources import Source
from workbench.projection import projectors
from workbench.registry import Registry
from workbench.selection import selectors
from workbench.spaces import PoseSpace

#: The name by which markers go on a circle instead of being projected.
CIRCLE = "circle"


@dataclass(frozen=True)
class Methods:
    """The kernel's methods, those of its user among them.

    Attributes
    ----------
    selectors, projectors : Registry
        By name.
    """

    selectors: Registry = field(default_factory=lambda: selectors)
    projectors: Registry = field(default_factory=lambda: projectors)


@dataclass(frozen=True)
class Placing:
    """Choose key poses of a clip and place them. Gives :class:`Scene`.

    Attributes
    ----------
    source : Source
        The clip.
    selector : str
        Chooses the key poses.
    count : int
        How many.
    projector : str
        Places them with all other frames, or :data:`CIRCLE`.
    seed : int
        Of both.
    """

    source: Source
    selector: str
    count: int
    projector: str
    seed: int


@dataclass(frozen=True)
class Rendering:
    """Play a scene. Gives :class:`Played`.

    Attributes
    ----------
    source : Source
        The clip.
    scene : Scene
        The scene.
    """

    source: Source
    scene: Scene


@dataclass(frozen=True)
class Refining:
    """Move the frames between markers to where they are rebuilt better. Gives :class:`Refined`.

    Attributes
    ----------
    source : Source
        The clip.
    scene : Scene
        The scene.
    """

    source: Source
    scene: Scene


@dataclass(frozen=True)
class Posing:
    """Turn a joint and let the optimizer place the new pose. Gives :class:`Scene`.

    Attributes
    ----------
    source : Source
        The clip.
    scene : Scene
        The scene.
    marker, joint : int
        Whose pose is turned, and where.
    degrees : tuple of float
        Angles about the joint's own x, y and z axis.
    """

    source: Source
    scene: Scene
    marker: int
    joint: int
    degrees: tuple[float, ...]


Job = Source | Placing | Posing | Rendering | Refining


@dataclass(frozen=True, eq=False)
class Clip:
    """A motion that was loaded.

    Attributes
    ----------
    source : Source
        Where it came from.
    space : PoseSpace
        Its poses.
    """

    source: Source
    space: PoseSpace


@dataclass(frozen=True, eq=False)
class Played:
    """What the motion of a scene is like.

    Attributes
    ----------
    roots : ndarray of shape (n_output_frames, 3)
        Where the root is, in file units.
    slide : FootSlide or None
        Speed of the supporting foot, before and after it was kept; None where no feet are
        found.
    note : str
        Why there is none.
    """

    roots: NDArray[np.float64]
    slide: FootSlide | None
    note: str


@dataclass(frozen=True)
class Errors:
    """What an optimizer was good for.

    Attributes
    ----------
    before, after : float
        Error per frame per joint, in radians.
    """

    before: float
    after: float


@dataclass(frozen=True, eq=False)
class Refined:
    """Better places of a clip's frames.

    Attributes
    ----------
    embedding : ndarray of shape (n_frames, 2)
        The places.
    errors : Errors
        What it was good for.
    """

    embedding: NDArray[np.float64]
    errors: Errors
