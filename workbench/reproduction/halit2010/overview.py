"""Figures 2.1, 3.1 and 3.2 of Halit 2010: keyframe extraction, shown on a clip."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pandas as pd
from scipy.linalg import qr
from sklearn.cluster import KMeans
from sklearn.decomposition import PCA

from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.figures.diagrams import Arrow, Box, Diagram
from workbench.figures.extraction import Families
from workbench.mocap.channels import motion_to_euler
from workbench.mocap.motion_saliency import MotionSaliency
from workbench.reproduction.clips import PictureClip, picture_clip
from workbench.selection.chord import chord_keyframes
from workbench.selection.saliency import Saliency
from workbench.spaces import PoseSpace

#: Keyframes that each family chooses.
N_KEYS = 8

#: The selector of both figures of chapter 3: as many curves as keep 90 % of the variance, but
#: at least 7, and the σ of calm motions.
SELECTOR = Saliency(sigma=10.0)

#: Multiples of σ at which saliency is measured (Eq. 3.7).
_SCALES = ("σ", "1.5σ", "2σ", "2.5σ")


def shown_motion(profile: str) -> tuple[PictureClip, PoseSpace]:
    """Choose the clip on which methods are shown: a walk."""
    clips = ("cmu/02_01", "cmu/07_01", "cmu/08_02", "cmu/01_03-walk")
    clip = picture_clip("a walk", profile, instead=clips)
    space = load_space(clip.name)
    if not isinstance(space, PoseSpace):
        raise WorkbenchError(f"{clip.name}: is no motion")
    return PictureClip(clip.name, clip.title), space


def families(space: PoseSpace, *, seed: int = 0) -> Families:
    """Let the three families choose keyframes of one clip.

    Parameters
    ----------
    space : PoseSpace
        The clip.
    seed : int
        Seed of the clusters.

    Returns
    -------
    Families
    """
    angles = motion_to_euler(space.motion, unwrap=True)
    # Where the body turns to is no motion of a joint.
    of_joints = angles[:, len(space.motion.skeleton.rotation_order(0)) :]
    curve = of_joints[:, int(np.argmax(of_joints.std(axis=0)))]
    # Point-to-chord distance in a picture of the curve: time as wide as the angle is high.
    frame_width = float(np.ptp(curve)) / len(curve)
    simplified = chord_keyframes(
        curve[:, None], N_KEYS, measure="distance", time_weight=frame_width
    )
    plane = PCA(2, random_state=seed).fit_transform(space.features)
    clusters = KMeans(N_KEYS, n_init=10, random_state=seed).fit(plane)
    apart = np.linalg.norm(plane[:, None] - clusters.cluster_centers_[None], axis=2)
    nearest = np.sort(apart.argmin(axis=0))
    _, _, pivots = qr(space.distances, mode="economic", pivoting=True)
    return Families(
        seconds=space.motion.frame_time * np.arange(len(space), dtype=np.float64),
        curve=curve,
        curve_keyframes=simplified,
        plane=plane,
        clusters=clusters.labels_.astype(np.intp),
        cluster_keyframes=nearest,
        distances=space.distances,
        matrix_keyframes=np.sort(pivots[:N_KEYS]).astype(np.intp),
    )


def listed_keyframes(found: Families) -> str:
    """Write the keyframes of the three families for a reader who does not see them."""
    parts = (
        ("(a)", found.curve_keyframes),
        ("(b)", found.cluster_keyframes),
        ("(c)", found.matrix_keyframes),
    )
    return "; ".join(f"{name} {', '.join(map(str, keys))}" for name, keys in parts)


@dataclass(frozen=True)
class Steps:
    """What each step of the saliency method makes of a clip.

    Attributes
    ----------
    n_frames, n_angles, n_curves, n_candidates, n_clusters : int
        Sizes: of the matrix of angles, after dimension reduction, frames that are salient on
        some curve, and clusters of them, which are as many as there are keyframes.
    variance : float
        Share that the curves keep.
    cluster_length : int
        Longest cluster allowed, in frames.
    sigma : float
        σ in frames.
    """

    n_frames: int
    n_angles: int
    n_curves: int
    variance: float
    n_candidates: int
    n_clusters: int
    cluster_length: int
    sigma: float

    @property
    def sentence(self) -> str:
        """Say all of it in one sentence."""
        return (
            f"{self.n_frames} frames of {self.n_angles} joint angles are reduced by PCA to "
            f"{self.n_curves} curves ({self.variance:.0%} of the variance), their saliency at σ = "
            f"{self.sigma:g} makes {self.n_candidates} frames candidates, and {self.n_clusters} "
            f"clusters of at most {self.cluster_length} frames give as many keyframes."
        )


def measured_steps(space: PoseSpace) -> Steps:
    """Run the saliency method on a clip and tell what each step made."""
    found: MotionSaliency = SELECTOR.measure(space.motion)
    return Steps(
        n_frames=len(space),
        n_angles=motion_to_euler(space.motion).shape[1],
        n_curves=found.curves.shape[1],
        variance=found.explained_variance_ratio,
        n_candidates=int(found.candidates.any(axis=1).sum()),
        n_clusters=len(found.clusters),
        cluster_length=found.cluster_length,
        sigma=SELECTOR.sigma,
    )


def outline(steps: Steps) -> Diagram:
    """Lay out the method's steps, and below each what it makes of a clip."""
    titles = (
        ("motion", "<b>motion</b><br>matrix of angles", "data"),
        ("reduce", f"dimension reduction<br><b>PCA, k = {steps.n_curves}</b>", "step"),
        ("saliency", f"motion saliency<br><b>σ = {steps.sigma:g}, 4 scales</b>", "step"),
        ("candidates", "candidates<br><b>above the mean</b>", "step"),
        ("cluster", f"clustering<br><b>≤ {steps.cluster_length} frames</b>", "step"),
        ("keyframes", f"<b>keyframes</b><br>{steps.n_clusters} poses", "kept"),
    )
    made = {
        "motion": f"{steps.n_frames} frames<br>× {steps.n_angles} angles",
        "reduce": f"{steps.n_curves} curves<br>{steps.variance:.0%} of variance",
        "saliency": f"{steps.n_frames} values<br>per curve",
        "candidates": f"{steps.n_candidates} frames<br>on some curve",
        "cluster": f"{steps.n_clusters} clusters",
    }
    boxes = [Box(key, text, kind, i, 0) for i, (key, text, kind) in enumerate(titles)]
    boxes += [
        Box(f"{key}-made", text, "data", i, 0.9) for i, (key, text) in enumerate(made.items())
    ]
    keys = [key for key, _, _ in titles]
    arrows = [Arrow(a, b) for a, b in pairwise(keys)]
    arrows += [Arrow(key, f"{key}-made", is_needed_only=True) for key in made]
    return Diagram(tuple(boxes), tuple(arrows))


def algorithm(steps: Steps) -> pd.DataFrame:
    """Give the steps of the algorithm with their readings and what they make of a clip."""
    rows = (
        (
            "1. Frame matrix",
            "joint angles, unwrapped, each column standardised",
            f"{steps.n_frames} × {steps.n_angles}",
        ),
        (
            "2. Dimension reduction",
            "PCA, at least 7 components and 90 % of the variance",
            f"{steps.n_curves} curves, {steps.variance:.0%} of the variance",
        ),
        (
            "3a. Multiscale saliency",
            f"|G(s) − G(2s)| of the curvature at {', '.join(_SCALES)}, σ = {steps.sigma:g}; "
            "each map normalised, then added",
            f"{steps.n_curves} saliency maps",
        ),
        (
            "3b. Salient frames",
            "above the mean of their own curve",
            f"{steps.n_candidates} candidates",
        ),
        (
            "4a. Clusters",
            f"runs of candidates, at most 4σ = {steps.cluster_length} frames long",
            f"{steps.n_clusters} clusters",
        ),
        (
            "4b. Keyframes",
            "the candidate nearest to the mean of its cluster, weighted by eigenvalues",
            f"{steps.n_clusters} keyframes, {steps.n_clusters / steps.n_frames:.1%} of the frames",
        ),
    )
    table = pd.DataFrame(
        [row[1:] for row in rows], columns=["how it is done", "result"], index=[r[0] for r in rows]
    )
    table.index.name = "step"
    return table
