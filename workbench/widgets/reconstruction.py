"""A sample beside what is rebuilt of it at a place of the plane."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.arrays import ArrayTrait
from workbench.widgets.module import es_module, style_sheet


class ReconstructionView(anywidget.AnyWidget):
    """Show a sample beside its reconstruction: values of a table's row, or a pose.

    Radial functions are evaluated in the browser, wherever the mouse is; of other
    back-projectors it shows what Python sends.

    Attributes
    ----------
    original : array of shape (n_numbers,), float64
        The sample: its values, or nine matrix entries for each joint.
    columns : list of str
        Names of the values; empty for poses.
    low, high : array of shape (n_columns,), float64
        Range of each column.
    parents : list of int
        Of joints and end sites, -1 for the root; empty for tables.
    sides : list of {"left", "right", "middle"}
        Which side of the body each node is on.
    head : int
        The far end of the bone around which a head is drawn; -1 for none.
    offsets : array of shape (n_nodes, 3), float64
        Each node relative to its parent, in file units.
    root : array of shape (3,), float64
        World position of the root.
    weights : array of shape (n_joints,), float64
        Joint weights of the error.
    kernel : str
        Radial function's kernel; empty if only Python can back-project.
    epsilon : float
        Its inverse width.
    centers : array of shape (n_centers, 2), float64
        Its places.
    coefficients : array of shape (n_centers + 3, n_numbers), float64
        Weights of the centres, the constant, and two rows for the plane's axes.
    rebuilt : array of shape (n_numbers,), float64
        What Python rebuilt at ``rebuilt_at``; empty for none.
    rebuilt_at : list of float
        That place.
    note : str
        A sentence about the back-projector.
    channel : str
        Views with the same channel follow the place in the plane.
    """

    _esm = es_module(
        "places",
        "back_projection",
        "kinematics",
        "stick_figure",
        "orbit",
        "value_rows",
        "reconstruction",
    )
    _css = style_sheet()

    original = ArrayTrait("<f8")
    columns = traitlets.List(traitlets.Unicode()).tag(sync=True)
    low = ArrayTrait("<f8")
    high = ArrayTrait("<f8")
    parents = traitlets.List(traitlets.Int()).tag(sync=True)
    sides = traitlets.List(traitlets.Unicode()).tag(sync=True)
    head = traitlets.Int(-1).tag(sync=True)
    offsets = ArrayTrait("<f8")
    root = ArrayTrait("<f8")
    weights = ArrayTrait("<f8")
    kernel = traitlets.Unicode("").tag(sync=True)
    epsilon = traitlets.Float(1.0).tag(sync=True)
    centers = ArrayTrait("<f8")
    coefficients = ArrayTrait("<f8")
    rebuilt = ArrayTrait("<f8")
    rebuilt_at = traitlets.List(traitlets.Float()).tag(sync=True)
    note = traitlets.Unicode("").tag(sync=True)
    channel = traitlets.Unicode("").tag(sync=True)
