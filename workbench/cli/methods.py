"""The commands ``project`` and ``keyframes``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from workbench.backprojection import back_projectors
from workbench.cli import options
from workbench.cli.files import check_folder, load, load_motion, write
from workbench.errors import WorkbenchError
from workbench.optimization import VISUALIZATION_OPTIMIZER
from workbench.projection import projectors
from workbench.selection import selectors

if TYPE_CHECKING:
    from workbench.mocap.motion import Motion
    from workbench.results import SpatialResult


def project(
    data: options.Data,
    projector: options.Projector = "pca",
    control_points: options.ControlPoints = None,
    count: options.Count = None,
    ratio: options.Ratio = None,
    keep: options.Keep = None,
    two_step: options.TwoStep = False,
    control_point_projector: options.ControlPointProjector = None,
    dimensions: options.Dimensions = None,
    optimize: options.Optimize = False,
    optimizer: options.Optimizer = None,
    markers: options.Markers = None,
    back_projector: options.BackProjector = None,
    standardize: options.Standardize = False,
    label: options.Label = None,
    seed: options.Seed = 0,
    out: options.Out = None,
    json: options.Json = False,
) -> None:
    """Project a table or a motion to plane or space and measure the result."""
    options.check_name(projectors, projector)
    options.check_name(selectors, control_points)
    options.check_name(back_projectors, back_projector)
    options.check_amount(count, ratio, keep)
    options.check_dimensions(dimensions)
    options.check_markers(markers, keep)
    second_step = options.chosen_second_step(two_step, control_point_projector)
    chosen = options.chosen_optimizer(optimize, optimizer, VISUALIZATION_OPTIMIZER)
    writer = _table_writer(out)

    from workbench.schemes import SpatialScheme

    space = load(data, label, standardize)
    amount = options.amount(control_points, count, ratio, keep, len(space))
    scheme = SpatialScheme(
        projector, control_points, back_projector, chosen, second_step, dimensions, markers
    )
    result = scheme.run(space, random_state=seed, **amount)
    values = {
        **asdict(result.quality),
        "reconstruction_error": result.error,
        "relative_reconstruction_error": result.relative_error,
        "evaluations": result.evaluations,
        "seconds": result.timings.total,
    }
    if writer is not None:
        writer(_embedding_table(result))
    options.report(values, json)


def keyframes(
    clip: options.Clip,
    selector: options.Selector = "uniform",
    count: options.Count = None,
    ratio: options.Ratio = None,
    keep: options.Keep = None,
    seed: options.Seed = 0,
    thumbnail: options.Thumbnail = None,
    json: options.Json = False,
) -> None:
    """Select keyframes of a motion, and draw them as one picture if wanted."""
    options.check_name(selectors, selector)
    options.check_amount(count, ratio, keep)
    draw = _picture_writer(thumbnail)

    from workbench.schemes import choose_control_points

    space = load_motion(clip)
    amount = options.amount(selector, count, ratio, keep, len(space))
    frames = choose_control_points(space, selector, random_state=seed, **amount)
    if draw is not None:
        draw(space.motion, frames)
    options.report({"frames": frames.tolist()}, json)


def _table_writer(out: Path | None) -> Callable[[Any], None] | None:
    """Choose how to write a table, before anything is computed."""
    if out is None:
        return None
    contents = {
        ".csv": lambda table: table.to_csv(index=False).encode(),
        ".parquet": lambda table: table.to_parquet(index=False),
    }
    content = contents.get(out.suffix.lower())
    if content is None:
        raise WorkbenchError(f"--out: got {str(out)!r}, want a name ending in .csv or .parquet")
    check_folder(out)
    return lambda table: write(out, content(table))


def _picture_writer(path: Path | None) -> Callable[[Motion, Any], None] | None:
    """Choose how to draw keyframes, before anything is computed."""
    if path is None:
        return None
    writers = {".svg": _write_svg, ".png": _write_png}
    writer = writers.get(path.suffix.lower())
    if writer is None:
        raise WorkbenchError(f"--thumbnail: got {str(path)!r}, want a name ending in .svg or .png")
    check_folder(path, "--thumbnail")
    return lambda motion, frames: writer(path, motion, frames)


def _write_svg(path: Path, motion: Motion, frames: Any) -> None:
    from workbench.figures.thumbnails import thumbnail_svg

    write(path, thumbnail_svg(motion, frames).encode())


def _write_png(path: Path, motion: Motion, frames: Any) -> None:
    from workbench.figures.thumbnails import thumbnail
    from workbench.reproduction.figure_png import figure_png

    try:
        content = figure_png(thumbnail(motion, frames))
    except WorkbenchError as error:
        raise WorkbenchError(f"--thumbnail: {error}") from None
    write(path, content)


def _embedding_table(result: SpatialResult) -> Any:
    """Lay out positions, errors and labels, one row for each sample."""
    import numpy as np
    import pandas as pd

    columns: dict[str, Any] = {
        axis: result.embedding[:, i] for i, axis in enumerate("xyz"[: result.embedding.shape[1]])
    }
    columns["control_point"] = np.isin(np.arange(len(result.space)), result.control_points)
    columns["error"] = result.errors
    labels = getattr(result.space, "labels", None)
    if labels is not None:
        columns["label"] = labels
    return pd.DataFrame(columns)
