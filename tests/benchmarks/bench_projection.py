"""Projection: control-point projectors on many samples, and the force-directed projector."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from tests.benchmarks.measuring import Measurement, compare, time_of
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotations_from_vectors
from workbench.mocap.skeleton import Skeleton
from workbench.projection import control_point_projectors, projectors
from workbench.spaces import PoseSpace, Space, VectorSpace

N_SAMPLES = 100_000
N_CONTROL_POINTS = 300
PEAK_MB = 1000


def measurements() -> Iterator[Measurement]:
    """Yield the rows of projection."""
    rng = np.random.default_rng(0)
    table = VectorSpace(rng.normal(size=(N_SAMPLES, 50)))
    for name, below in (("rbfp", 5.0), ("lamp", 15.0)):
        yield _placing(name, table, "vectors of 50 dimensions", below)
    yield _placing("rbfp", _poses(rng), "poses of 31 joints", 20.0)
    yield _force(rng)


def _placing(name: str, space: Space, what: str, below: float) -> Measurement:
    control = np.linspace(0, N_SAMPLES - 1, N_CONTROL_POINTS).astype(np.intp)
    positions = space.features[control, :2]
    projector = control_point_projectors.create(name)
    projector.fit(space, control, positions).transform(space.samples[:100])
    row = time_of(
        f"{name.upper()} of {N_SAMPLES} {what}, {N_CONTROL_POINTS} control points",
        lambda: projector.fit(space, control, positions).transform(space.samples),
        below,
        warm=False,
    )
    return replace(
        row,
        target=f"{row.target}, below {PEAK_MB} MB",
        met=row.met and row.peak_mb < PEAK_MB,
        note="the issue sets no target" if name == "lamp" else "",
    )


def _poses(rng: np.random.Generator) -> PoseSpace:
    """Make a chain of 31 joints that turn smoothly."""
    channels = (("Zrotation", "Yrotation", "Xrotation"),) * 31
    skeleton = Skeleton(
        names=tuple(f"joint{i}" for i in range(31)),
        parents=np.arange(-1, 30),
        offsets=np.ones((31, 3)),
        end_sites=(),
        channels=channels,
    )
    phases, speeds = rng.uniform(0, 6, (2, 31, 3))
    rotations = np.empty((N_SAMPLES, 31, 3, 3))
    for start in range(0, N_SAMPLES, 10_000):
        times = np.arange(start, start + 10_000)[:, None, None] / 300
        rotations[start : start + 10_000] = rotations_from_vectors(np.sin(speeds * times + phases))
    return PoseSpace(Motion(skeleton, rotations, np.zeros((N_SAMPLES, 3)), 1 / 30))


def _force(rng: np.random.Generator) -> Measurement:
    samples = rng.normal(size=(500, 10))
    distances = cdist(samples, samples)
    ours = projectors.create("force", metric="precomputed", random_state=0)
    return compare(
        "Force, 500 samples, 50 iterations",
        lambda: ours.fit_transform(distances),
        "the same scheme in numpy, vectorised over the moved points",
        lambda: _plain_force(distances),
        at_least=1.0,
        repeats=3,
        note="the issue sets no target; the loop around each sample is what numpy can vectorise",
    )


def _plain_force(distances: NDArray[np.float64]) -> NDArray[np.float64]:
    rng = np.random.default_rng(0)
    n = len(distances)
    points = rng.normal(size=(n, 2))
    wanted = distances / distances.max()
    for _ in range(50):
        for i in rng.permutation(n):
            away = points - points[i]
            length = np.maximum(np.sqrt(np.einsum("ij,ij->i", away, away)), 1e-12)
            points += ((wanted[i] - length) / (8.0 * length))[:, None] * away
    return points
