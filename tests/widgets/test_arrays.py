"""Arrays as traits."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.widgets import ScatterPanels

POINTS = np.array([[[0.0, 0.25], [1.0, 0.5]]])


def test_arrays_travel_as_bytes_and_come_back_equal() -> None:
    """What the browser gets are little-endian bytes, and bytes from it are the same array."""
    sender, receiver = ScatterPanels(points=POINTS, selection=[1]), ScatterPanels()
    state = sender.get_state(["points", "selection"])
    assert state["points"] == POINTS.astype("<f4").tobytes()
    # ipywidgets hands buffers over as memory views.
    receiver.set_state({name: memoryview(value) for name, value in state.items()})
    np.testing.assert_array_equal(receiver.points, POINTS.ravel())
    assert receiver.selection.tolist() == [1]


def test_a_selection_is_sorted_and_without_repetitions() -> None:
    """Any order of indices, a range or an array, gives sorted unique ones."""
    panels = ScatterPanels()
    panels.selection = [5, 1, 5, 3]
    assert panels.selection.tolist() == [1, 3, 5]
    panels.selection = range(3)
    assert panels.selection.tolist() == [0, 1, 2]


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ([0.5], "float64"),
        ([True, False], "bool"),
        ([-1, 2], "index -1"),
        (["a"], "indices"),
    ],
    ids=["fractions", "truth values", "negative", "text"],
)
def test_what_is_no_selection_is_refused_and_changes_nothing(wrong: list, words: str) -> None:
    """The message says what was wrong, and the selection stays."""
    panels = ScatterPanels(selection=[4])
    with pytest.raises(WorkbenchError, match=words):
        panels.selection = wrong
    assert panels.selection.tolist() == [4]


def test_points_that_are_no_numbers_are_refused() -> None:
    """The message names the trait."""
    with pytest.raises(WorkbenchError, match="points"):
        ScatterPanels(points=[["a"]])


def test_an_array_cannot_be_changed_in_place() -> None:
    """A change that the browser would not see is an error."""
    panels = ScatterPanels(selection=[1])
    with pytest.raises(ValueError, match="read-only"):
        panels.selection[0] = 2


def test_observers_hear_of_every_new_selection() -> None:
    """Selections of other lengths and an empty one are told, an equal one is not."""
    panels = ScatterPanels()
    heard: list[list[int]] = []
    panels.observe(lambda change: heard.append(change["new"].tolist()), "selection")
    for selection in ([1], [1, 2], [], [7]):
        panels.selection = selection
    assert heard == [[1], [1, 2], [], [7]]
