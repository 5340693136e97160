"""Back-projection of many points, and its derivatives."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from scipy.interpolate import RBFInterpolator
from scipy.spatial.transform import Rotation

from tests.benchmarks.measuring import Measurement, compare, time_of
from workbench.backprojection.ilamp import ILAMP
from workbench.backprojection.poses import SpatialKeyframes

N_POINTS, N_CENTERS, N_JOINTS = 100_000, 300, 31
MAX_MB = 1000


def measurements() -> Iterator[Measurement]:
    """Measure spatial keyframes of poses with 31 joints, and what is near them."""
    generator = np.random.default_rng(0)
    markers = generator.random((N_CENTERS, 2))
    poses = smooth_poses(markers)
    points = generator.random((N_POINTS, 2))
    model = SpatialKeyframes().fit(markers, poses)

    size = f"{N_CENTERS} centres, {N_JOINTS} joints"
    result_mb = 8e-6 * N_POINTS * 9 * N_JOINTS
    yield within_memory(
        time_of(
            f"spatial keyframes, {N_POINTS} points, {size}",
            lambda: model.predict(points),
            below=5.0,
            note=f"target also below 1 GB; the result is {result_mb:.0f} MB of it",
        )
    )

    fewer = points[:10_000]
    flat = poses.reshape(N_CENTERS, -1)
    interpolant = RBFInterpolator(markers, flat, kernel="linear", degree=1)
    yield compare(
        f"spatial keyframes, {len(fewer)} points, {size}",
        lambda: model.predict(fewer),
        "scipy's RBFInterpolator, batched numpy SVD",
        lambda: nearest_by_svd(interpolant(fewer).reshape(-1, N_JOINTS, 3, 3)),
        at_least=3,
        repeats=3,
    )
    yield compare(
        f"their Jacobian with the poses, {len(fewer)} points, {size}",
        lambda: model.predict_with_jacobian(fewer),
        "central differences of the same spatial keyframes",
        lambda: differences(model, fewer),
        at_least=1,
        repeats=3,
    )
    ilamp = ILAMP().fit(markers, flat)
    yield within_memory(
        time_of(
            f"iLAMP, {N_POINTS} points, {N_CENTERS} centres, {flat.shape[1]} outputs",
            lambda: ilamp.predict(points),
            below=5.0,
        )
    )


def within_memory(row: Measurement) -> Measurement:
    """Count a target as missed if memory is above the limit."""
    return replace(row, met=row.met and row.peak_mb < MAX_MB)


def smooth_poses(points: np.ndarray) -> np.ndarray:
    """Give poses that turn with the position: (n_points, n_joints, 3, 3)."""
    generator = np.random.default_rng(1)
    waves = np.sin(points @ generator.normal(size=(2, 3 * N_JOINTS)) * 3.0)
    return Rotation.from_rotvec(waves.reshape(-1, 3)).as_matrix().reshape(-1, N_JOINTS, 3, 3)


def nearest_by_svd(matrices: np.ndarray) -> np.ndarray:
    """Find nearest rotations by batched singular value decompositions."""
    u, _, v = np.linalg.svd(matrices)
    u[..., 2] *= np.sign(np.linalg.det(u @ v))[..., None]
    return u @ v


def differences(model: SpatialKeyframes, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Give poses and their Jacobian by central differences."""
    steps = 1e-6 * np.eye(2)
    slopes = [(model.predict(points + s) - model.predict(points - s)) / 2e-6 for s in steps]
    return model.predict(points), np.stack(slopes, axis=-1)
