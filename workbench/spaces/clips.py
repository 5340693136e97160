"""Poses of several clips of one skeleton as one space."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.mocap.joining import join
from workbench.mocap.motion import Motion
from workbench.spaces.poses import PoseSpace


class ClipSpace(PoseSpace):
    """Poses of several clips under one D_q, so that one map can show them all.

    Frames follow each other within their clip only. The clip is the class of its frames;
    like any label it is never used by a projection.

    Parameters
    ----------
    motions : sequence of Motion
        The clips, of one skeleton and one frame rate.
    notes : tuple of str
        What was done to the data when they were read.

    Attributes
    ----------
    clip : ndarray of shape (n_frames,)
        Index of the clip that each frame is from.
    clip_names : tuple of str
        Names of the clips.

    Raises
    ------
    WorkbenchError
        If skeletons or frame rates differ, or as for :class:`PoseSpace`.
    """

    def __init__(self, motions: Sequence[Motion], *, notes: tuple[str, ...] = ()) -> None:
        super().__init__(join(motions))
        self.notes = tuple(notes)
        names = tuple(motion.name or f"clip {i}" for i, motion in enumerate(motions, start=1))
        self._divide(np.repeat(np.arange(len(motions)), [len(m) for m in motions]), names)

    def _divide(self, clip: NDArray[np.intp], names: tuple[str, ...]) -> None:
        self.clip, self.clip_names = clip, names
        self.labels = np.array(names)[clip]

    def subset(self, indices: ArrayLike) -> ClipSpace:
        """Make a space of some of the frames, each still of its clip."""
        chosen = super().subset(indices)
        space = ClipSpace([chosen.motion], notes=self.notes)
        space._divide(self.clip[np.asarray(indices)], self.clip_names)
        return space

    @cached_property
    def neighbors(self) -> NDArray[np.intp]:
        """The previous and the next frame of the same clip: (n_frames, 2).

        The only frame of a clip has itself for both.
        """
        frames = np.arange(len(self))
        before, after = np.maximum(frames - 1, 0), np.minimum(frames + 1, len(self) - 1)
        has_before = (frames > 0) & (self.clip[before] == self.clip)
        has_after = (frames < len(self) - 1) & (self.clip[after] == self.clip)
        alone = ~has_before & ~has_after
        before, after = np.where(has_before, before, after), np.where(has_after, after, before)
        return np.stack([np.where(alone, frames, before), np.where(alone, frames, after)], axis=1)
