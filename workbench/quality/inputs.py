"""Checks that the measures of quality share."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.validation import MIN_SAMPLES, as_embedding, as_numbers, finite


def as_points(embedding: ArrayLike) -> NDArray[np.float64]:
    """Check an embedding of enough samples to have a quality.

    Raises
    ------
    WorkbenchError
        If the shape is another, a value is not finite or there are fewer than 3 samples.
    """
    points = as_embedding(embedding)
    if len(points) < MIN_SAMPLES:
        raise WorkbenchError(f"embedding: got {len(points)} samples, want at least {MIN_SAMPLES}")
    return points


def as_vectors(features: ArrayLike, n: int) -> NDArray[np.float64]:
    """Check ``n`` vectors of finite numbers.

    Raises
    ------
    WorkbenchError
        If the shape is another or a value is not finite.
    """
    vectors = as_numbers("features", features)
    if vectors.ndim != 2 or len(vectors) != n:
        raise WorkbenchError(f"features: got shape {vectors.shape}, want ({n}, n_features)")
    return finite(vectors, "features")


def as_sizes(k: ArrayLike, n: int, largest: int | None = None) -> NDArray[np.intp]:
    """Check neighbourhood sizes; the measures by rank are defined up to (n − 1) // 2.

    Raises
    ------
    WorkbenchError
        If they are no whole numbers from 1 to ``largest``.
    """
    largest = (n - 1) // 2 if largest is None else largest
    sizes = np.atleast_1d(np.asarray(k))
    if sizes.ndim != 1 or not sizes.size or not np.issubdtype(sizes.dtype, np.integer):
        raise WorkbenchError(f"k: got {k!r}, want one or several whole numbers")
    if sizes.min() < 1 or sizes.max() > largest:
        raise WorkbenchError(
            f"k: got {sizes.min()}…{sizes.max()}, want sizes from 1 to {largest} for {n} samples"
        )
    return sizes.astype(np.intp)


def as_size(k: ArrayLike, n: int, largest: int | None = None) -> int:
    """Check one neighbourhood size.

    Raises
    ------
    WorkbenchError
        If it is not one whole number from 1 to ``largest``.
    """
    sizes = as_sizes(k, n, largest)
    if len(sizes) != 1:
        raise WorkbenchError(f"k: got {len(sizes)} sizes, want one")
    return int(sizes[0])
