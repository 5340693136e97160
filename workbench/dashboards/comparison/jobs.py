"""What the comparison asks to be computed beside the kernel, and what it gets."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection import back_projectors
from workbench.dashboards.comparison.panels import Panel
from workbench.dashboards.shared.sources import Source
from workbench.projection import projectors
from workbench.quality.shepard_diagram import ShepardDiagram
from workbench.quality.summary import EmbeddingQuality
from workbench.registry import Registry

#: Qualities of single samples, and whether low or high values are the better ones.
LOCAL_MEASURES = {
    "stress": "low",
    "trustworthiness": "high",
    "continuity": "high",
    "neighbourhood preservation": "high",
    "reconstruction error": "low",
}


@dataclass(frozen=True)
class Methods:
    """The kernel's methods, those of its user among them.

    Attributes
    ----------
    projectors, back_projectors : Registry
        By name.
    """

    projectors: Registry = field(default_factory=lambda: projectors)
    back_projectors: Registry = field(default_factory=lambda: back_projectors)


@dataclass(frozen=True)
class Run:
    """Everything that decides what a panel shows. Gives a :class:`PanelResult`.

    Attributes
    ----------
    source : Source
        The samples.
    panel : Panel
        What to make of them.
    ratio : float
        Share of control points.
    seed : int
        Seed of selector and projector.
    back_projector : str or None
        A registered name; None for the space's usual one.
    """

    source: Source
    panel: Panel
    ratio: float
    seed: int
    back_projector: str | None = None


@dataclass(frozen=True)
class Repetition:
    """A run of which the quality only is wanted. Gives :class:`Values`.

    Attributes
    ----------
    run : Run
        The run, with a seed of its own.
    """

    run: Run


@dataclass(frozen=True)
class Move:
    """A panel whose control points were moved by hand. Gives a :class:`PanelResult`.

    Attributes
    ----------
    run : Run
        What the panel showed before.
    positions : bytes
        Where its control points are now, as float32 of shape (n_control_points, 2).
    """

    run: Run
    positions: bytes

    @property
    def places(self) -> NDArray[np.float32]:
        """The positions: (n_control_points, 2)."""
        return np.frombuffer(self.positions, dtype="<f4").reshape(-1, 2)


@dataclass(frozen=True)
class Influence:
    """How control points count for the samples around. Gives an array for the browser.

    Attributes
    ----------
    source : Source
        The samples.
    control_points : tuple of int
        Sorted indices.
    """

    source: Source
    control_points: tuple[int, ...]


@dataclass(frozen=True)
class Description:
    """A projector's parameters. Gives them with their defaults.

    Attributes
    ----------
    projector : str
        A registered name.
    """

    projector: str


Job = Source | Run | Repetition | Move | Influence | Description


@dataclass(frozen=True, eq=False)
class Values:
    """Quality of a run.

    Attributes
    ----------
    quality : EmbeddingQuality
        Quality of the embedding.
    error : float
        Mean back-projection error.
    """

    quality: EmbeddingQuality
    error: float


@dataclass(frozen=True, eq=False)
class PanelResult:
    """What a panel shows.

    Attributes
    ----------
    embedding : ndarray of shape (n_samples, 2)
        Positions.
    projected : ndarray of shape (n_samples, 2) or None
        Positions before the optimization, None without one.
    before : Values or None
        Quality before the optimization, None without one.
    control_points : ndarray of shape (n_control_points,)
        Indices.
    errors : ndarray of shape (n_samples,)
        Back-projection error of each sample.
    error : float
        Their mean.
    quality : EmbeddingQuality
        Quality of the embedding.
    local : dict of str to ndarray of shape (n_samples,), float32
        Quality of each sample, by the names of ``LOCAL_MEASURES``; neighbourhood measures
        are at the same k as those of ``quality``.
    k, preservation : ndarray of shape (n_sizes,)
        Neighbourhood sizes, and the neighbourhood preservation at each.
    shepard : ShepardDiagram
        Pairs of samples by their distances.
    seconds : float
        Time of the run.
    notes : tuple of str
        What was adjusted, and how the optimizer ended.
    """

    embedding: NDArray[np.float64]
    projected: NDArray[np.float64] | None
    before: Values | None
    control_points: NDArray[np.intp]
    errors: NDArray[np.float64]
    error: float
    quality: EmbeddingQuality
    local: dict[str, NDArray[np.float32]]
    k: NDArray[np.intp]
    preservation: NDArray[np.float64]
    shepard: ShepardDiagram
    seconds: float
    notes: tuple[str, ...]
