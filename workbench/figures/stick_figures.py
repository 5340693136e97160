"""Stick figures: poses as skeletons, seen from one side.

Still pictures, filmstrips and thumbnails draw these same segments, so that a pose looks alike
in all of them; :mod:`workbench.figures.stick_drawing` draws them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.figures.stick_look import HEAD_RADIUS
from workbench.figures.views import View, best_view
from workbench.mocap.body_nodes import body_nodes, node_positions
from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.sides import LEFT, RIGHT
from workbench.validation import control_point_indices


@dataclass(frozen=True, eq=False)
class StickFigures:
    """Poses of one motion, projected onto a picture; lengths are in file units.

    Attributes
    ----------
    segments : ndarray of shape (n_poses, n_bones, 2, 2)
        Both ends of each bone: right and up.
    sides : tuple of {"left", "right", "middle"}, of length n_bones
        Which side of the body each bone is on.
    heads : ndarray of shape (n_poses, n_heads, 2)
        Centres of the head, of which a skeleton has one or none.
    head_radius : float
        Of the circle around it.
    shadows : ndarray of shape (n_poses, n_bones, 2, 2)
        The bones dropped to the ground.
    roots : ndarray of shape (n_poses, 2)
        The root on the ground.
    nearer : tuple of {"left", "right"}, of length n_poses
        The side of the body that is nearer to the viewer, to be drawn last.
    body_height : float
        Largest extent of the body at rest.
    """

    segments: NDArray[np.float64]
    sides: tuple[str, ...]
    heads: NDArray[np.float64]
    head_radius: float
    shadows: NDArray[np.float64]
    roots: NDArray[np.float64]
    nearer: tuple[str, ...]
    body_height: float

    def __len__(self) -> int:
        return len(self.segments)

    def moved(self, shifts: ArrayLike) -> StickFigures:
        """Shift each pose in the picture, its shadow with it.

        Parameters
        ----------
        shifts : array-like of shape (n_poses, 2)
            Right and up.

        Returns
        -------
        StickFigures
        """
        by = np.asarray(shifts, dtype=np.float64)
        return replace(
            self,
            segments=self.segments + by[:, None, None],
            heads=self.heads + by[:, None],
            shadows=self.shadows + by[:, None, None],
            roots=self.roots + by,
        )

    def bounds(self) -> NDArray[np.float64]:
        """Find the box around each pose and its shadow: (n_poses, 2, 2), low and high corners."""
        n = len(self)
        ends = np.concatenate(
            [
                self.segments.reshape(n, -1, 2),
                self.shadows.reshape(n, -1, 2),
                self.heads - self.head_radius,
                self.heads + self.head_radius,
            ],
            axis=1,
        )
        return np.stack([ends.min(axis=1), ends.max(axis=1)], axis=1)


def stick_figures(
    motion: Motion,
    frames: ArrayLike,
    view: View | None = None,
    *,
    in_place: bool = False,
) -> StickFigures:
    """Project poses of a motion as stick figures.

    Parameters
    ----------
    motion : Motion
        The clip.
    frames : array-like of shape (n_poses,)
        Frames to draw, sorted.
    view : View, optional
        Where to look from; by default where these poses spread most.
    in_place : bool
        Whether to leave out the root's path over the ground; its height stays.

    Returns
    -------
    StickFigures

    Raises
    ------
    WorkbenchError
        If a frame is not one of the clip's, or they are not sorted.
    """
    check_motion(motion)
    chosen = control_point_indices(frames, len(motion), name="frames")
    view = view or best_view(motion, chosen)
    body = body_nodes(motion.skeleton)
    nodes = node_positions(motion)
    ground = nodes[..., 1].min()
    nodes = nodes[chosen]
    if in_place:
        nodes = nodes - nodes[:, :1] * [1.0, 0.0, 1.0]
    parents, sides = np.array(body.parents, dtype=np.intp), np.array(body.sides)
    bones = [node for node in range(1, len(parents)) if node != body.head]
    lengths = np.linalg.norm(nodes[:, bones] - nodes[:, parents[bones]], axis=2)
    bones = [node for node, length in zip(bones, lengths.max(axis=0), strict=True) if length > 0]
    ends = np.stack([nodes[:, parents[bones]], nodes[:, bones]], axis=2)
    dropped = ends.copy()
    dropped[..., 1] = ground
    on_ground = nodes[:, 0].copy()
    on_ground[:, 1] = ground
    height = _body_height(motion)
    heads = np.empty((len(nodes), 0, 2))
    if body.head >= 0:
        heads = view.project((nodes[:, [body.head]] + nodes[:, [parents[body.head]]]) / 2)
    return StickFigures(
        segments=view.project(ends),
        sides=tuple(sides[bones].tolist()),
        heads=heads,
        head_radius=HEAD_RADIUS * height,
        shadows=view.project(dropped),
        roots=view.project(on_ground),
        nearer=_nearer_sides(view.nearness(nodes), sides),
        body_height=height,
    )


def _body_height(motion: Motion) -> float:
    """Measure the body in its rest pose, upright or with arms spread, whichever is longer."""
    rest = replace(
        motion[:1],
        rotations=np.broadcast_to(np.eye(3), (1, *motion.rotations.shape[1:])),
        root_translation=np.zeros((1, 3)),
        joint_translations={},
    )
    return float(np.ptp(node_positions(rest), axis=1).max()) or 1.0


def _nearer_sides(nearness: NDArray[np.float64], sides: NDArray[np.str_]) -> tuple[str, ...]:
    if not (np.any(sides == LEFT) and np.any(sides == RIGHT)):
        return (LEFT,) * len(nearness)
    left = nearness[:, sides == LEFT].mean(axis=1)
    right = nearness[:, sides == RIGHT].mean(axis=1)
    return tuple(np.where(left > right, LEFT, RIGHT).tolist())
