"""Arguments of the projection comparison, checked once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.backprojection import back_projectors
from workbench.dashboards.comparison.controls import COLORS
from workbench.dashboards.comparison.panels import LETTERS, Panel
from workbench.errors import WorkbenchError
from workbench.projection import projectors
from workbench.validation import whole_number

_RATIOS = (0.01, 0.5)


@dataclass(frozen=True)
class Settings:
    """Everything but data and panels that decides what a comparison shows at first.

    See :func:`workbench.dashboards.compare_projections`.

    Raises
    ------
    WorkbenchError
        If one is not valid.
    """

    standardize: bool = False
    label: str | None = None
    ratio: float = 0.03
    random_state: int = 0
    back_projector: str | None = None
    color_by: str | None = None
    selection: ArrayLike = ()
    moved: Mapping[str, ArrayLike] = field(default_factory=dict)
    repeat: int = 1

    def __post_init__(self) -> None:
        if not _RATIOS[0] <= self.ratio <= _RATIOS[1]:
            raise WorkbenchError(f"ratio: got {self.ratio}, want {_RATIOS[0]} to {_RATIOS[1]}")
        whole_number("random_state", self.random_state, at_least=0)
        whole_number("repeat", self.repeat)
        if self.back_projector is not None and self.back_projector not in back_projectors:
            back_projectors.factory(self.back_projector)  # refuses it and says which there are
        if self.color_by is not None and self.color_by not in COLORS:
            raise WorkbenchError(
                f"color_by: got {self.color_by!r}, want one of {', '.join(COLORS)}"
            )
        checked_selection(self.selection)
        checked_moves(self.moved)


def checked_panels(panels: Sequence[str | Panel]) -> list[Panel]:
    """Refuse panels that cannot be shown.

    Raises
    ------
    WorkbenchError
        If there are none, more than six, or a projector is not known.
    """
    if isinstance(panels, (str, Panel)):
        panels = [panels]
    chosen = [panel if isinstance(panel, Panel) else Panel(panel) for panel in panels]
    if not 1 <= len(chosen) <= len(LETTERS):
        raise WorkbenchError(f"panels: got {len(chosen)}, want 1 to {len(LETTERS)}")
    for panel in chosen:
        if panel.projector not in projectors:
            projectors.factory(panel.projector)  # refuses it and says which there are
    return chosen


def checked_selection(selection: ArrayLike) -> NDArray[np.int64]:
    """Refuse what are no indices of samples.

    Raises
    ------
    WorkbenchError
        If they are not.
    """
    indices = np.asarray(selection)
    if indices.dtype == bool or (indices.size and indices.dtype.kind not in "iu"):
        raise WorkbenchError(
            f"selection: got values of type {indices.dtype}, want indices of samples"
        )
    if indices.size and indices.min() < 0:
        raise WorkbenchError(f"selection: got index {indices.min()}, want indices from 0")
    return np.unique(indices).astype(np.int64)


def checked_moves(moved: Mapping[str, ArrayLike]) -> dict[str, NDArray[np.float32]]:
    """Refuse what are no positions of control points, by the letters of panels.

    Raises
    ------
    WorkbenchError
        If they are not.
    """
    checked = {}
    for letter, positions in moved.items():
        places = np.asarray(positions, dtype=np.float32)
        if letter not in tuple(LETTERS) or places.ndim != 2 or places.shape[1:] != (2,):
            raise WorkbenchError(
                f"moved: got shape {places.shape} for {letter!r}, want positions of shape "
                f"(n_control_points, 2) for panels from {LETTERS[0]!r} to {LETTERS[-1]!r}"
            )
        if not np.isfinite(places).all():
            raise WorkbenchError(f"moved: got positions for {letter!r} that are not finite")
        checked[letter] = places
    return checked
