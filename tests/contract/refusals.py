"""Data for the tables of what is refused, and how a row of them is checked."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pytest

from tests.selection.conftest import random_motion
from workbench.errors import WorkbenchError
from workbench.mocap import Motion
from workbench.spaces import PoseSpace, VectorSpace

#: What is wrong; a call with it, given the method in question; parts of the message, which
#: are the argument with what it got, and what is wanted.
Case = tuple[str, Callable[[Any], Any], str, str]


class Refused(NamedTuple):
    """One wrong input to one function."""

    of: str
    because: str
    call: Callable[[], Any]
    says: tuple[str, str]


def refused(of: str, subject: Any, cases: Iterable[Case]) -> Iterator[Refused]:
    """Apply a table of wrong inputs to one method."""
    for because, call, got, want in cases:
        yield Refused(of, because, partial(call, subject), (got, want))


def each_row(*tables: Iterable[Refused]) -> pytest.MarkDecorator:
    """Make a test of each row of some tables."""
    rows = [row for table in tables for row in table]
    return pytest.mark.parametrize("row", rows, ids=[f"{r.of}, {r.because}" for r in rows])


def check_refused(row: Refused) -> None:
    """Check that a wrong input is refused in one line that names what is wrong."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with pytest.raises(WorkbenchError) as caught:
            row.call()
    message = str(caught.value)
    assert "\n" not in message
    missing = [part for part in row.says if part.lower() not in message.lower()]
    assert not missing, message


NAN = float("nan")
INF = float("inf")

#: A table of 12 rows and 4 columns, a motion of 12 frames and 3 joints.
VALUES = np.random.default_rng(0).normal(size=(12, 4))
TABLE = VectorSpace(VALUES, name="table")
POSES: PoseSpace = random_motion(12, 1)
MOTION: Motion = POSES.motion
SKELETON = MOTION.skeleton
ROTATIONS = POSES.samples
DISTANCES = TABLE.distances
#: Positions of 12 samples on a map.
MAP = np.random.default_rng(1).random((12, 2))


def spoiled(array: Any, value: float = NAN) -> np.ndarray:
    """Give a copy of an array whose first number is another."""
    changed = np.array(array, dtype=np.float64)
    changed.flat[0] = value
    return changed
