"""How far maps around control points depart from the whole map: what lesson 3 draws."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from workbench.projection import control_point_projectors
from workbench.schemes import choose_control_points
from workbench.spaces import Space


def placed_around(
    space: Space, places: NDArray[np.float64], placing: str, control_points: NDArray[np.intp]
) -> NDArray[np.float64]:
    """Keep the control points of a map and place all other samples anew around them.

    Parameters
    ----------
    space : Space
        The samples.
    places : ndarray of shape (n_samples, 2)
        A map, of which only the control points' places are used.
    placing : str
        Name of a control-point projector, such as ``"rbfp"``.
    control_points : ndarray of shape (n_control_points,)
        Sorted indices.

    Returns
    -------
    ndarray of shape (n_samples, 2)
        In the scale of ``places``.
    """
    projector = control_point_projectors.build(placing)
    placed: NDArray[np.float64] = projector.fit(
        space, control_points, places[control_points]
    ).transform(space.samples)
    return placed


def departure(places: NDArray[np.float64], others: NDArray[np.float64]) -> float:
    """Measure how far two maps of the same samples differ: √(mean_i ‖y_i − y'_i‖²).

    Parameters
    ----------
    places, others : ndarray of shape (n_samples, 2)
        The maps.

    Returns
    -------
    float
        In the unit of the maps.

    Examples
    --------
    >>> departure(np.zeros((2, 2)), np.array([[3.0, 4.0], [0.0, 5.0]]))
    5.0
    """
    return float(np.sqrt(((places - others) ** 2).sum(axis=1).mean()))


def mean_departures(
    space: Space,
    places: NDArray[np.float64],
    placing: str,
    selector: str,
    counts: Sequence[int],
    *,
    repetitions: int = 5,
    random_state: int = 0,
) -> dict[int, float]:
    """Measure the departure from a map for several numbers of control points.

    Parameters
    ----------
    space : Space
        The samples.
    places : ndarray of shape (n_samples, 2)
        The whole map.
    placing : str
        Name of a control-point projector.
    selector : str
        Name of the selector of control points.
    counts : sequence of int
        Numbers of control points.
    repetitions : int
        How often control points are chosen, with a seed of its own each time.
    random_state : int
        The first of these seeds.

    Returns
    -------
    dict of int to float
        The mean departure by number of control points.
    """
    seeds = range(random_state, random_state + repetitions)
    return {
        count: float(
            np.mean(
                [
                    departure(
                        places,
                        placed_around(
                            space,
                            places,
                            placing,
                            choose_control_points(space, selector, count=count, random_state=seed),
                        ),
                    )
                    for seed in seeds
                ]
            )
        )
        for count in counts
    }
