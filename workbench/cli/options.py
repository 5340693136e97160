"""Options that several commands share."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from workbench.backprojection import back_projectors
from workbench.errors import WorkbenchError
from workbench.interpolation import interpolators
from workbench.optimization import COMPACTION_OPTIMIZER, VISUALIZATION_OPTIMIZER, optimizers
from workbench.optimization.markers import marker_searches
from workbench.projection import control_point_projectors, projectors
from workbench.registry import Registry
from workbench.selection import selectors

#: Share of control points where nothing is said (Costa 2018, chapter 5).
DEFAULT_RATIO = 0.03

#: What ``--two-step`` takes.
DEFAULT_CONTROL_POINT_PROJECTOR = "rbfp"

Data = Annotated[
    str, typer.Argument(help="Name of a data set (uci/iris, cmu/05_10) or path of a file.")
]
Clip = Annotated[str, typer.Argument(help="Name of a clip (cmu/05_10) or path of a file.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Count = Annotated[int | None, typer.Option(help="Number of control points.")]
Ratio = Annotated[
    float | None,
    typer.Option(
        help="Share of control points, between 0 and 1.  [default: 0.03; saliency has a rule of "
        "its own]"
    ),
]
Seed = Annotated[int, typer.Option(min=0, max=2**32 - 1, help="Seed of everything random.")]
Out = Annotated[Path | None, typer.Option(help="File to write the result to.")]
Thumbnail = Annotated[
    Path | None,
    typer.Option(help="File for a picture of the keyframes, ending in .svg or .png."),
]
Keep = Annotated[
    list[int] | None,
    typer.Option(
        metavar="FRAME",
        help="Frame, or row, counted from 0, that must be among those selected; may be repeated.",
    ),
]


def choices(registry: Registry, what: str) -> str:
    """Describe an option by the names that it takes."""
    return f"{what}: {', '.join(registry.names())}."


Projector = Annotated[str | None, typer.Option(help=choices(projectors, "Projector"))]
Selector = Annotated[str, typer.Option(help=choices(selectors, "Selector"))]
ControlPoints = Annotated[
    str | None,
    typer.Option(
        help=choices(selectors, "Selector of control points")
        + " By default random for tables, uniform for motions."
    ),
]
Interpolator = Annotated[str | None, typer.Option(help=choices(interpolators, "Interpolator"))]
BackProjector = Annotated[
    str | None,
    typer.Option(
        help=choices(back_projectors, "Back-projector")
        + " By default rbf for tables, spatial-keyframes for motions."
    ),
]
TwoStep = Annotated[
    bool,
    typer.Option(
        "--two-step",
        help="Place control points by the projector, and the rest around them by "
        f"{DEFAULT_CONTROL_POINT_PROJECTOR}.",
    ),
]
ControlPointProjector = Annotated[
    str | None,
    typer.Option(help=choices(control_point_projectors, "The same, the rest by")),
]
Dimensions = Annotated[
    int | None, typer.Option(metavar="2|3", help="Dimensions of the embedding.  [default: 2]")
]
Optimize = Annotated[
    bool,
    typer.Option(
        "--optimize",
        help=f"Optimize by the usual one: {COMPACTION_OPTIMIZER} to compact (lowest error), "
        f"{VISUALIZATION_OPTIMIZER} to look at (samples stay close).",
    ),
]
Optimizer = Annotated[str | None, typer.Option(help=choices(optimizers, "Optimizer"))]
Markers = Annotated[
    str | None,
    typer.Option(
        help=choices(marker_searches, "Let control points move too, or others take their place")
    ),
]
Standardize = Annotated[
    bool,
    typer.Option("--standardize", help="Bring each column to zero mean and unit variance first."),
]
Label = Annotated[
    str | None, typer.Option(help="Column of a table file that holds the class of each row.")
]


def check_name(registry: Registry, name: str | None) -> None:
    """Refuse an unknown name, without importing the methods of known ones."""
    if name is not None and name not in registry:
        registry.factory(name)  # which says what there is


def check_amount(count: int | None, ratio: float | None, keep: Sequence[int] | None) -> None:
    """Refuse what is wrong with a number of control points whatever the data are."""
    if count is not None and ratio is not None:
        raise WorkbenchError("--count and --ratio: got both, want one of them")
    if count is not None and count < 2:
        raise WorkbenchError(f"--count: got {count}, want at least 2")
    if ratio is not None and not 0 < ratio < 1:
        raise WorkbenchError(f"--ratio: got {ratio}, want a number between 0 and 1")
    frames = list(keep or [])
    if len(set(frames)) < len(frames) or min(frames, default=0) < 0:
        raise WorkbenchError(
            f"--keep: got {', '.join(map(str, frames))}, want numbers from 0, each once"
        )


def amount(
    selector: str | None,
    count: int | None,
    ratio: float | None,
    keep: Sequence[int] | None,
    n_samples: int,
) -> dict[str, Any]:
    """Settle how many control points are wanted, and which must be among them.

    Where nothing is said it is 3 %, or what a selector with a rule of its own gives.
    """
    from workbench.validation import control_point_count, control_point_indices

    wanted: dict[str, Any] = {"count": count} if count is not None else {"ratio": ratio}
    if count is None and ratio is None:
        own_rule = selector is not None and getattr(
            selectors.factory(selector), "chooses_count", False
        )
        wanted = {} if own_rule else {"ratio": DEFAULT_RATIO}
    if keep:
        control_point_indices(sorted(keep), n_samples, name="--keep")
        most = control_point_count(n_samples, **wanted) if wanted else n_samples
        if len(keep) > most:
            raise WorkbenchError(
                f"--keep: got {len(keep)} that must stay, want at most the {most} to be selected"
            )
        wanted["fixed"] = list(keep)
    return wanted


def chosen_optimizer(optimize: bool, optimizer: str | None, usual: str) -> str | None:
    """Settle the optimizer's name, checked before anything is computed."""
    check_name(optimizers, optimizer)
    return optimizer or (usual if optimize else None)


def chosen_second_step(two_step: bool, control_point_projector: str | None) -> str | None:
    """Settle what places the rest around control points; None for a projection in one step."""
    check_name(control_point_projectors, control_point_projector)
    return control_point_projector or (DEFAULT_CONTROL_POINT_PROJECTOR if two_step else None)


def check_markers(markers: str | None, keep: Sequence[int] | None) -> None:
    """Refuse an unknown search for markers, and one that could give up samples to keep."""
    check_name(marker_searches, markers)
    if markers == "exchange" and keep:
        raise WorkbenchError(
            "--keep: got it with --markers exchange, which takes other samples; want --markers move"
        )


def check_dimensions(dimensions: int | None) -> None:
    """Refuse an embedding in other than two or three dimensions."""
    if dimensions not in (None, 2, 3):
        raise WorkbenchError(f"--dimensions: got {dimensions}, want 2 or 3")


def report(values: Mapping[str, Any], as_json: bool) -> None:
    """Print results as one JSON object, or as lines for people."""
    if as_json:
        typer.echo(json.dumps(values))
        return
    width = max(len(name) for name in values)
    for name, value in values.items():
        if value is None:
            shown = "unknown"
        elif isinstance(value, float):
            shown = f"{value:.4g}"
        elif isinstance(value, list):
            shown = f"{len(value)}: " + " ".join(map(str, value))
        else:
            shown = str(value)
        typer.echo(f"{name.replace('_', ' '):<{width}}  {shown}")
