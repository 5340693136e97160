"""Projectors: from samples to an embedding in two or three dimensions.

A projector is a scikit-learn transformer. One that has a ``metric`` parameter works on
distances, and gets the precomputed distances of the space where those are not Euclidean.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.errors import DataError, WorkbenchError
from workbench.projection.fitted import Projection
from workbench.registry import Registry
from workbench.spaces import Space, VectorSpace, check_space
from workbench.validation import as_embedding

projectors = Registry(
    "projector",
    {
        "pca": "workbench.projection.pca:PCA",
        "mds": "workbench.projection.mds:MDS",
        "isomap": "workbench.projection.isomap:Isomap",
        "lle": "workbench.projection.lle:LLE",
        "tsne": "workbench.projection.tsne:TSNE",
        "umap": "workbench.projection.umap:UMAP",
        "force": "workbench.projection.force:Force",
    },
    needs=("fit_transform",),
)
register_projector = projectors.register

control_point_projectors = Registry(
    "control-point projector",
    {
        "rbfp": "workbench.projection.rbfp:RBFP",
        "lamp": "workbench.projection.lamp:LAMP",
    },
    needs=("fit", "transform"),
)
register_control_point_projector = control_point_projectors.register


def project(
    space: Space,
    projector: Any,
    *,
    dimensions: int | None = None,
    random_state: int | None = None,
) -> NDArray[np.float64]:
    """Project the samples of a space and scale the result to the unit square.

    Parameters
    ----------
    space : Space
        The samples.
    projector : str or scikit-learn transformer
        A registered name or an object with ``fit_transform``; it is copied, not changed.
    dimensions : int, optional
        2 or 3; by default the projector's own number.
    random_state : int, optional
        Seed for a projector that has that parameter and leaves it open.

    Returns
    -------
    ndarray of shape (n_samples, n_components)
        See :func:`scale_to_unit_square`.

    Raises
    ------
    WorkbenchError
        If the name is unknown, all samples are equal or the result is no embedding.

    Examples
    --------
    >>> from workbench.spaces import VectorSpace
    >>> project(VectorSpace([[0.0, 0.0], [4.0, 0.0], [2.0, 1.0]]), "pca").max()
    np.float64(1.0)
    """
    return fit_projection(
        space, projector, dimensions=dimensions, random_state=random_state
    ).embedding


def fit_projection(
    space: Space,
    projector: Any,
    *,
    dimensions: int | None = None,
    random_state: int | None = None,
) -> Projection:
    """Project the samples of a space, keeping the method that did it.

    As :func:`project`, for those who go on with the fitted method: a projector's own inverse
    needs it.

    Parameters
    ----------
    space, projector, dimensions, random_state
        As for :func:`project`.

    Returns
    -------
    Projection

    Raises
    ------
    WorkbenchError
        As :func:`project`.
    """
    check_space(space)
    estimator = projectors.build(projector, random_state)
    name = projector if isinstance(projector, str) else type(projector).__name__
    if dimensions is not None:
        if dimensions not in (2, 3):
            raise WorkbenchError(f"dimensions: got {dimensions!r}, want 2 or 3")
        if "n_components" not in estimator.get_params():
            raise WorkbenchError(f"dimensions: projector {name!r} has no parameter n_components")
        estimator.set_params(n_components=dimensions)
    if not np.ptp(space.features, axis=0).any():
        raise DataError(f"{space.name or 'data'}: all samples are equal, want some that differ")
    samples = space.features
    if hasattr(estimator, "metric") and not isinstance(space, VectorSpace):
        estimator.set_params(metric="precomputed")
        samples = space.distances
    embedding = as_embedding(estimator.fit_transform(samples), f"embedding by {name!r}", len(space))
    scaled = scale_to_unit_square(embedding)
    return Projection(
        scaled, estimator, embedding.min(axis=0), float(np.ptp(embedding, axis=0).max())
    )


def scale_to_unit_square(embedding: NDArray[np.float64]) -> NDArray[np.float64]:
    """Shift and scale an embedding into the unit square, or cube, keeping its shape.

    All axes are scaled alike, by the larger extent, because distances in the plane mean
    something (Costa 2018 normalises before optimizing).

    Parameters
    ----------
    embedding : ndarray of shape (n_samples, n_components)
        Positions.

    Returns
    -------
    ndarray of shape (n_samples, n_components)
        Positions from 0; the larger extent is 1.

    Raises
    ------
    WorkbenchError
        If all points coincide, or they are no finite positions.
    """
    embedding = as_embedding(embedding)
    low = embedding.min(axis=0)
    extent = float(np.ptp(embedding, axis=0).max())
    if not extent > 0:
        raise WorkbenchError("embedding: got one place for all samples, want different places")
    # Twelve digits: places that differ by rounding noise only become the same place.
    return np.round((embedding - low) / extent, 12)
