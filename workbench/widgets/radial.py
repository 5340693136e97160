"""What the browser needs to back-project by itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection.poses import PoseBackProjector, SpatialKeyframes
from workbench.backprojection.rbf import RBF


@dataclass(frozen=True, eq=False)
class RadialFunction:
    """A sum of radial functions and a linear polynomial, as numbers.

    ``static/back_projection.js`` evaluates it, which agrees with Python to 1e-6.

    Attributes
    ----------
    kernel : str
        Its name, see :class:`~workbench.backprojection.rbf.RBF`.
    epsilon : float
        Its inverse width.
    centers : ndarray of shape (n_centers, n_dimensions)
        Places.
    coefficients : ndarray of shape (n_centers + 1 + n_dimensions, n_outputs)
        Weights of the centres, the constant, and a row for each dimension.
    """

    kernel: str
    epsilon: float
    centers: NDArray[np.float64]
    coefficients: NDArray[np.float64]


def radial_function(back_projector: Any) -> RadialFunction | None:
    """Take out of a fitted back-projector what the browser needs to do the same.

    Parameters
    ----------
    back_projector : back-projector
        Fitted.

    Returns
    -------
    RadialFunction or None
        None for a method that only Python can evaluate. A class derived from ``RBF`` is one:
        it may do more than its base.

    Examples
    --------
    >>> model = RBF().fit([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], np.eye(3))
    >>> radial_function(model).coefficients.shape
    (6, 3)
    """
    method = back_projector
    if type(method) in (PoseBackProjector, SpatialKeyframes):
        method = method.regressor_
    if type(method) is not RBF:
        return None
    return RadialFunction(
        method.kernel,
        method.epsilon_,
        method.centers_,
        np.vstack([method.weights_, method.polynomial_]),
    )
