"""What the explained optimizer asks to be computed beside the kernel, and what it gets."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.dashboards.shared.sources import Source
from workbench.mocap.body_nodes import BodyNodes
from workbench.optimization.landscape import PlaneGrid
from workbench.registry import fresh_copy
from workbench.widgets.radial import RadialFunction


@dataclass(frozen=True)
class Method:
    """A method by its name, with what makes it, which another process may not know.

    Attributes
    ----------
    name : str
        What to call it.
    make : object
        A factory without arguments, or an object to copy.
    token : int
        Tells methods of one name apart, because a copy in another process is another object.
    """

    name: str
    make: Any = field(compare=False, repr=False)
    token: int

    @classmethod
    def of(cls, name: str, make: Any) -> Method:
        """Name a factory or an object of this process."""
        return cls(name, make, id(make))

    def build(self) -> Any:
        """Make the method ready for one use."""
        if hasattr(self.make, "fit") or hasattr(self.make, "optimize"):
            return self.make() if isinstance(self.make, type) else fresh_copy(self.make)
        return self.make()


@dataclass(frozen=True)
class Setup:
    """Everything that decides what the plane shows.

    Attributes
    ----------
    source : Source
        The samples.
    projector, back_projector : Method
        The methods.
    ratio : float
        Share of control points.
    seed : int
        Seed of the choice of control points and of the methods.
    """

    source: Source
    projector: Method
    back_projector: Method
    ratio: float
    seed: int


@dataclass(frozen=True)
class Job:
    """A call of the session: everything that decides its answer.

    Attributes
    ----------
    method : {"prepare", "original", "landscape", "trace", "rebuild"}
        What to compute, see :class:`~workbench.dashboards.explanation.session.ExplainSession`.
    setup : Setup
        On which plane.
    rest : tuple
        What else that depends on.
    """

    method: str
    setup: Setup
    rest: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Area:
    """A square of the plane, and how finely it is mapped.

    Attributes
    ----------
    corners : tuple of float
        x and y of the lower left, x and y of the upper right.
    side : int
        Rows, and columns.
    """

    corners: tuple[float, float, float, float]
    side: int

    @classmethod
    def around(cls, places: ArrayLike, side: int, padding: float) -> Area:
        """Take the square around places, padded relative to their larger extent."""
        grid = PlaneGrid.around(places, 2, padding)
        (x0, x1), (y0, y1) = grid.x.tolist(), grid.y.tolist()
        return cls((x0, y0, x1, y1), side)

    @property
    def grid(self) -> PlaneGrid:
        """The places that are mapped."""
        x0, y0, x1, y1 = self.corners
        return PlaneGrid(np.linspace(x0, x1, self.side), np.linspace(y0, y1, self.side))


@dataclass(frozen=True, eq=False)
class Body:
    """A skeleton as the reconstruction draws it.

    Attributes
    ----------
    nodes : BodyNodes
        Joints and end sites.
    weights : ndarray of shape (n_joints,)
        Joint weights of the error.
    """

    nodes: BodyNodes
    weights: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Plane:
    """Samples in the plane, and how they are rebuilt.

    Attributes
    ----------
    name : str
        What to call the data.
    embedding : ndarray of shape (n_samples, 2)
        Where the projection put them.
    control_points : ndarray of shape (n_control_points,)
        Indices.
    errors : ndarray of shape (n_samples,)
        Their back-projection errors there.
    radial : RadialFunction or None
        The back-projector as the browser can evaluate it, if it can.
    columns : list of str
        Features of a table; empty for poses.
    low, high : ndarray of shape (n_columns,)
        Range of each column.
    body : Body or None
        The skeleton, for poses.
    mean_prediction_error : float
        Mean error of the poorest sensible reconstruction, the mean.
    notes : tuple of str
        How the data were treated, and what was adjusted.
    """

    name: str
    embedding: NDArray[np.float64]
    control_points: NDArray[np.intp]
    errors: NDArray[np.float64]
    radial: RadialFunction | None
    columns: list[str]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    body: Body | None
    mean_prediction_error: float
    notes: tuple[str, ...]

    @property
    def free(self) -> NDArray[np.intp]:
        """Indices of the samples that are no control points."""
        return np.setdiff1d(np.arange(len(self.embedding)), self.control_points)


@dataclass(frozen=True, eq=False)
class Original:
    """One sample as the reconstruction shows it.

    Attributes
    ----------
    numbers : ndarray of shape (n_numbers,)
        Its values, or nine matrix entries for each joint.
    offsets : ndarray of shape (n_nodes, 3)
        Nodes relative to their parents, for a frame; otherwise empty.
    root : ndarray of shape (3,)
        Where its root is, for a frame; otherwise empty.
    """

    numbers: NDArray[np.float64]
    offsets: NDArray[np.float64]
    root: NDArray[np.float64]
