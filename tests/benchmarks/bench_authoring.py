"""Authoring: what has to be there soon after a marker was dropped or a clip was played."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tests.benchmarks.measuring import Measurement, time_of
from workbench.authoring import (
    Refinement,
    edits,
    foot_slide,
    influence,
    placed,
    play,
    reconstruction_error,
    refined,
    scene_from_clip,
)
from workbench.datasets import load_space


def measurements() -> Iterator[Measurement]:
    """Yield the rows: clip 05_10 with 20 markers."""
    space = load_space("cmu/05_10")
    scene = scene_from_clip(space, "cmu/05_10", selector="scs", count=20, projector="pca")
    place = scene.positions[7] + [0.1, -0.1]
    name = "20 markers, 817 frames of 05_10"
    moved = edits.move_marker(scene, space, 7, place)
    found = dropped(scene, space, place)
    note = (
        f"error per frame per joint {found.before:.3f} by RBFP, {found.after:.3f} optimized "
        f"({reconstruction_error(scene, space):.3f} where PCA put the frames)"
    )
    yield time_of(
        f"a dropped marker, RBFP and optimizer, {name}",
        lambda: dropped(scene, space, place),
        below=2.0,
        note=note,
    )
    yield time_of(f"RBFP alone, {name}", lambda: placed(moved, space), below=0.25)
    yield time_of(f"influence, {name}", lambda: influence(space, scene.markers), below=0.25)
    yield time_of(f"playing, {name}", lambda: play(scene, space), below=0.25)
    kept = edits.set_keep_feet(scene, True)
    yield time_of(f"playing, feet kept, {name}", lambda: play(kept, space), below=0.5)
    yield time_of(f"foot speeds before and after, {name}", lambda: foot_slide(scene, space), 0.5)


def dropped(scene, space, place: np.ndarray) -> Refinement:
    """Do what follows a dropped marker."""
    return refined(edits.move_marker(scene, space, 7, place), space)
