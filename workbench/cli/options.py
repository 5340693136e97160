"""Options that several commands share."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from workbench.backprojection import back_projectors
from workbench.errors import WorkbenchError
from workbench.interpolation import interpolators
from workbench.optimization import DEFAULT_OPTIMIZER, optimizers
from workbench.projection import projectors
from workbench.registry import Registry
from workbench.selection import selectors

Data = Annotated[
    str, typer.Argument(help="Name of a data set (uci/iris, cmu/05_10) or path of a file.")
]
Clip = Annotated[str, typer.Argument(help="Name of a clip (cmu/05_10) or path of a file.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Count = Annotated[int | None, typer.Option(help="Number of control points.")]
Ratio = Annotated[float | None, typer.Option(help="Share of control points, between 0 and 1.")]
Seed = Annotated[int, typer.Option(min=0, max=2**32 - 1, help="Seed of everything random.")]
Out = Annotated[Path | None, typer.Option(help="File to write the result to.")]


def choices(registry: Registry, what: str) -> str:
    """Describe an option by the names that it takes."""
    return f"{what}: {', '.join(registry.names())}."


Projector = Annotated[str | None, typer.Option(help=choices(projectors, "Projector"))]
Selector = Annotated[str, typer.Option(help=choices(selectors, "Selector"))]
Interpolator = Annotated[str | None, typer.Option(help=choices(interpolators, "Interpolator"))]
BackProjector = Annotated[
    str | None,
    typer.Option(
        help=choices(back_projectors, "Back-projector")
        + " By default rbf for tables, spatial-keyframes for motions."
    ),
]
Optimize = Annotated[bool, typer.Option("--optimize", help=f"Optimize by {DEFAULT_OPTIMIZER}.")]
Optimizer = Annotated[str | None, typer.Option(help=choices(optimizers, "Optimizer"))]
Standardize = Annotated[
    bool,
    typer.Option("--standardize", help="Bring each column to zero mean and unit variance first."),
]
Label = Annotated[
    str | None, typer.Option(help="Column of a table file that holds the class of each row.")
]


def count_or_ratio(count: int | None, ratio: float | None) -> dict[str, Any]:
    """Settle how many control points are wanted: 3 % where nothing is said."""
    if count is not None and ratio is not None:
        raise WorkbenchError("--count and --ratio: got both, want one of them")
    if count is not None:
        return {"count": count}
    return {"ratio": 0.03 if ratio is None else ratio}


def chosen_optimizer(optimize: bool, optimizer: str | None) -> str | None:
    """Settle the optimizer's name, checked before anything is computed."""
    name = optimizer or (DEFAULT_OPTIMIZER if optimize else None)
    if name is not None:
        optimizers.factory(name)
    return name


def report(values: Mapping[str, Any], as_json: bool) -> None:
    """Print results as one JSON object, or as lines for people."""
    if as_json:
        typer.echo(json.dumps(values))
        return
    width = max(len(name) for name in values)
    for name, value in values.items():
        if isinstance(value, float):
            shown = f"{value:.4g}"
        elif isinstance(value, list):
            shown = f"{len(value)}: " + " ".join(map(str, value))
        else:
            shown = str(value)
        typer.echo(f"{name.replace('_', ' '):<{width}}  {shown}")
