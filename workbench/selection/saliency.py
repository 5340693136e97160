"""Motion saliency as a selector of keyframes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.channels import motion_to_euler
from workbench.mocap.contacts import foot_heights
from workbench.mocap.kinematics import body_positions
from workbench.mocap.motion import Motion
from workbench.mocap.motion_saliency import MotionSaliency, motion_saliency
from workbench.selection.base import Selector, fixed_samples
from workbench.selection.uniform import Uniform
from workbench.spaces import PoseSpace, Space, check_space

CURVES = ("angles", "positions")


class Saliency(Selector):
    """Select the frames of a motion that stand out from those around them.

    The method of Halit 2010, chapter 3 (see
    :func:`~workbench.mocap.motion_saliency.motion_saliency`), which decides by its own rule
    how many there are: ``select(space)`` gives one keyframe for each cluster of salient
    frames, and the first and the last frame, without which the ends of the clip could not be
    rebuilt.

    Asked for a count, it ranks. Frames that are fixed come first, then both ends, then the
    keyframes of the clusters, the most salient first. Where there are too few clusters, they
    are made shorter until there are enough, and where even all candidates are too few, the
    others are spread evenly over the gaps.

    Parameters
    ----------
    sigma : float
        σ in frames. The thesis takes 7 to 10 for slow and at most 3 for fast motions, at 120
        frames a second.
    n_components : int, optional
        k, the number of curves, feet included; by default as many as keep the share
        ``variance``, but at least 7.
    curves : {"angles", "positions"}
        What the curves are made of: unwrapped Euler angles of all joints, the root's among
        them, or joint positions in the root's own frame, which tell neither the root's path
        nor its rotation.
    root_translation : bool
        Whether the root's path counts too.
    contacts : bool
        Whether moments at which a foot touches the ground are handled on their own
        (section 3.3).
    feet : sequence of str, optional
        Names of the feet's joints, which are then handled even without ``contacts``; by default
        they are found by name, else by height.
    foot_sigma : float
        σ of the feet's curves, in frames.
    up : {"x", "y", "z"}
        The axis that points up.
    variance, standardize, curvature, cluster_width
        As :func:`~workbench.mocap.motion_saliency.motion_saliency` has them.

    Examples
    --------
    >>> from workbench.datasets import load_space
    >>> keys = Saliency(sigma=10, n_components=7).select(load_space("cmu/01_01-jump"))
    >>> int(keys[0]), bool(len(keys) > 2)
    (0, True)
    """

    #: ``select`` may be called without a count.
    chooses_count = True

    def __init__(
        self,
        sigma: float = 10.0,
        n_components: int | None = None,
        *,
        curves: str = "angles",
        root_translation: bool = False,
        contacts: bool = False,
        feet: Sequence[str] | None = None,
        foot_sigma: float = 3.0,
        up: str = "y",
        variance: float = 0.9,
        standardize: bool = True,
        curvature: str = "slope",
        cluster_width: float = 4.0,
    ) -> None:
        self.sigma = sigma
        self.n_components = n_components
        self.curves = curves
        self.root_translation = root_translation
        self.contacts = contacts
        self.feet = feet
        self.foot_sigma = foot_sigma
        self.up = up
        self.variance = variance
        self.standardize = standardize
        self.curvature = curvature
        self.cluster_width = cluster_width

    def select(
        self,
        space: Space,
        count: int | None = None,
        *,
        ratio: float | None = None,
        fixed: Iterable[int] = (),
    ) -> NDArray[np.intp]:
        """Pick keyframes of a motion, by the method's own rule or as many as asked for.

        Parameters
        ----------
        space : PoseSpace
            The motion; tables have no time.
        count, ratio : int or float, at most one
            How many, or which share: max(3, floor(ratio · n_frames)); neither for the
            method's own rule.
        fixed : iterable of int
            Frames that must be among them.

        Returns
        -------
        ndarray of shape (n_keyframes,)
            Sorted indices.

        Raises
        ------
        WorkbenchError
            If the space is no motion, feet are wanted and not found, or an argument or a
            parameter is not valid.
        """
        if count is not None or ratio is not None:
            return super().select(space, count, ratio=ratio, fixed=fixed)
        last = len(self._motion(space)) - 1
        wanted = fixed_samples(fixed, len(space), len(space))
        keyframes = self.measure(self._motion(space)).keyframes
        return np.unique(np.concatenate([keyframes, wanted, [0, last]])).astype(np.intp)

    def measure(self, motion: Motion) -> MotionSaliency:
        """Compute the saliency of a motion, with all that leads to the keyframes.

        Parameters
        ----------
        motion : Motion
            The clip.

        Returns
        -------
        MotionSaliency
            Its keyframes are those of the clusters, without the ends that ``select`` adds.

        Raises
        ------
        WorkbenchError
            If feet are wanted and not found, or a parameter is not valid.
        """
        heights = None
        if self.contacts or self.feet is not None:
            heights = foot_heights(motion, self.feet, up=self.up)
        return motion_saliency(
            self._values(motion),
            self.sigma,
            self.n_components,
            variance=self.variance,
            standardize=self.standardize,
            curvature=self.curvature,
            cluster_width=self.cluster_width,
            foot_heights=heights,
            foot_sigma=self.foot_sigma,
        )

    def _select(self, space: Space, count: int, fixed: NDArray[np.intp]) -> NDArray[np.intp]:
        saliency = self.measure(self._motion(space))
        ends = np.setdiff1d([0, len(space) - 1], fixed)[: count - len(fixed)]
        chosen = np.union1d(fixed, ends)
        keyframes = _enough_keyframes(saliency, chosen, count - len(chosen))
        ranks = np.argsort(-saliency.frame_saliency[keyframes], kind="stable")
        chosen = np.union1d(chosen, keyframes[ranks[: count - len(chosen)]]).astype(np.intp)
        if len(chosen) < count:
            chosen = Uniform().select(space, count, fixed=chosen)
        return chosen

    def _values(self, motion: Motion) -> NDArray[np.float64]:
        if self.curves not in CURVES:
            raise WorkbenchError(f"curves: got {self.curves!r}, want one of {', '.join(CURVES)}")
        if self.curves == "angles":
            values = motion_to_euler(motion, unwrap=True)
        else:
            values = body_positions(motion).reshape(len(motion), -1)
        if self.root_translation:
            values = np.concatenate([values, motion.root_translation], axis=1)
        return values

    @staticmethod
    def _motion(space: Space) -> Motion:
        check_space(space)
        if not isinstance(space, PoseSpace):
            raise WorkbenchError(
                f"space: got the table {space.name!r}, want a motion: saliency follows curves "
                "in time (motion_saliency takes an array of them)"
            )
        return space.motion


def _enough_keyframes(
    saliency: MotionSaliency, chosen: NDArray[np.intp], wanted: int
) -> NDArray[np.intp]:
    """Find the keyframes, beside those chosen, of the longest clusters that give enough."""

    def keyframes(length: int) -> NDArray[np.intp]:
        return np.setdiff1d(saliency.keyframes_of_clusters(length), chosen)

    found = keyframes(saliency.cluster_length)
    if len(found) >= wanted:
        return found
    enough, too_few = 1, saliency.cluster_length
    while too_few - enough > 1:
        middle = (enough + too_few) // 2
        if len(keyframes(middle)) >= wanted:
            enough = middle
        else:
            too_few = middle
    return keyframes(enough)
