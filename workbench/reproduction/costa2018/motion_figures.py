"""Figures 5.6 to 5.11 of Costa 2018: motions projected in two steps, and optimized."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any, cast

import pandas as pd
import plotly.graph_objects as go

from workbench.datasets import load_space
from workbench.datasets.catalogue import lookup
from workbench.errors import WorkbenchError
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.schemes import SchemeRun, scheme_name
from workbench.experiments.store import ResultStore
from workbench.figures.embeddings import Panel
from workbench.figures.trajectories import trajectory_panels
from workbench.reproduction.costa2018.keyframe_errors import RATIO
from workbench.reproduction.costa2018.results import PROJECTORS
from workbench.reproduction.outputs import Outputs
from workbench.reproduction.profiles import excerpts, motion_clips
from workbench.reproduction.published import published
from workbench.schemes import SpatialScheme
from workbench.spaces import PoseSpace


@dataclass(frozen=True)
class MotionFigure:
    """A figure of a motion projected by RBFP, raw and optimized.

    Attributes
    ----------
    item : str
        Id of the figure.
    action : str
        What is done, in the words of the caption.
    projector : str
        The seed projector, by its name in the thesis.
    published_clip : str
        The clip of the caption.
    stand_ins : tuple of str
        Clips of the nearest action, best first, for where that clip is missing.
    """

    item: str
    action: str
    projector: str
    published_clip: str
    stand_ins: tuple[str, ...]

    @property
    def raw(self) -> SpatialScheme:
        """The scheme without optimization."""
        return SpatialScheme(PROJECTORS[self.projector], "rols", two_step="rbfp")

    @property
    def optimized(self) -> SpatialScheme:
        """The scheme with the optimizer of Alg. 12."""
        method = PROJECTORS[self.projector]
        return SpatialScheme(method, "rols", two_step="rbfp", optimizer="alg12")

    def clip(self, profile: str) -> str | None:
        """Choose the clip among those of a profile and the excerpts; None if there is none."""
        present = {*excerpts(), *motion_clips(profile)}
        candidates = (self.published_clip, *self.stand_ins)
        return next((clip for clip in candidates if clip in present), None)


MOTION_FIGURES = (
    MotionFigure(
        "costa2018:fig5.6", "walk cycle", "LLE", "cmu/02_02", ("cmu/02_01", "cmu/01_03-walk")
    ),
    MotionFigure("costa2018:fig5.7", "jump and balance", "Force", "cmu/02_04", ("cmu/01_01-jump",)),
    MotionFigure(
        "costa2018:fig5.8",
        "walk on uneven terrain",
        "MDS",
        "cmu/03_01",
        ("cmu/07_05", "cmu/01_03-walk"),
    ),
    MotionFigure(
        "costa2018:fig5.9",
        "dance: glissade devant, glissade derriere, attitude/arabesque",
        "t-SNE",
        "cmu/05_09",
        ("cmu/05_10", "cmu/01_01-turn"),
    ),
    MotionFigure(
        "costa2018:fig5.10",
        "dance: small jetes, pirouette",
        "PCA",
        "cmu/05_13",
        ("cmu/05_07", "cmu/01_01-two-jumps"),
    ),
    MotionFigure(
        "costa2018:fig5.11",
        "basketball: forward dribble, 90-degree right turns",
        "Isomap",
        "cmu/06_11",
        ("cmu/06_02", "cmu/01_03-walk"),
    ),
)


def figure_runs(profile: str, seed: int) -> list[Run]:
    """List the runs of the figures."""
    return [
        SchemeRun(clip, scheme, ratio=RATIO, seed=seed)
        for figure in MOTION_FIGURES
        if (clip := figure.clip(profile)) is not None
        for scheme in (figure.raw, figure.optimized)
    ]


@dataclass(frozen=True)
class MadeFigure:
    """What a figure shows.

    Attributes
    ----------
    figure : MotionFigure
        Which figure.
    clip : str
        The clip that it was made of.
    panels : list of Panel
        Before and after the optimization.
    stress_ratio, scale_normalized_stress_ratio, error_ratio : float
        After optimization over before.
    n_frames, n_keys : int
        How many frames, and how many of them are keyframes.
    seconds : float
        How long the clip lasts.
    """

    figure: MotionFigure
    clip: str
    panels: list[Panel]
    stress_ratio: float
    scale_normalized_stress_ratio: float
    error_ratio: float
    n_frames: int
    n_keys: int
    seconds: float


def make_figure(
    figure: MotionFigure, profile: str, table: pd.DataFrame, store: ResultStore
) -> MadeFigure | str:
    """Gather what a figure shows.

    Parameters
    ----------
    figure : MotionFigure
        Which figure.
    profile : {"quick", "full"}
        Which clips may be used.
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    store : ResultStore
        Holds the embeddings.

    Returns
    -------
    MadeFigure or str
        Or why it cannot be made.
    """
    clip = figure.clip(profile)
    if clip is None:
        return (
            f"{figure.published_clip} and clips of a similar action are not on this machine; "
            f"`workbench datasets fetch {figure.published_clip}` downloads it."
        )
    raw, optimized = (_row(table, clip, scheme) for scheme in (figure.raw, figure.optimized))
    for row in (raw, optimized):
        if row["status"] != "done":
            return f"A run failed: {row['message']}"
    arrays = store.arrays(optimized["key"])
    keys = arrays["control_points"]
    method = figure.projector
    return MadeFigure(
        figure,
        clip,
        [
            Panel(f"RBFP with {method}", arrays["projected"], keys),
            Panel(f"RBFP with {method}, optimized", arrays["embedding"], keys),
        ],
        stress_ratio=float(optimized["stress_ratio"]),
        scale_normalized_stress_ratio=float(optimized["scale_normalized_stress_ratio"]),
        error_ratio=float(optimized["error"] / raw["error"]),
        n_frames=int(optimized["n_samples"]),
        n_keys=len(keys),
        seconds=_seconds(clip),
    )


def _seconds(clip: str) -> float:
    # All figures are of motions; a table has no time.
    motion = cast(PoseSpace, load_space(clip)).motion
    return float((len(motion) - 1) * motion.frame_time)


def _row(table: pd.DataFrame, clip: str, scheme: SpatialScheme) -> dict[Hashable, Any]:
    """Find the run of a scheme on a clip."""
    chosen = (table["dataset"] == clip) & (table["scheme"] == scheme_name(scheme))
    return table[chosen].to_dict("records")[0]


def save_figure(
    outputs: Outputs, item: str, profile: str, table: pd.DataFrame, store: ResultStore
) -> go.Figure | None:
    """Draw a figure and save it with its ratios, or save why it cannot be made.

    Parameters
    ----------
    outputs : Outputs
        Where to.
    item : str
        Id of the figure.
    profile, table, store
        As :func:`make_figure` takes them.

    Returns
    -------
    plotly.graph_objects.Figure or None
        None if it cannot be made.

    Raises
    ------
    WorkbenchError
        If there is no such figure.
    """
    figure = {known.item: known for known in MOTION_FIGURES}.get(item)
    if figure is None:
        known = ", ".join(known.item for known in MOTION_FIGURES)
        raise WorkbenchError(f"item: got {item!r}, want one of {known}")
    made = make_figure(figure, profile, table, store)
    if isinstance(made, str):
        outputs.not_made(item, made)
        return None
    drawn = trajectory_panels(made.panels, crosses=True, seconds=made.seconds)
    outputs.figure(item, drawn, caption=caption(made), alt=alt(made))
    outputs.table(
        item,
        ratios(made),
        caption="Stress of the projection and error of the rebuilt motion, after optimization "
        f"over before, beside the caption of the thesis.{_stand_in(made)}",
        name="ratios",
    )
    return drawn


def ratios(made: MadeFigure) -> pd.DataFrame:
    """Set the ratios of a figure beside those of its caption."""
    printed = published(made.figure.item).table().iloc[0]
    rows = {
        "stress, Eq. 4.1": (made.stress_ratio, float(printed["stress"])),
        "stress, scale-normalised": (made.scale_normalized_stress_ratio, None),
        "error": (made.error_ratio, float(printed["error"])),
    }
    table = pd.DataFrame.from_dict(
        {
            name: {
                "ours": ours,
                "published": theirs,
                "difference": None if theirs is None else ours - theirs,
            }
            for name, (ours, theirs) in rows.items()
        },
        orient="index",
    ).astype(float)
    table.index.name = "after / before"
    return table


def caption(made: MadeFigure) -> str:
    """Say what a figure shows and how it differs from the published one."""
    figure = made.figure
    name = made.clip.removeprefix("cmu/")
    return (
        f"{figure.action[0].upper()}{figure.action[1:]}: {name}, {made.n_frames} frames, projected "
        f"in two steps, seeds by {figure.projector}, before (left) and after (right) optimization "
        f"by Alg. 12. Crosses are the {made.n_keys} keyframes (ROLS), dots the other frames; "
        f"colour is time.{_stand_in(made)}"
    )


def _stand_in(made: MadeFigure) -> str:
    """Say which clip stands in for that of the thesis, if one does."""
    if made.clip == made.figure.published_clip:
        return ""
    entry = lookup(made.clip)
    what = f" ({entry.title})" if entry else ""
    theirs = made.figure.published_clip.removeprefix("cmu/")
    return (
        f" The thesis shows {theirs}, which was not used here; {made.clip.removeprefix('cmu/')}"
        f"{what} stands in for it, so the ratios are of another motion."
    )


def alt(made: MadeFigure) -> str:
    """Tell who does not see the figure what it shows."""
    return (
        f"Two trajectories of {made.clip.removeprefix('cmu/')} in the plane, before and after "
        f"optimization. After it the stress is {made.stress_ratio:.2f} and the reconstruction "
        f"error {made.error_ratio:.2f} of what they were before."
    )
