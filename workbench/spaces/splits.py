"""Samples split into those that methods are fitted to and those that judge them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.spaces.base import Space
from workbench.spaces.poses import PoseSpace
from workbench.spaces.vectors import VectorSpace
from workbench.validation import MIN_SAMPLES

#: Ways to split the samples; blocks are for motions, whose samples have an order.
SPLITS = ("random", "blocks")
#: Runs of frames, equally long, that a motion is cut into.
N_BLOCKS = 10


def split(
    space: Space, kind: str, share: float, rng: np.random.Generator
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Split samples into training and test samples.

    Frames that follow each other are nearly equal. Of frames drawn one by one the neighbours
    are in the training set, so they tell about frames between known ones; with blocks, whole
    stretches of the motion are new.

    Parameters
    ----------
    space : Space
        The samples.
    kind : {"random", "blocks"}
        Draw samples, or tenths of a motion.
    share : float
        Share of the samples, or blocks, to train with.
    rng : numpy.random.Generator
        Draws them.

    Returns
    -------
    training, test : ndarray of shape (n_training,) and (n_test,)
        Sorted indices.

    Raises
    ------
    WorkbenchError
        If a table is to be split into blocks, or there are too few samples.

    Examples
    --------
    >>> table = VectorSpace(np.eye(10))
    >>> training, test = split(table, "random", 0.7, np.random.default_rng(0))
    >>> len(training), len(test)
    (7, 3)
    """
    n = len(space)
    if kind == "blocks" and not isinstance(space, PoseSpace):
        raise WorkbenchError(
            f"split: got 'blocks' for the table {space.name!r}, want 'random': its rows have no "
            "order in time"
        )
    n_parts = min(N_BLOCKS, n) if kind == "blocks" else n
    part = np.arange(n) * n_parts // n
    trained = rng.permutation(n_parts)[: round(share * n_parts)]
    in_training = np.isin(part, trained)
    training, test = np.flatnonzero(in_training), np.flatnonzero(~in_training)
    if min(len(training), len(test)) < MIN_SAMPLES:
        raise WorkbenchError(
            f"{space.name or 'data'}: got {n} samples, want enough for {MIN_SAMPLES} to train "
            f"with and {MIN_SAMPLES} to test with"
        )
    return training, test


def standardized_by(space: Space, rows: NDArray[np.intp]) -> VectorSpace:
    """Bring columns of a table to zero mean and unit variance of some of its rows.

    Parameters
    ----------
    space : VectorSpace
        The table.
    rows : ndarray of shape (n_rows,)
        The rows whose means and variances are taken.

    Returns
    -------
    VectorSpace
        With all rows; columns that are constant in the given ones are only shifted.

    Raises
    ------
    WorkbenchError
        If the space is a motion.
    """
    if not isinstance(space, VectorSpace):
        raise WorkbenchError(f"standardized: got the motion {space.name!r}, want a table")
    chosen = space.samples[rows]
    varies = np.ptp(chosen, axis=0) > 0
    spread = np.where(varies, chosen.std(axis=0), 1.0)
    values = (space.samples - chosen.mean(axis=0)) / spread
    return VectorSpace(values, columns=space.columns, labels=space.labels, name=space.name)
