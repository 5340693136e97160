"""The commands ``project``, ``keyframes``, ``compact`` and ``expand``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from workbench.cli import options
from workbench.errors import WorkbenchError

if TYPE_CHECKING:
    from workbench.results import SpatialResult
    from workbench.spaces import PoseSpace, Space


def project(
    data: options.Data,
    projector: options.Projector = "pca",
    control_points: Annotated[
        str | None,
        typer.Option(
            help="Selector of control points; by default random for tables, uniform for motions."
        ),
    ] = None,
    count: options.Count = None,
    ratio: options.Ratio = None,
    optimize: options.Optimize = False,
    optimizer: options.Optimizer = None,
    back_projector: options.BackProjector = None,
    standardize: options.Standardize = False,
    label: options.Label = None,
    seed: options.Seed = 0,
    out: options.Out = None,
    json: options.Json = False,
) -> None:
    """Project a table or a motion to the plane and measure the result."""
    chosen = options.chosen_optimizer(optimize, optimizer)
    amount = options.count_or_ratio(count, ratio)
    writer = _table_writer(out)

    from workbench.schemes import SpatialScheme

    space = _load(data, label, standardize)
    scheme = SpatialScheme(projector, control_points, back_projector, chosen)
    result = scheme.run(space, random_state=seed, **amount)
    values = {
        **asdict(result.quality),
        "reconstruction_error": result.error,
        "relative_reconstruction_error": result.relative_error,
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
    seed: options.Seed = 0,
    json: options.Json = False,
) -> None:
    """Select keyframes of a motion."""
    amount = options.count_or_ratio(count, ratio)

    from workbench.schemes import choose_control_points

    space = _load_motion(clip)
    frames = choose_control_points(space, selector, random_state=seed, **amount)
    options.report({"frames": frames.tolist()}, json)


def compact(
    clip: options.Clip,
    selector: options.Selector = "uniform",
    interpolator: options.Interpolator = None,
    projector: options.Projector = None,
    count: options.Count = None,
    ratio: options.Ratio = None,
    optimize: options.Optimize = False,
    optimizer: options.Optimizer = None,
    seed: options.Seed = 0,
    out: Annotated[
        Path | None, typer.Option(help="Compact file to write; expand makes a BVH file of it.")
    ] = None,
    json: options.Json = False,
) -> None:
    """Keep the keyframes of a motion, rebuild the rest and measure what was lost.

    With --interpolator the frames between are interpolated in time; with --projector they
    are rebuilt from their positions in the plane.
    """
    if (interpolator is None) == (projector is None):
        raise WorkbenchError("want exactly one of --interpolator and --projector")
    chosen = options.chosen_optimizer(optimize, optimizer)
    if interpolator is not None and chosen is not None:
        raise WorkbenchError("--optimize: got it with --interpolator, want it with --projector")
    amount = options.count_or_ratio(count, ratio)
    _check_folder(out)

    from workbench.compact import compact_motion, write_compact
    from workbench.quality.reconstruction import compression_ratio, position_error
    from workbench.results import SpatialResult
    from workbench.schemes import SpatialScheme, TemporalScheme

    space = _load_motion(clip)
    scheme: TemporalScheme | SpatialScheme
    if interpolator is not None:
        scheme = TemporalScheme(interpolator, selector)
    else:
        scheme = SpatialScheme(projector, selector, optimizer=chosen)
    result = scheme.run(space, random_state=seed, **amount)
    if out is not None:
        write_compact(compact_motion(result, interpolator), out)

    keys = result.control_points
    values: dict[str, Any] = {
        "keyframes": keys.tolist(),
        "error_per_frame_per_joint": result.error,
        "position_error": position_error(space.motion, result.reconstruction),
    }
    unit = space.motion.skeleton.unit_cm
    if unit is not None:
        values["position_error_cm"] = values["position_error"] * unit
    values["compression_ratio"] = compression_ratio(
        len(space),
        len(keys),
        space.motion.skeleton.n_joints,
        n_coordinates=result.embedding.shape[1] if isinstance(result, SpatialResult) else 0,
    )
    values["evaluations"] = result.evaluations if isinstance(result, SpatialResult) else 0
    values["seconds"] = result.timings.total
    options.report(values, json)


def expand(
    file: Annotated[Path, typer.Argument(help="A compact file.")],
    out: Annotated[Path, typer.Option(help="BVH file to write.")],
) -> None:
    """Rebuild a motion from a compact file and write it as BVH."""
    if out.suffix.lower() != ".bvh":
        raise WorkbenchError(f"--out: got {str(out)!r}, want a name ending in .bvh")
    _check_folder(out)

    from workbench.compact import read_compact
    from workbench.mocap import write_bvh

    write_bvh(read_compact(file).expand(), out)


def _load(source: str, label: str | None = None, standardize: bool = False) -> Space:
    """Load data, and say how a table was treated to become numbers."""
    from workbench.datasets import load_space

    space = load_space(source, label=label, standardize=standardize)
    for note in space.notes:
        typer.echo(f"workbench: note: {note}", err=True)
    return space


def _load_motion(clip: str) -> PoseSpace:
    from workbench.spaces import PoseSpace

    space = _load(clip)
    if not isinstance(space, PoseSpace):
        raise WorkbenchError(f"{clip}: got a table, want a motion")
    return space


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
    _check_folder(out)

    from workbench.files import write_atomically

    return lambda table: write_atomically(out, content(table))


def _check_folder(out: Path | None) -> None:
    """Refuse an output file that has no place, before anything is computed."""
    if out is None:
        return
    if out.is_dir():
        raise WorkbenchError(f"--out: got the folder {str(out)!r}, want the name of a file")
    if not out.resolve().parent.is_dir():
        raise WorkbenchError(f"--out: there is no folder {str(out.resolve().parent)!r}")


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
