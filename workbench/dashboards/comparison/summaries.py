"""What the views need to know of samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.mocap.body_nodes import BodyNodes, body_nodes, node_positions
from workbench.spaces import PoseSpace, Space, VectorSpace


@dataclass(frozen=True, eq=False)
class Body:
    """A motion as the pose view draws it.

    Attributes
    ----------
    positions : ndarray of shape (n_frames, n_nodes, 3), float32
        Joints, followed by end sites, in file units.
    nodes : BodyNodes
        How these hang together.
    frame_time : float
        Seconds.
    """

    positions: NDArray[np.float32]
    nodes: BodyNodes
    frame_time: float


@dataclass(frozen=True, eq=False)
class Summary:
    """What the views need to know of the samples.

    Attributes
    ----------
    name : str
        What to call them.
    n_samples, n_features : int
        Their number and that of their features.
    classes : ndarray of shape (n_samples,), int32
        Index into ``class_names``; empty without classes.
    class_names : list of str
        Sorted.
    columns : list of str
        Features of a table.
    values : ndarray of shape (n_samples, n_features), float32
        The table.
    body : Body or None
        Poses, for a motion.
    notes : tuple of str
        How the data were treated.
    """

    name: str
    n_samples: int
    n_features: int
    classes: NDArray[np.int32]
    class_names: list[str]
    columns: list[str]
    values: NDArray[np.float32]
    body: Body | None
    notes: tuple[str, ...]


def summarize(space: Space, notes: tuple[str, ...] = ()) -> Summary:
    """Describe samples for the views."""
    names: list[str] = []
    classes = np.empty(0, dtype=np.int32)
    labels = getattr(space, "labels", None)
    if labels is not None:
        unique, inverse = np.unique(labels.astype(str), return_inverse=True)
        names, classes = unique.tolist(), inverse.astype(np.int32)
    table = isinstance(space, VectorSpace)
    return Summary(
        name=space.name,
        n_samples=len(space),
        n_features=space.features.shape[1],
        classes=classes,
        class_names=names,
        columns=list(space.columns) if isinstance(space, VectorSpace) else [],
        values=space.features.astype(np.float32) if table else np.empty((0, 0), np.float32),
        body=_body(space) if isinstance(space, PoseSpace) else None,
        notes=notes,
    )


def _body(space: PoseSpace) -> Body:
    return Body(
        positions=node_positions(space.motion).astype(np.float32),
        nodes=body_nodes(space.motion.skeleton),
        frame_time=space.motion.frame_time,
    )
