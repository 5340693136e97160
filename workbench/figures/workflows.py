"""Workflows: what a scheme does, drawn from the scheme itself (Costa 2018, chapters 2 and 3)."""

from __future__ import annotations

from functools import singledispatch
from typing import Any

from workbench.errors import WorkbenchError
from workbench.figures.diagrams import Arrow, Box, Diagram
from workbench.projection.two_step import SEED_SHARE
from workbench.schemes import SpatialScheme, TemporalScheme

#: How methods are written; others appear under their own name.
_NAMES = {
    "uniform": "uniform sampling",
    "scs": "SCS",
    "pb": "PB",
    "rols": "ROLS",
    "chord": "chord distance",
    "saliency": "motion saliency",
    "pca": "PCA",
    "mds": "MDS",
    "lle": "LLE",
    "isomap": "Isomap",
    "tsne": "t-SNE",
    "umap": "UMAP",
    "force": "Force",
    "rbfp": "RBFP",
    "lamp": "LAMP",
    "rbf": "RBF",
    "ilamp": "iLAMP",
    "spatial-keyframes": "spatial keyframes",
    "linear": "linear",
    "hermite": "Hermite",
    "slerp": "slerp",
    "alg12": "gradient descent<br>(Alg. 12)",
}


@singledispatch
def workflow(scheme: Any) -> Diagram:
    """Lay out the steps of a scheme and what flows between them.

    Boxes in grey are data, in blue steps; green ones are all that is stored.

    Parameters
    ----------
    scheme : TemporalScheme or SpatialScheme
        The scheme; its methods name the steps, and steps that it lacks are not drawn.

    Returns
    -------
    Diagram
        For :func:`~workbench.figures.diagrams.draw_diagram`.

    Raises
    ------
    WorkbenchError
        If it is no scheme.

    Examples
    --------
    >>> diagram = workflow(SpatialScheme("pca", "scs", optimizer="alg12"))
    >>> diagram.sources("optimize")
    ['project', 'select']
    """
    raise WorkbenchError(
        f"scheme: got {type(scheme).__name__}, want a TemporalScheme or a SpatialScheme"
    )


@workflow.register
def _(scheme: TemporalScheme) -> Diagram:
    return Diagram(
        boxes=(
            Box("motion", "<b>motion</b><br>n poses, <i>F</i>", "data", 0, 0.5),
            Box("select", _step("keyframe selection", scheme.selector), "step", 1.1, 0.5),
            Box("keyframes", "<b>keyframes</b><br>m poses, <i>K</i>", "kept", 2.4, 0),
            Box("times", "<b>timestamps</b><br>m numbers, <i>T</i>", "kept", 2.4, 1),
            Box("interpolate", _step("interpolation", scheme.interpolator), "step", 3.7, 0.5),
            Box("rebuilt", "<b>reconstruction</b><br>n poses", "data", 4.8, 0.5),
        ),
        arrows=(
            Arrow("motion", "select"),
            Arrow("select", "keyframes"),
            Arrow("select", "times"),
            Arrow("keyframes", "interpolate"),
            Arrow("times", "interpolate"),
            Arrow("interpolate", "rebuilt"),
        ),
        groups=(("compact representation", ("keyframes", "times")),),
    )


@workflow.register
def _(scheme: SpatialScheme) -> Diagram:
    selector = scheme.selector or "uniform"
    boxes = [
        Box("motion", "<b>motion</b><br>n poses, <i>F</i>", "data", 0, 0.5),
        Box("select", _step("keyframe selection", selector), "step", 1.1, 0),
    ]
    arrows = [Arrow("motion", "select")]
    column = _add_projection(scheme, boxes, arrows)
    for key, title, method in (
        ("optimize", "optimization", scheme.optimizer),
        ("markers", "markers", scheme.markers),
    ):
        if method is not None:
            column += 1.1
            arrows.append(Arrow(boxes[-1].key, key))
            # Both need the poses at the markers, to measure how well positions rebuild others.
            arrows.append(Arrow("select", key, is_needed_only=True))
            boxes.append(Box(key, _step(title, method), "step", column, 1))
    kept = column + 1.2
    arrows += [Arrow("select", "keyframes"), Arrow(boxes[-1].key, "positions")]
    back = _step("back-projection", scheme.back_projector or "spatial-keyframes")
    boxes += [
        Box("keyframes", "<b>keyframes</b><br>m poses, <i>K</i>", "kept", kept, 0),
        Box("positions", "<b>positions</b><br>n points, <i>Q</i>", "kept", kept, 1),
        Box("back-project", back, "step", kept + 1.2, 0.5),
        Box("rebuilt", "<b>reconstruction</b><br>n poses", "data", kept + 2.3, 0.5),
    ]
    arrows += [
        Arrow("keyframes", "back-project"),
        Arrow("positions", "back-project"),
        Arrow("back-project", "rebuilt"),
    ]
    groups = (("compact representation", ("keyframes", "positions")),)
    return Diagram(tuple(boxes), tuple(arrows), groups)


def projection_workflow(scheme: SpatialScheme) -> Diagram:
    """Lay out how a scheme projects in two steps, up to the positions of all samples.

    Parameters
    ----------
    scheme : SpatialScheme
        A scheme with ``two_step``.

    Returns
    -------
    Diagram

    Raises
    ------
    WorkbenchError
        If the scheme projects in one step, where there is nothing to show.
    """
    if getattr(scheme, "two_step", None) is None:
        raise WorkbenchError("scheme: got one that projects in one step, want two_step='rbfp'")
    selector = scheme.selector or "random"
    boxes = [
        Box("motion", "<b>data</b><br>n samples", "data", 0, 0.5),
        Box("select", _step("control points", selector), "step", 1.1, 0),
    ]
    arrows = [Arrow("motion", "select")]
    column = _add_projection(scheme, boxes, arrows)
    boxes.append(Box("points", "<b>all points</b><br>n positions", "data", column + 1.1, 1))
    arrows.append(Arrow(boxes[-2].key, "points"))
    return Diagram(tuple(boxes), tuple(arrows))


def _add_projection(scheme: SpatialScheme, boxes: list[Box], arrows: list[Arrow]) -> float:
    """Add the steps of the projection below the selection; give the column of the last."""
    if scheme.two_step is None:
        boxes.append(Box("project", _step("projection", scheme.projector), "step", 1.1, 1))
        arrows.append(Arrow("motion", "project"))
        return 1.1
    share = f"{SEED_SHARE:.0%}".replace("%", " %")
    boxes += [
        Box("subset", f"<b>subset</b><br>{share}, with <i>K</i>", "data", 1.1, 1),
        Box("seed", _step("seed projection", scheme.projector), "step", 2.2, 1),
        Box("project", _step("all other points", scheme.two_step), "step", 3.4, 1),
    ]
    arrows += [
        Arrow("motion", "subset"),
        Arrow("select", "subset", "<i>K</i>"),
        Arrow("subset", "seed"),
        Arrow("seed", "project", "<i>L</i>"),
        Arrow("select", "project", is_needed_only=True),
        Arrow("motion", "project", "all samples", around=1.62),
    ]
    return 3.4


def _step(title: str, method: Any) -> str:
    """Write what a step does above the name of its method."""
    name = _NAMES.get(method, method) if isinstance(method, str) else type(method).__name__
    return f"{title}<br><b>{name}</b>"
