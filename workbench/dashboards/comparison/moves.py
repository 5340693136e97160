"""Control points that were moved by hand."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.comparison.jobs import Move, Run


class Moves:
    """Remember where control points of panels were moved to.

    A panel that shows something else has other control points, or other places for them, so
    moves belong to what a panel shows. Going back to that brings them back.
    """

    def __init__(self) -> None:
        self._positions: dict[tuple[str, Run], bytes] = {}
        self._expected: dict[str, NDArray[np.float32]] = {}

    def of(self, letter: str, run: Run | None) -> Move | None:
        """Give the move in a panel, if there is one."""
        if run is None or (letter, run) not in self._positions:
            return None
        return Move(run, self._positions[letter, run])

    def expect(self, moved: Mapping[str, NDArray[np.float32]]) -> None:
        """Set moves by the letters of panels, as soon as these show something."""
        self._expected = dict(moved)

    def settle(self, letter: str, run: Run, n_control: int) -> None:
        """Take the move that was expected in a panel, now that it shows something."""
        places = self._expected.pop(letter, None)
        if places is not None and len(places) == n_control:
            self._positions[letter, run] = places.astype("<f4").tobytes()

    def take(self, runs: Mapping[str, Run], moved: NDArray[np.float32]) -> None:
        """Take the moves that the browser sent: a row for each panel, NaN without a move."""
        for index, (letter, run) in enumerate(runs.items()):
            if index < len(moved) and np.isfinite(moved[index]).all():
                self._positions[letter, run] = moved[index].astype("<f4").tobytes()
            else:
                self._positions.pop((letter, run), None)

    def forget(self) -> None:
        """Put all control points back."""
        self._positions.clear()
        self._expected.clear()
