"""What the keyframe inspector shows, and how it is laid out."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import ipywidgets as widgets
import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.inspection.controls import InspectorControls
from workbench.dashboards.inspection.jobs import Clip, ErrorCurve, KeyframeResult
from workbench.dashboards.shared.layout import alert, remark, view_row
from workbench.dashboards.shared.progress_view import ProgressView
from workbench.widgets.count_curve import CountCurve
from workbench.widgets.picture import PictureView
from workbench.widgets.player import MotionPlayer, motion_traits
from workbench.widgets.time_curves import TimeCurves

_channels = itertools.count(1)


class InspectorView:
    """The views of the keyframe inspector below its controls.

    Parameters
    ----------
    controls : InspectorControls
        What can be chosen.

    Attributes
    ----------
    root : ipywidgets.Widget
        All of it.
    player : MotionPlayer
        The original and the reconstruction.
    curves : TimeCurves
        Saliency and error over time.
    counts : CountCurve
        Error against the number of keyframes.
    filmstrip, thumbnail : PictureView
        Pictures of the keyframes.
    progress : ProgressView
        What is being computed.
    """

    def __init__(self, controls: InspectorControls) -> None:
        channel = f"inspector-{next(_channels)}"
        self.player = MotionPlayer(channel=channel)
        self.curves = TimeCurves(channel=channel)
        self.counts = CountCurve(unit="Error per frame per joint in rad")
        self.filmstrip = PictureView(title="Filmstrip")
        self.thumbnail = PictureView(title="Thumbnail")
        self.progress = ProgressView()
        self._message = widgets.HTML()
        self._shown: KeyframeResult | None = None
        self.root = self._laid_out(controls)

    def show_clip(self, clip: Clip) -> None:
        """Show another clip, of which there are no keyframes yet."""
        self._shown = None
        contacts = _contacts(clip)
        with self.player.hold_sync():
            self.player.frame = 0
            self.player.keyframes = []
            self.player.contacts = contacts
            self.player.description = clip.name
            for name, value in motion_traits({"original": clip.motion}).items():
                setattr(self.player, name, value)
        with self.curves.hold_sync():
            self.curves.rows, self.curves.frame = [], 0
            for name in ("values", "weights", "candidates", "keyframes", "foot_keyframes"):
                setattr(self.curves, name, [])
            self.curves.contacts = contacts
            self.curves.frame_time = float(clip.motion.frame_time)
        for picture in (self.filmstrip, self.thumbnail):
            picture.svg = ""

    def show_keyframes(self, clip: Clip, result: KeyframeResult) -> None:
        """Show keyframes, the curves they were found on, and what they rebuild."""
        if result is self._shown:
            return
        self._shown = result
        motions = {"original": clip.motion, "reconstruction": result.reconstruction}
        with self.player.hold_sync():
            for name, value in motion_traits(motions).items():
                setattr(self.player, name, value)
            self.player.keyframes = result.keyframes
        rows, values, weights, candidates = _rows(clip, result)
        with self.curves.hold_sync():
            self.curves.rows = rows
            self.curves.values, self.curves.weights = values, weights
            self.curves.candidates = candidates
            self.curves.keyframes = result.keyframes
            self.curves.foot_keyframes = result.foot_keyframes
        n = len(result.keyframes)
        for picture, svg, words in (
            (self.filmstrip, result.filmstrip, "side by side"),
            (self.thumbnail, result.thumbnail, "in one picture"),
        ):
            with picture.hold_sync():
                picture.name = f"{_file_name(clip.name)}-{n}-{picture.title.lower()}"
                picture.description = f"{n} key poses of {clip.name} {words}"
                picture.svg = svg

    def show_counts(
        self,
        curves: dict[str, ErrorCurve],
        result: KeyframeResult | None,
        message: str,
        *,
        most: int,
        waiting: bool,
    ) -> None:
        """Show how the error falls with the number of keyframes.

        Parameters
        ----------
        curves : dict of str to ErrorCurve
            By method.
        result : KeyframeResult or None
            What is shown elsewhere.
        message : str
            What is missing, and why.
        most : int
            The largest number of keyframes that can be chosen.
        waiting : bool
            Whether other keyframes are being found.
        """
        series = [
            {"name": name, "counts": curve.counts.tolist(), "errors": curve.errors.tolist()}
            for name, curve in curves.items()
        ]
        with self.counts.hold_sync():
            if self.counts.series != series:
                self.counts.series = series
            self.counts.count = len(result.keyframes) if result else 0
            self.counts.error = result.error if result else None
            self.counts.message = message
            self.counts.most, self.counts.waiting = most, waiting

    def show_message(
        self, clip: Clip | None, result: KeyframeResult | None, failures: Sequence[str]
    ) -> None:
        """Say what is shown, and what could not be computed."""
        lines = [alert(failure) for failure in failures]
        if clip is not None:
            lines.append(_about(clip, result))
        self._message.value = "".join(lines)

    def _laid_out(self, controls: InspectorControls) -> widgets.Widget:
        for view, flex in ((self.player, "3 1 440px"), (self.counts, "2 1 320px")):
            view.layout = widgets.Layout(flex=flex, min_width="0")
        for view in (self.curves, self.filmstrip, self.thumbnail):
            view.layout = widgets.Layout(width="100%", min_width="0")
        return widgets.VBox(
            [
                controls.view,
                self.progress.view,
                self._message,
                view_row([self.player, self.counts]),
                self.curves,
                self.filmstrip,
                self.thumbnail,
            ],
            layout=widgets.Layout(width="100%"),
        )


def _contacts(clip: Clip) -> list[dict[str, Any]]:
    return [
        {"name": foot.joint, "side": foot.side, "spans": foot.spans.tolist()}
        for foot in clip.contacts
    ]


def _rows(
    clip: Clip, result: KeyframeResult
) -> tuple[list[dict[str, str]], NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]]:
    """Put the error, components and feet in rows: what they are, values, weights, candidates."""
    saliency = result.saliency
    means = saliency.saliency.mean(axis=0)
    weights = saliency.saliency / np.where(means > 0, means, 1.0)
    n_frames, n_curves = saliency.curves.shape
    nothing = np.zeros((1, n_frames))
    feet = [foot.joint for foot in clip.contacts] if saliency.is_foot.any() else []
    components = [f"component {curve + 1}" for curve in range(n_curves - len(feet))]
    rows = [
        {"name": "error", "kind": "amount", "unit": "rad per joint"},
        *({"name": name, "kind": "curve", "unit": ""} for name in components),
        *({"name": name, "kind": "curve", "unit": "", "note": "height"} for name in feet),
    ]
    return (
        rows,
        np.concatenate([result.errors[None], saliency.curves.T]),
        np.concatenate([nothing, weights.T]),
        np.concatenate([nothing.astype(bool), saliency.candidates.T]),
    )


def _about(clip: Clip, result: KeyframeResult | None) -> str:
    motion = clip.motion
    seconds = len(motion) * motion.frame_time
    words = [f"{len(motion)} frames ({seconds:.1f} s), {motion.skeleton.n_joints} joints"]
    notes = list(clip.notes)
    if result is not None:
        words.append(f"{len(result.keyframes)} keyframes")
        words.append(f"error {result.error:.3g} rad per frame per joint")
        if np.isfinite(result.psnr):
            words.append(f"PSNR {result.psnr:.1f} dB")
        words += _about_saliency(result)
        notes += result.notes
    text = " · ".join(words)
    return remark(clip.name, text, "; ".join(notes))


def _about_saliency(result: KeyframeResult) -> list[str]:
    saliency = result.saliency
    n_feet = int(saliency.is_foot.sum())
    n_components = len(saliency.is_foot) - n_feet
    share = saliency.explained_variance_ratio
    words = [f"{n_components} components keep {share:.0%} of the variance"]
    if n_feet:
        found = f"{len(result.foot_keyframes)} of the keyframes found on them"
        words.append(f"{n_feet} of the {len(saliency.is_foot)} curves are feet, {found}")
    return words


def _file_name(name: str) -> str:
    """Make a file's name of a clip's name or path."""
    last = name.replace("\\", "/").rpartition("/")[2].partition(".")[0]
    return "".join(c if c.isalnum() or c in "-_" else "-" for c in last) or "clip"
