"""Motions that a study shows: made from parameters that make them again exactly.

The parameters of a stimulus are

- ``clip``: a data set's name or a file's path; ``first_frame`` and ``frames``, the part of it
  that is shown; ``fingerprint``, a checksum of that part; ``seconds``, how long it is;
- for a rebuilt motion also ``selector``, its ``settings``, ``count`` and ``seed``, the
  ``keyframes`` that it chose (frames of the part) and ``interpolator``, which is "slerp"; the
  root's path is that of the original;
- ``error``: the error per frame per joint in radians, 0 for the original.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import PurePath
from typing import Any

import numpy as np

from workbench.datasets import load
from workbench.errors import DataError, WorkbenchError
from workbench.interpolation.slerp import Slerp
from workbench.mocap.fingerprint import clip_fingerprint
from workbench.mocap.motion import Motion
from workbench.registry import Registry
from workbench.schemes import TemporalScheme
from workbench.selection import selectors as registered_selectors
from workbench.spaces import PoseSpace
from workbench.study.answers import Stimulus

#: What the motion that nothing was done to is called.
ORIGINAL = "original"

#: Keyframes a second of the practice's rebuilt motion, few enough to look wrong.
_PRACTICE_RATE = 1.5


@dataclass(frozen=True)
class Method:
    """A way to choose keyframes, as a study compares it.

    Attributes
    ----------
    name : str
        What tables call it; participants never see it.
    selector : str
        A registered selector.
    settings : mapping
        Its parameters: JSON.
    """

    name: str
    selector: str
    # A dict has no hash.
    settings: Mapping[str, Any] = field(default_factory=dict, hash=False)

    @classmethod
    def of(cls, method: str | Method) -> Method:
        """Take a selector's name for a method with its usual settings."""
        return method if isinstance(method, Method) else cls(method, method)


@dataclass(frozen=True, eq=False)
class Clip:
    """A part of a motion, and where it comes from.

    Attributes
    ----------
    clip : str
        A data set's name or a file's path.
    motion : Motion
        The part.
    first_frame : int
        Where it begins.
    name : str
        What tables call it.
    """

    clip: str
    motion: Motion
    first_frame: int = 0
    name: str = ""

    @classmethod
    def from_start(
        cls, clip: str, motion: Motion, seconds: float | None = None, name: str = ""
    ) -> Clip:
        """Take a motion, or its first seconds.

        Parameters
        ----------
        clip : str
            A data set's name or a file's path.
        motion : Motion
            What is there.
        seconds : float, optional
            How much of it to take; by default all.
        name : str
            What tables call it; by default as the data set or, without folders, the file.

        Raises
        ------
        WorkbenchError
            If that is less than three frames, between which nothing could be rebuilt.
        """
        frames = len(motion)
        if seconds is not None:
            frames = min(frames, round(seconds / motion.frame_time))
        if frames < 3:
            raise WorkbenchError(f"{clip}: got {frames} frames to show, want at least 3")
        path = PurePath(clip)
        usual = path.stem if path.is_absolute() else clip
        return cls(clip, motion[:frames], name=name or usual)

    @property
    def parameters(self) -> dict[str, Any]:
        """What makes the original again."""
        return {
            "clip": self.clip,
            "first_frame": self.first_frame,
            "frames": len(self.motion),
            "seconds": _seconds(self.motion),
            "fingerprint": clip_fingerprint(self.motion),
            "error": 0.0,
        }


def make_stimuli(
    clip: Clip,
    methods: Sequence[str | Method],
    *,
    count: int | None = None,
    ratio: float | None = None,
    test_case: str = "methods",
    random_state: int = 0,
    selectors: Registry = registered_selectors,
) -> tuple[Stimulus, ...]:
    """Rebuild a clip from equally many keyframes by each method.

    Parameters
    ----------
    clip : Clip
        The original, which is the first stimulus.
    methods : sequence of str or Method
        At least one; two must not have one name.
    count, ratio : int or float, at most one
        How many keyframes, or which share of the frames; neither for as many as the saliency
        method finds by its own rule, with the settings that the first method with that selector
        has, else with the usual ones.
    test_case : str
        The question that the stimuli belong to.
    random_state : int
        Seed of selectors that draw at random.
    selectors : Registry
        Where methods' selectors are looked up.

    Returns
    -------
    tuple of Stimulus

    Raises
    ------
    WorkbenchError
        If an argument is not valid, or a method gives another number of keyframes.

    Examples
    --------
    >>> jump = Clip.from_start("cmu/01_01-jump", load("cmu/01_01-jump"))
    >>> original, even = make_stimuli(jump, ["uniform"], count=4)
    >>> even.parameters["keyframes"]
    [0, 100, 199, 299]
    """
    chosen = [Method.of(method) for method in methods]
    names = [ORIGINAL, *(method.name for method in chosen)]
    if not chosen or len(set(names)) < len(names):
        raise WorkbenchError(
            f"methods: got {', '.join(names[1:]) or 'none'}, want one or more with names of their "
            f"own, none of them {ORIGINAL!r}"
        )
    space = PoseSpace(clip.motion)
    if count is None and ratio is None:
        count = _saliency_count(space, chosen, selectors)
    stimuli = [Stimulus(test_case, clip.name, ORIGINAL, clip.parameters)]
    for method in chosen:
        selector = selectors.create(method.selector, **method.settings)
        result = TemporalScheme("slerp", selector).run(
            space, count=count, ratio=ratio, random_state=random_state
        )
        keyframes = result.control_points.tolist()
        made = {
            **clip.parameters,
            "selector": method.selector,
            "settings": dict(method.settings),
            "count": len(keyframes),
            "seed": random_state,
            "interpolator": "slerp",
            "keyframes": keyframes,
            "error": float(result.error),
        }
        stimuli.append(Stimulus(test_case, clip.name, method.name, made))
    counts = {stimulus.parameters["count"] for stimulus in stimuli[1:]}
    if len(counts) > 1:
        told = ", ".join(f"{s.name} {s.parameters['count']}" for s in stimuli[1:])
        raise WorkbenchError(f"{clip.name}: got different numbers of keyframes: {told}")
    return tuple(stimuli)


def practice_stimuli(clip: Clip) -> tuple[Stimulus, ...]:
    """Make what participants practise on: a clip, and the same from far too few keyframes."""
    seconds = len(clip.motion) * clip.motion.frame_time
    count = max(2, min(len(clip.motion) - 1, round(_PRACTICE_RATE * seconds)))
    rough = Method("few keyframes", "uniform")
    return make_stimuli(clip, [rough], count=count, test_case="practice")


def stimulus_motion(stimulus: Stimulus) -> Motion:
    """Make a stimulus from its parameters.

    Parameters
    ----------
    stimulus : Stimulus
        As from :func:`make_stimuli`; its clip must be found.

    Returns
    -------
    Motion

    Raises
    ------
    DataError
        If the clip is not found, is not the one that the study was prepared with, or the
        parameters say something else than this module does.
    """
    made = stimulus.parameters
    where = f"stimulus {' / '.join(stimulus.key)}"
    try:
        wanted = made["clip"], made["first_frame"], made["frames"]
        motion = _part(*wanted, made["fingerprint"], made["seconds"])
        if "keyframes" not in made:
            return motion
        if made["interpolator"] != "slerp":
            raise DataError(f"{where}: interpolator: got {made['interpolator']!r}, want 'slerp'")
        keyframes = np.array(made["keyframes"], dtype=np.intp)
    except (KeyError, TypeError, ValueError) as error:
        raise DataError(f"{where}: parameters do not tell how it was made ({error})") from None
    rotations = np.array(Slerp().interpolate(motion, keyframes))
    rotations[keyframes] = motion.rotations[keyframes]
    return replace(motion, rotations=rotations)


@lru_cache(maxsize=4)
def _part(clip: str, first: int, frames: int, expected: str, seconds: float) -> Motion:
    motion = load(clip)
    if not isinstance(motion, Motion):
        raise DataError(f"{clip}: got a table, want a motion")
    # What is too short has another fingerprint as well.
    part = motion[first : first + frames]
    # The fingerprint does not tell how fast it plays.
    if clip_fingerprint(part) != expected or _seconds(part) != seconds:
        raise DataError(f"{clip}: is not the motion with which the study was prepared")
    return part


def _seconds(motion: Motion) -> float:
    return round(len(motion) * motion.frame_time, 3)


def _saliency_count(space: PoseSpace, methods: Sequence[Method], selectors: Registry) -> int:
    settings = next((m.settings for m in methods if m.selector == "saliency"), {})
    return len(selectors.create("saliency", **settings).select(space))
