"""Figures 4.3 and A.1 to A.5 of Halit 2010: motions in one picture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.mocap.motion import Motion
from workbench.reproduction.clips import BUNDLED, PictureClip, picture_clip
from workbench.selection.saliency import Saliency
from workbench.spaces import PoseSpace


@dataclass(frozen=True)
class SummaryFigure:
    """A figure that sums up a motion.

    Attributes
    ----------
    id : str
        Id of the figure.
    action : str
        What is done in the published motion.
    clips : tuple of str
        Clips that show the same or stand in for it, best first; the last is bundled.
    count : int
        How many keyframes are drawn.
    sigma : float
        σ of the saliency, in frames: at most 3 for fast motions, 7 to 10 for calm ones.
    """

    id: str
    action: str
    clips: tuple[str, ...]
    count: int
    sigma: float


#: The thesis names no clips of the CMU collection, and no flip or boxing is in the range that
#: is catalogued here.
FLIP = SummaryFigure("halit2010:fig4.3", "a flip", ("cmu/01_03-swing",), 12, 3.0)
SUMMARIES = (
    SummaryFigure(
        "halit2010:figA.1",
        "the basketball motion",
        ("cmu/06_12", "cmu/06_13", "cmu/06_07", "cmu/06_02", "cmu/01_03-climb-up"),
        10,
        3.0,
    ),
    SummaryFigure(
        "halit2010:figA.2",
        "the walking motion",
        ("cmu/02_01", "cmu/07_01", "cmu/08_02", "cmu/01_03-walk"),
        10,
        10.0,
    ),
    SummaryFigure(
        "halit2010:figA.3",
        "the boxing motion",
        ("cmu/02_05", "cmu/01_03-lean-over"),
        10,
        3.0,
    ),
    SummaryFigure("halit2010:figA.4", "the flip", ("cmu/01_03-swing",), 10, 3.0),
    SummaryFigure(
        "halit2010:figA.5", "the dancing motion", ("cmu/05_13", "cmu/05_10", BUNDLED), 10, 7.0
    ),
)


@dataclass(frozen=True, eq=False)
class Summary:
    """What a figure shows.

    Attributes
    ----------
    clip : PictureClip
        Which clip.
    motion : Motion
        That clip.
    keyframes : ndarray of shape (n_keyframes,)
        Its most salient frames, and both ends.
    caption, alt : str
        What is seen, and what a reader who does not see it should know.
    """

    clip: PictureClip
    motion: Motion
    keyframes: NDArray[np.intp]
    caption: str
    alt: str


def summary(figure: SummaryFigure, profile: str) -> Summary:
    """Choose the clip of a figure and its keyframes.

    Parameters
    ----------
    figure : SummaryFigure
        One of those above.
    profile : {"quick", "full"}
        ``quick`` takes bundled clips only.

    Returns
    -------
    Summary

    Raises
    ------
    WorkbenchError
        If none of its clips is on this machine.
    """
    clip = picture_clip(figure.action, profile, instead=figure.clips)
    space = load_space(clip.name)
    if not isinstance(space, PoseSpace):
        raise WorkbenchError(f"{clip.name}: is no motion")
    keyframes = Saliency(sigma=figure.sigma).select(space, figure.count)
    caption = (
        f"{len(keyframes)} keyframes of {len(space)} by motion saliency (σ = {figure.sigma:g}), "
        f"with both ends. Clip: {clip}. {clip.note}"
    )
    seconds = (len(space) - 1) * space.motion.frame_time
    alt = (
        f"Stick figures of one body, {clip.title}, over {seconds:.1f} s: frames "
        f"{', '.join(map(str, keyframes))}."
    )
    return Summary(clip, space.motion, keyframes, caption, alt)
