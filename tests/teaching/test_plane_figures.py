"""Figures of lesson 4: values and ways lie where they were measured."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.backprojection.rbf import RBF
from workbench.errors import WorkbenchError
from workbench.optimization.gradient_descent import GradientDescent
from workbench.optimization.landscape import PlaneGrid, error_landscape, rebuild_grid
from workbench.optimization.recording import trace_optimization
from workbench.spaces import VectorSpace
from workbench.teaching.plane_figures import landscape_panels, value_panels

PLANE = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]])
GRID = PlaneGrid.around(PLANE, side=5, padding=0.0)


def test_a_landscape_has_the_way_on_it() -> None:
    """Errors lie at their places, and the way begins and ends where the trace does."""
    start = PLANE.copy()
    start[3] = [0.2, 0.9]
    space, model = VectorSpace(PLANE), RBF().fit(start[:3], PLANE[:3])
    landscape = error_landscape(space, 3, GRID, rebuild_grid(model, GRID))
    trace = trace_optimization(GradientDescent(), space, model, start, [0, 1, 2], 3)
    figure = landscape_panels({"A": landscape, "B": landscape}, paths={"B": trace})
    heat = figure.data[0]
    lowest = np.unravel_index(np.argmin(heat.z), heat.z.shape)
    assert (heat.x[lowest[1]], heat.y[lowest[0]]) == (0.5, 0.5)
    way = figure.data[-1]
    assert way.xaxis == "x2"
    np.testing.assert_allclose([way.x[0], way.y[0]], [0.2, 0.9])
    np.testing.assert_allclose([way.x[-1], way.y[-1]], trace.positions[-1])


def test_panels_share_one_scale_of_colours() -> None:
    """The same colour means the same value in all panels; one bar explains them."""
    low, high = np.zeros(25), np.linspace(0, 3, 25)
    places = PLANE[:3]
    figure = value_panels(GRID, {"a": low, "b": high}, control_places=places, value_name="v")
    heats = [trace for trace in figure.data if trace.type == "heatmap"]
    assert [(heat.zmin, heat.zmax) for heat in heats] == [(0.0, 3.0)] * 2
    assert [heat.showscale for heat in heats] == [True, False]


def test_nothing_to_draw_is_refused() -> None:
    """An empty figure is a mistake."""
    with pytest.raises(WorkbenchError, match="panels: got none"):
        landscape_panels({})
