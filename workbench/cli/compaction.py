"""The commands ``compact`` and ``expand``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from workbench.cli import options
from workbench.cli.files import check_folder, load_motion, write
from workbench.errors import WorkbenchError
from workbench.interpolation import interpolators
from workbench.optimization import COMPACTION_OPTIMIZER
from workbench.projection import projectors
from workbench.selection import selectors


def compact(
    clip: options.Clip,
    selector: options.Selector = "uniform",
    interpolator: options.Interpolator = None,
    projector: options.Projector = None,
    count: options.Count = None,
    ratio: options.Ratio = None,
    keep: options.Keep = None,
    two_step: options.TwoStep = False,
    control_point_projector: options.ControlPointProjector = None,
    dimensions: options.Dimensions = None,
    optimize: options.Optimize = False,
    optimizer: options.Optimizer = None,
    markers: options.Markers = None,
    tolerance: Annotated[
        float,
        typer.Option(
            min=0, help="What rounding in the file may add to the error, as a share of it."
        ),
    ] = 0.01,
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
    options.check_name(selectors, selector)
    options.check_name(interpolators, interpolator)
    options.check_name(projectors, projector)
    options.check_amount(count, ratio, keep)
    options.check_dimensions(dimensions)
    options.check_markers(markers, keep)
    second_step = options.chosen_second_step(two_step, control_point_projector)
    chosen = options.chosen_optimizer(optimize, optimizer, COMPACTION_OPTIMIZER)
    spatial = {
        "--optimize": chosen,
        "--two-step": second_step,
        "--dimensions": dimensions,
        "--markers": markers,
    }
    for option, value in spatial.items():
        if interpolator is not None and value is not None:
            raise WorkbenchError(f"{option}: got it with --interpolator, want it with --projector")
    check_folder(out)

    from workbench.compact import compact_bytes, compact_motion, compare_sizes
    from workbench.quality.reconstruction import compression_ratio, position_error
    from workbench.results import SpatialResult
    from workbench.schemes import SpatialScheme, TemporalScheme

    space = load_motion(clip)
    amount = options.amount(selector, count, ratio, keep, len(space))
    scheme: TemporalScheme | SpatialScheme
    if interpolator is not None:
        scheme = TemporalScheme(interpolator, selector)
    else:
        scheme = SpatialScheme(
            projector,
            selector,
            optimizer=chosen,
            two_step=second_step,
            dimensions=dimensions,
            markers=markers,
        )
    result = scheme.run(space, random_state=seed, **amount)
    compacted = compact_motion(result, interpolator, tolerance=tolerance)
    content = compact_bytes(compacted)
    if out is not None:
        write(out, content)

    keys = result.control_points
    values: dict[str, Any] = {
        "keyframes": keys.tolist(),
        "error_per_frame_per_joint": result.error,
        "expanded_error_per_frame_per_joint": compacted.error,
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
    values |= compare_sizes(len(content), space.motion, _bvh_file(clip)).as_dict()
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
    check_folder(out)

    from workbench.compact import read_compact
    from workbench.mocap import write_bvh

    write_bvh(read_compact(file).expand(), out)


def _bvh_file(clip: str) -> Path | None:
    """Find the BVH file that a whole clip was read from, if it was one."""
    from workbench.datasets import registered_datasets
    from workbench.datasets.catalogue import lookup
    from workbench.datasets.entries import ClipEntry
    from workbench.datasets.loaders import status

    if clip in registered_datasets():
        return None
    entry = lookup(clip)
    if entry is not None:
        return status(entry).path if isinstance(entry, ClipEntry) else None
    path = Path(clip).expanduser()
    return path if path.suffix.lower() == ".bvh" else None
