"""What the keyframe inspector asks to be computed beside the kernel, and what it gets."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.shared.sources import Source
from workbench.mocap.foot_contacts import FootContacts
from workbench.mocap.motion import Motion
from workbench.mocap.motion_saliency import MotionSaliency
from workbench.registry import Registry
from workbench.selection import selectors


@dataclass(frozen=True)
class Selectors:
    """The kernel's selectors, those of its user among them.

    Attributes
    ----------
    registry : Registry
        By name.
    """

    registry: Registry = field(default_factory=lambda: selectors)


@dataclass(frozen=True)
class Method:
    """How keyframes are chosen, whatever their number.

    Attributes
    ----------
    selector : str
        A registered name.
    sigma : float
        σ of the saliency method, in frames.
    n_components : int or None
        k of the saliency method; None for as many as keep 90 % of the variance.
    contacts : bool
        Whether the saliency method handles moments at which a foot touches the ground.
    seed : int
        Of a selector that draws at random.
    """

    selector: str
    sigma: float
    n_components: int | None
    contacts: bool
    seed: int

    @property
    def for_counts(self) -> Method:
        """The same method without what does not matter once a number is given."""
        if self.selector == "saliency":
            return self
        return Method(self.selector, 0.0, None, contacts=False, seed=self.seed)


@dataclass(frozen=True)
class Extraction:
    """Keyframes of a clip and what they rebuild. Gives :class:`KeyframeResult`.

    Attributes
    ----------
    source : Source
        The clip.
    method : Method
        How they are chosen.
    count : int or None
        How many; None for as many as the saliency method chooses by its own rule.
    """

    source: Source
    method: Method
    count: int | None


@dataclass(frozen=True)
class CountErrors:
    """Errors of a method over numbers of keyframes. Gives :class:`ErrorCurve`.

    Attributes
    ----------
    source : Source
        The clip.
    method : Method
        How keyframes are chosen.
    """

    source: Source
    method: Method


@dataclass(frozen=True)
class LeastErrors:
    """The least errors that any keyframes can have. Gives :class:`ErrorCurve`.

    Attributes
    ----------
    source : Source
        The clip.
    """

    source: Source


Job = Source | Extraction | CountErrors | LeastErrors


@dataclass(frozen=True, eq=False)
class Clip:
    """A motion, and when its feet stand.

    Attributes
    ----------
    name : str
        What to call it.
    motion : Motion
        The clip.
    contacts : list of FootContacts
        One for each foot; empty where feet are not found.
    notes : tuple of str
        What could not be found.
    """

    name: str
    motion: Motion
    contacts: list[FootContacts]
    notes: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class KeyframeResult:
    """Keyframes of a clip and what they rebuild.

    Attributes
    ----------
    keyframes : ndarray of shape (n_keyframes,)
        Sorted.
    reconstruction : Motion
        The clip with its joint rotations interpolated between keyframes by slerp; the root's
        path is the clip's own.
    errors : ndarray of shape (n_frames,)
        D_q of each frame per joint, in radians.
    psnr : float
        Of joint angles, in dB (Halit 2010, Eq. 4.2); not a number where channels cannot
        express what was rebuilt.
    saliency : MotionSaliency
        Curves of the clip with their salient frames.
    foot_keyframes : ndarray of shape (n_foot_keyframes,)
        Those of the keyframes that the saliency method found on the feet's curves.
    filmstrip, thumbnail : str
        Pictures of the keyframes, as SVG.
    seconds : float
        Time of selection and interpolation.
    notes : tuple of str
        What was adjusted.
    """

    keyframes: NDArray[np.intp]
    reconstruction: Motion
    errors: NDArray[np.float64]
    psnr: float
    saliency: MotionSaliency
    foot_keyframes: NDArray[np.intp]
    filmstrip: str
    thumbnail: str
    seconds: float
    notes: tuple[str, ...]

    @property
    def error(self) -> float:
        """Mean of ``errors``: the error per frame per joint."""
        return float(self.errors.mean())


@dataclass(frozen=True, eq=False)
class ErrorCurve:
    """Error against the number of keyframes.

    Attributes
    ----------
    counts : ndarray of shape (n_counts,)
        Rising.
    errors : ndarray of shape (n_counts,)
        Errors per frame per joint.
    """

    counts: NDArray[np.intp]
    errors: NDArray[np.float64]
