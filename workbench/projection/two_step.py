"""Projection in two steps: control points by one method, the rest around them by another."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.projection import control_point_projectors, project, scale_to_unit_square
from workbench.spaces import Space, check_space
from workbench.validation import control_point_indices

#: Share of the samples that the seed projector sees (Costa 2018, section 2.3).
SEED_SHARE = 0.5


def project_in_two_steps(
    space: Space,
    projector: Any,
    control_point_projector: Any,
    control_points: ArrayLike,
    *,
    seed_share: float = SEED_SHARE,
    dimensions: int | None = None,
    random_state: int | None = None,
) -> NDArray[np.float64]:
    """Project control points with a seed projector and place all other samples around them.

    The seed projector sees the control points among a random share of the samples, because
    methods that look at neighbourhoods can do nothing with a handful of them; only the
    control points' positions are kept (Costa 2018, section 2.3).

    Parameters
    ----------
    space : Space
        The samples.
    projector : str or scikit-learn transformer
        The seed projector.
    control_point_projector : str or control-point projector
        A registered name such as ``"rbfp"``, or an object.
    control_points : array-like of shape (n_control_points,)
        Sorted indices.
    seed_share : float
        Share of the samples that the seed projector sees, from 0 (control points alone) to
        1 (all).
    dimensions : int, optional
        2 or 3; by default the projector's own number.
    random_state : int, optional
        Seed of the share and of the projector.

    Returns
    -------
    ndarray of shape (n_samples, n_components)
        Scaled to the unit square.

    Raises
    ------
    WorkbenchError
        If an argument is not valid.
    """
    # Imported here: schemes are described, and results read, without loading scikit-learn.
    from sklearn.utils import check_random_state

    check_space(space)
    indices = control_point_indices(control_points, len(space))
    if not 0.0 <= seed_share <= 1.0:
        raise WorkbenchError(f"seed_share: got {seed_share}, want a number from 0 to 1")
    others = np.setdiff1d(np.arange(len(space)), indices)
    n_others = min(len(others), max(0, int(seed_share * len(space)) - len(indices)))
    drawn = check_random_state(random_state).choice(others, n_others, replace=False)
    seen = np.sort(np.concatenate([indices, drawn])).astype(np.intp)
    seeds = project(space.subset(seen), projector, dimensions=dimensions, random_state=random_state)
    positions = seeds[np.searchsorted(seen, indices)]
    placing = control_point_projectors.build(control_point_projector, random_state)
    embedding = placing.fit(space, indices, positions).transform(space.samples)
    embedding[indices] = positions
    return scale_to_unit_square(embedding)
