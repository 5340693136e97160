"""What selectors share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.spaces import Space, check_space
from workbench.validation import control_point_count, control_point_indices


class Selector(ABC):
    """The base of selectors: how many samples, and which must be among them.

    A subclass implements ``_select``, which may rely on a count within 2 and n_samples − 1
    and on sorted, different fixed samples, no more than that.
    """

    def select(
        self,
        space: Space,
        count: int | None = None,
        *,
        ratio: float | None = None,
        fixed: Iterable[int] = (),
    ) -> NDArray[np.intp]:
        """Pick samples of a space as control points.

        Parameters
        ----------
        space : Space
            The samples.
        count, ratio : int or float, exactly one
            How many, or which share: max(3, floor(ratio · n_samples)).
        fixed : iterable of int
            Samples that must be among them, whatever the selector makes of the rest.

        Returns
        -------
        ndarray of shape (n_control_points,)
            Sorted indices.

        Raises
        ------
        WorkbenchError
            If the count, the ratio or a fixed sample is not valid, or more samples are
            fixed than are wanted.
        """
        check_space(space)
        wanted = control_point_count(len(space), count=count, ratio=ratio)
        return self._select(space, wanted, fixed_samples(fixed, len(space), wanted))

    @abstractmethod
    def _select(self, space: Space, count: int, fixed: NDArray[np.intp]) -> NDArray[np.intp]:
        """Pick ``count`` samples, the fixed ones among them; return sorted indices."""


def fixed_samples(fixed: Iterable[int], n_samples: int, count: int) -> NDArray[np.intp]:
    """Check the samples that must be selected.

    Parameters
    ----------
    fixed : iterable of int
        Their indices, in any order.
    n_samples : int
        Number of samples that they index.
    count : int
        How many samples are to be selected.

    Returns
    -------
    ndarray of shape (n_fixed,)
        Sorted.

    Raises
    ------
    WorkbenchError
        If they are no indices of samples, repeated, or more than ``count``.
    """
    try:
        listed = np.sort(np.asarray(list(fixed)))
    except (TypeError, ValueError):
        raise WorkbenchError(f"fixed: got {fixed!r}, want a list of sample indices") from None
    if not listed.size:
        return np.empty(0, dtype=np.intp)
    indices = control_point_indices(listed, n_samples, name="fixed")
    if len(indices) > count:
        raise WorkbenchError(
            f"fixed: got {len(indices)} samples that must stay, want at most count={count}"
        )
    return indices


def random_generator(random_state: Any) -> np.random.RandomState:
    """Make the generator that a selector draws from.

    Parameters
    ----------
    random_state : int, RandomState instance or None
        Seed.

    Returns
    -------
    RandomState

    Raises
    ------
    WorkbenchError
        If it is anything else.
    """
    # Imported here: names of methods are listed without loading what they need.
    from sklearn.utils import check_random_state

    try:
        return check_random_state(random_state)
    except (TypeError, ValueError):
        raise WorkbenchError(
            f"random_state: got {random_state!r}, want a whole number from 0 to 2**32 - 1, "
            "a RandomState instance or None"
        ) from None
