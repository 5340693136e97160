"""The traits of the scatter panels, as Python sees them."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.widgets import ScatterPanels


def panels() -> ScatterPanels:
    """Make two panels with three control points."""
    return ScatterPanels(panels=[{"title": "A"}, {"title": "B"}], control_points=[0, 4, 7])


def test_moved_positions_from_the_browser_get_their_shape() -> None:
    """The browser sends flat bytes; Python sees panels, control points, coordinates."""
    widget = panels()
    values = np.arange(12, dtype="<f4")
    widget.set_state({"moved": memoryview(values.tobytes())})
    np.testing.assert_array_equal(widget.moved, values.reshape(2, 3, 2))


def test_a_drop_that_comes_too_late_is_void() -> None:
    """What was moved in a panel that is no longer there moves nothing."""
    widget = panels()
    widget.set_state({"moved": memoryview(np.zeros(18, dtype="<f4").tobytes())})
    assert widget.moved.size == 0


def test_moved_positions_of_another_shape_are_refused() -> None:
    """The message names the shape that is wanted, and what was there stays."""
    widget = panels()
    widget.moved = np.ones((2, 3, 2))
    with pytest.raises(WorkbenchError, match=r"moved: got .*\(3, 2\), want \(2, 3, 2\)"):
        widget.moved = np.zeros((3, 2))
    assert widget.moved.shape == (2, 3, 2)
