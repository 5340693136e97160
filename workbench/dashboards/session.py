"""What the comparison computes beside the kernel: load data, run schemes, measure."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.background import Report
from workbench.errors import (
    AdjustmentWarning,
    DataError,
    DegenerateDataWarning,
    WorkbenchError,
)
from workbench.quality.summary import EmbeddingQuality
from workbench.registry import Registry
from workbench.spaces import PoseSpace, Space, VectorSpace

#: The matrix of all distances takes 8 bytes for each pair: 1.2 GB at this size.
MAX_SAMPLES = 12_000

_LARGEST_K = 100
_SIZES = 24


@dataclass(frozen=True)
class Source:
    """Where samples come from.

    Attributes
    ----------
    name : str
        A data set's name, a file's path, or what to call ``space``.
    label : str or None
        The column of a user's table that holds the classes.
    standardize : bool
        Whether to standardise the columns of a table; motions stay as they are.
    space : Space or None
        Samples that are in memory already.
    token : int
        Tells samples in memory apart, because a copy in another process is another object.
    registered : bool
        Whether a loader that the user registered in the kernel gives the samples.
    version : tuple of int
        Tells a file of the user's apart from itself before it was edited, see
        :func:`file_version`; empty for samples from elsewhere.
    """

    name: str
    label: str | None = None
    standardize: bool = False
    space: Space | None = field(default=None, compare=False)
    token: int = 0
    registered: bool = False
    version: tuple[int, ...] = ()


@dataclass(frozen=True)
class Panel:
    """What one panel shows.

    Attributes
    ----------
    projector : str
        A registered name.
    optimized : bool
        Whether the embedding is optimized.
    """

    projector: str
    optimized: bool = False


@dataclass(frozen=True)
class Run:
    """Everything that decides what a panel shows.

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
    """

    source: Source
    panel: Panel
    ratio: float
    seed: int


@dataclass(frozen=True, eq=False)
class Body:
    """A motion as the pose view draws it.

    Attributes
    ----------
    positions : ndarray of shape (n_frames, n_nodes, 3), float32
        Joints, followed by end sites, in file units.
    parents : list of int
        Parent of each node, -1 for the root.
    names : list of str
        The joint that each node is, or hangs on.
    frame_time : float
        Seconds.
    """

    positions: NDArray[np.float32]
    parents: list[int]
    names: list[str]
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


@dataclass(frozen=True, eq=False)
class PanelResult:
    """What a panel shows.

    Attributes
    ----------
    embedding : ndarray of shape (n_samples, 2)
        Positions.
    control_points : ndarray of shape (n_control_points,)
        Indices.
    errors : ndarray of shape (n_samples,)
        Back-projection error of each sample.
    error : float
        Their mean.
    quality : EmbeddingQuality
        Quality of the embedding.
    k, preservation : ndarray of shape (n_sizes,)
        Neighbourhood sizes, and the neighbourhood preservation at each.
    seconds : float
        Time of the run.
    notes : tuple of str
        What was adjusted, and how the optimizer ended.
    """

    embedding: NDArray[np.float64]
    control_points: NDArray[np.intp]
    errors: NDArray[np.float64]
    error: float
    quality: EmbeddingQuality
    k: NDArray[np.intp]
    preservation: NDArray[np.float64]
    seconds: float
    notes: tuple[str, ...]


class Session:
    """Load samples and run schemes, remembering distances and projections."""

    def __init__(self) -> None:
        self._source: Source | None = None
        self._space: Space | None = None
        self._notes: tuple[str, ...] = ()
        self._projections: dict[Any, tuple[NDArray[np.float64], tuple[str, ...]]] = {}

    def load(self, source: Source, *, report: Report) -> Summary:
        """Load samples and describe them."""
        space = self._load(source, report)
        report("preparing the views", None)
        return summarize(space, self._notes)

    def run(self, run: Run, projectors: Registry, *, report: Report) -> PanelResult:
        """Compute what a panel shows.

        Parameters
        ----------
        run : Run
            The samples, the method and its settings.
        projectors : Registry
            The kernel's projectors, those of its user among them.
        report : callable
            Gets the progress.
        """
        from workbench.optimization import VISUALIZATION_OPTIMIZER
        from workbench.quality.neighborhoods import neighborhood_quality
        from workbench.schemes import SpatialScheme

        space = self._load(run.source, report)
        report("measuring distances", 0.05)
        distances = space.distances
        report("projecting", 0.2)
        projected, notes = self._project(run, projectors, space)

        def follow(iteration: int, error: float, embedding: NDArray[np.float64]) -> None:  # noqa: ARG001 - the optimizer's signature
            # How many are to come is not known; most samples rest within twenty.
            report(f"optimizing, iteration {iteration}", 0.9 - 0.4 * 0.9**iteration)

        report("back-projecting", 0.5)
        scheme = SpatialScheme(
            run.panel.projector,
            optimizer=VISUALIZATION_OPTIMIZER if run.panel.optimized else None,
        )
        with _said_by_warnings() as said:
            result = scheme.run(
                space,
                ratio=run.ratio,
                random_state=run.seed,
                projected=projected,
                callback=follow,
            )
        report("measuring quality", 0.9)
        curve = neighborhood_quality(distances, result.embedding, curve_sizes(len(space)))
        ended = result.optimization
        if ended is not None:
            said.append(f"optimized in {ended.iterations} iterations: {ended.reason}")
        return PanelResult(
            embedding=result.embedding,
            control_points=result.control_points,
            errors=result.errors,
            error=result.error,
            quality=result.quality,
            k=curve.k,
            preservation=curve.preservation,
            seconds=result.timings.total,
            notes=(*notes, *said),
        )

    def _load(self, source: Source, report: Report) -> Space:
        if self._space is None or source != self._source:
            report(f"loading {source.name}", None)
            space, notes = load_source(source)
            self._source, self._space, self._notes = source, space, notes
            self._projections.clear()
        return self._space

    def _project(
        self, run: Run, projectors: Registry, space: Space
    ) -> tuple[NDArray[np.float64], tuple[str, ...]]:
        from workbench.projection import project

        factory: Callable[[], Any] = projectors.factory(run.panel.projector)
        # The factory is part of the key because a user may register another by that name.
        key = (factory, run.seed)
        if key not in self._projections:
            with _said_by_warnings() as said:
                embedding = project(space, factory(), random_state=run.seed)
            if embedding.shape[1] != 2:
                raise WorkbenchError(
                    f"projector {run.panel.projector!r}: got {embedding.shape[1]} dimensions, "
                    "want 2 to show them in a panel"
                )
            self._projections[key] = embedding, tuple(said)
        return self._projections[key]


def load_source(source: Source) -> tuple[Space, tuple[str, ...]]:
    """Load samples and how they were treated.

    Raises
    ------
    DataError
        If they cannot be loaded, there are too many of them, or their file was edited since it
        was opened: panels would show different samples side by side.
    """
    from workbench.datasets import Table, load

    notes: tuple[str, ...] = ()
    space = source.space
    if source.version and source.version != file_version(source.name):
        raise DataError(f"{source.name}: the file has changed; compute again to read it anew")
    if space is None:
        data = load(source.name, label=source.label)
        if isinstance(data, Table):
            space, notes = data.space(standardize=source.standardize), data.notes
        else:
            space = PoseSpace(data)
    if len(space) > MAX_SAMPLES:
        raise DataError(
            f"{source.name}: got {len(space)} samples, want at most {MAX_SAMPLES}: the distances "
            "between all of them must fit into memory"
        )
    return space, notes


def file_version(path: str) -> tuple[int, int]:
    """Give the time of a file's last change, in nanoseconds, and its size; zeros if missing."""
    try:
        status = os.stat(path)
    except OSError:
        return 0, 0
    return status.st_mtime_ns, status.st_size


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


def curve_sizes(n_samples: int) -> NDArray[np.intp]:
    """Choose neighbourhood sizes for a curve, closer together where they are small."""
    largest = max(1, min(_LARGEST_K, (n_samples - 1) // 2))
    return np.unique(np.geomspace(1, largest, _SIZES).round().astype(np.intp))


def _body(space: PoseSpace) -> Body:
    from workbench.mocap.kinematics import end_site_positions

    skeleton = space.motion.skeleton
    ends = [site.joint for site in skeleton.end_sites]
    nodes = np.concatenate([space.positions, end_site_positions(space.motion)], axis=1)
    return Body(
        positions=nodes.astype(np.float32),
        parents=[*skeleton.parents.tolist(), *ends],
        names=[*skeleton.names, *(skeleton.names[joint] for joint in ends)],
        frame_time=space.motion.frame_time,
    )


@contextmanager
def _said_by_warnings() -> Iterator[list[str]]:
    """Collect what the package tells about adjusted parameters and degenerate data."""
    said: list[str] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield said
    ours = (AdjustmentWarning, DegenerateDataWarning)
    said.extend(dict.fromkeys(str(w.message) for w in caught if issubclass(w.category, ours)))
