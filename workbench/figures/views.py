"""Views: the direction from which a motion is looked at, and the one that shows it best."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.kinematics import joint_positions
from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.sides import LEFT, RIGHT, joint_sides
from workbench.validation import as_numbers, control_point_indices

#: Degrees from which the ground is seen a little from above, so that it is a surface.
ELEVATION = 8.0

#: Share of the spread along the picture that a path must cover to decide what is right.
_TRAVELS = 0.5


@dataclass(frozen=True)
class View:
    """A direction of sight without perspective; the y axis of the world points up.

    Attributes
    ----------
    azimuth : float
        Degrees that the viewer has walked around the scene: at 0 the z axis points at the
        viewer and x to the right, at 90 the x axis points at the viewer.
    elevation : float
        Degrees that the viewer is above the horizon.

    Raises
    ------
    WorkbenchError
        If an angle is not finite, or the elevation is beyond ±90.

    Examples
    --------
    >>> View(azimuth=90.0).project([[0.0, 1.0, -2.0]]).round(12)
    array([[2., 1.]])
    """

    azimuth: float = 0.0
    elevation: float = 0.0

    def __post_init__(self) -> None:
        if not np.isfinite(self.azimuth) or not -90.0 <= self.elevation <= 90.0:
            raise WorkbenchError(
                f"view: got azimuth {self.azimuth} and elevation {self.elevation}, "
                "want finite degrees, the elevation from -90 to 90"
            )

    @property
    def axes(self) -> NDArray[np.float64]:
        """Directions of right, up and towards the viewer, as rows: (3, 3)."""
        around, above = np.radians(self.azimuth), np.radians(self.elevation)
        right = [np.cos(around), 0.0, -np.sin(around)]
        up = [-np.sin(around) * np.sin(above), np.cos(above), -np.cos(around) * np.sin(above)]
        return np.array([right, up, np.cross(right, up)])

    def project(self, positions: ArrayLike) -> NDArray[np.float64]:
        """Project positions onto the picture.

        Parameters
        ----------
        positions : array-like of shape (..., 3)
            World positions, y up.

        Returns
        -------
        ndarray of shape (..., 2)
            Right and up in the picture, in the same units.
        """
        return np.asarray(as_numbers("positions", positions, 3) @ self.axes[:2].T)

    def nearness(self, positions: ArrayLike) -> NDArray[np.float64]:
        """Measure how far towards the viewer positions are: (..., 3) to (...)."""
        return np.asarray(as_numbers("positions", positions, 3) @ self.axes[2])


def best_view(
    motion: Motion,
    frames: ArrayLike | None = None,
    *,
    elevation: float = ELEVATION,
) -> View:
    """Find the view along which the joints spread most.

    The horizontal direction of the largest variance of all joint positions, the path of the
    root included, lies in the picture. Of the two sides to look from, a motion that travels is
    seen from that on which it goes to the right, as time does; any other from where the body
    faces the viewer.

    Parameters
    ----------
    motion : Motion
        The clip.
    frames : array-like of shape (n_poses,), optional
        Frames that will be drawn; all by default.
    elevation : float
        Degrees above the horizon.

    Returns
    -------
    View

    Raises
    ------
    WorkbenchError
        If a frame is not one of the clip's.
    """
    check_motion(motion)
    positions = joint_positions(motion)
    if frames is not None:
        positions = positions[control_point_indices(frames, len(motion), name="frames")]
    flat = positions[..., [0, 2]]
    spread = flat.reshape(-1, 2) - flat.reshape(-1, 2).mean(axis=0)
    _, _, directions = np.linalg.svd(spread, full_matrices=False)
    right = directions[0]
    reach = np.ptp(spread @ right)
    travelled = (flat[-1, 0] - flat[0, 0]) @ right
    if abs(travelled) > _TRAVELS * reach:
        is_backwards = travelled < 0
    else:
        is_backwards = _facing(motion, positions) @ [-right[1], right[0]] < 0
    if is_backwards:
        right = -right
    # Adding 0 keeps -0.0 out of what is shown.
    azimuth = np.degrees(np.arctan2(-right[1], right[0])) % 360.0 + 0.0
    return View(round(float(azimuth), 6), elevation)


def _facing(motion: Motion, positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Find where the body faces on average, as (x, z); zero where sides are not known."""
    sides = np.array(joint_sides(motion.skeleton.names))
    if not (np.any(sides == LEFT) and np.any(sides == RIGHT)):
        return np.zeros(2)
    left = positions[:, sides == LEFT].mean(axis=1) - positions[:, sides == RIGHT].mean(axis=1)
    x, _, z = left.mean(axis=0)
    return np.array([-z, x])
