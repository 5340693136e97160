"""What the authoring dashboard shows, and how it is laid out."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import ipywidgets as widgets
import numpy as np
from numpy.typing import NDArray

from workbench.authoring import History, Scene, influence
from workbench.dashboards.authoring.controls import AuthorControls
from workbench.dashboards.authoring.jobs import Clip, Errors, Played
from workbench.dashboards.comparison.code_cell import CodeControls
from workbench.dashboards.shared.layout import alert, control_row, remark
from workbench.dashboards.shared.progress_view import ProgressView
from workbench.mocap.body_nodes import body_nodes
from workbench.mocap.kinematics import end_site_positions, joint_positions
from workbench.mocap.skeleton import Skeleton
from workbench.widgets.authoring import AuthoringPad
from workbench.widgets.file_buttons import FileButtons
from workbench.widgets.time_curves import TimeCurves

_channels = itertools.count(1)

_BEFORE, _AFTER = "foot as rebuilt", "foot kept"

#: Speeds below it are rounding errors, whatever their unit.
_STANDS = 1e-6

_OFFERS = [
    {"want": "bvh", "text": "Save BVH", "hint": "The motion, for any animation program"},
    {"want": "session", "text": "Save session", "hint": "Everything here, to go on with later"},
    {"want": "html", "text": "Save page", "hint": "One HTML file that plays without Python"},
    {
        "want": "opened",
        "text": "Open session …",
        "hint": "Go on with a session from this computer's disk; can be undone",
        "takes": ".json",
    },
]


class AuthorView:
    """The views of the authoring dashboard with its controls around them.

    Parameters
    ----------
    controls : AuthorControls
        What can be chosen.

    Attributes
    ----------
    root : ipywidgets.Widget
        All of it.
    pad : AuthoringPad
        Plane, pose and time.
    feet : TimeCurves
        Speed of the supporting foot over time.
    files : FileButtons
        What can be saved.
    title, text : ipywidgets.Text
        Heading of a saved page, and words below it.
    code : CodeControls
        The script that makes the scene again.
    progress : ProgressView
        What is being computed.
    """

    def __init__(self, controls: AuthorControls) -> None:
        channel = f"author-{next(_channels)}"
        self.pad = AuthoringPad(channel=channel)
        self.feet = TimeCurves(channel=channel)
        self.files = FileButtons(offers=_OFFERS, enabled=False, label="Files")
        self.progress = ProgressView("the places of in-between frames")
        self._message = widgets.HTML()
        self._feet_words = widgets.HTML()
        self.code = CodeControls()
        self._script: Callable[[], str] = str
        self.code.button.observe(lambda _: self.show_code(self._script), "value")
        self._make_page_fields()
        self._clip: Clip | None = None
        self._played: Played | None = None
        self._shares: tuple[bytes, NDArray[np.float64]] | None = None
        self.root = self._laid_out(controls)

    @property
    def message(self) -> str:
        """What is said above the pad, as HTML."""
        return str(self._message.value)

    def show(
        self,
        clip: Clip,
        history: History,
        *,
        roots: NDArray[np.float64] | None,
        answered: int,
        revision: int,
        selected: int | None = None,
        message: str = "",
    ) -> None:
        """Show a scene in the pad, all of it at once.

        Parameters
        ----------
        clip : Clip
            Its clip.
        history : History
            The scene, and what can be undone.
        roots : ndarray of shape (n_output_frames, 3) or None
            Where the root is while the motion plays; None to leave that to the markers.
        answered : int
            Number of the last edit that the scene has taken in or refused.
        revision : int
            Number of what is shown, by which the pad says what an edit was made on.
        selected : int, optional
            The marker to select.
        message : str
            A sentence below the plane.
        """
        scene, pad = history.scene, self.pad
        shares = self._influence(clip, scene)
        with pad.hold_sync():
            if clip is not self._clip:
                self._clip = clip
                self._take(_clip_traits(clip))
            self._take(_scene_traits(scene, shares))
            pad.roots = np.empty(0) if roots is None else roots
            pad.undo_label, pad.redo_label = history.undo_label, history.redo_label
            pad.message = message
            if selected is not None:
                pad.selected = selected
            elif pad.selected >= len(scene.markers):
                pad.selected = -1
            pad.revision, pad.answered = revision, answered
        self.files.enabled = True

    def show_feet(self, clip: Clip, scene: Scene, played: Played | None) -> None:
        """Show how fast the supporting foot is, before and after it is kept from sliding."""
        if played is None or played is self._played:
            return
        self._played = played
        slide = played.slide
        size = clip.space.motion.skeleton.unit_cm
        unit = "units per s" if size is None else "cm per s"
        speeds = [] if slide is None else [slide.before, slide.after]
        values = np.array(speeds, dtype=np.float32) * (size or 1.0)
        values[values < _STANDS] = 0.0
        top = float(values.max()) if values.size else 0.0  # one scale for both
        with self.feet.hold_sync():
            self.feet.rows = [
                {"name": name, "kind": "amount", "unit": unit, "top": top}
                for name in (_BEFORE, _AFTER)[: len(values)]
            ]
            self.feet.values = values
            self.feet.weights = self.feet.candidates = np.zeros(values.shape)
            self.feet.frame_time = scene.frame_time
            self.feet.message = played.note
        self._feet_words.value = _about_feet(values, unit, scene.keep_feet)

    def show_code(self, code: Callable[[], str]) -> None:
        """Offer the script that makes the scene again; it is written where it is looked at only."""
        self._script = code
        if self.code.button.value:
            self.code.show(code())

    def show_message(
        self, clip: Clip | None, scene: Scene | None, refined: Errors | None, told: Sequence[str]
    ) -> None:
        """Say what is shown, and what could not be done."""
        lines = [alert(words) for words in told]
        if clip is not None and scene is not None:
            lines.append(remark(clip.source.name, _about(clip, scene), _about_places(refined)))
        # Named for who waits for what it says.
        self._message.value = f'<div class="wb-author-about">{"".join(lines)}</div>'

    def _influence(self, clip: Clip, scene: Scene) -> NDArray[np.float64]:
        """Compute how markers move frames; it stays the same as long as the poses do."""
        key = b"".join([clip.source.name.encode(), scene.frames.tobytes(), scene.poses.tobytes()])
        if self._shares is None or self._shares[0] != key:
            self._shares = key, influence(clip.space, scene.markers)
        return self._shares[1]

    def _take(self, traits: Mapping[str, Any]) -> None:
        for name, value in traits.items():
            setattr(self.pad, name, value)

    def _make_page_fields(self) -> None:
        self.title = widgets.Text(
            description="Page's title",
            placeholder="the clip's name",
            style={"description_width": "initial"},
            layout=widgets.Layout(flex="1 1 220px", max_width="340px"),
        )
        self.text = widgets.Text(
            description="Text below it",
            placeholder="optional",
            style={"description_width": "initial"},
            layout=widgets.Layout(flex="2 1 260px", max_width="520px"),
        )

    def _laid_out(self, controls: AuthorControls) -> widgets.Widget:
        for view in (self.pad, self.feet):
            view.layout = widgets.Layout(width="100%", min_width="0")
        self.files.layout = widgets.Layout(flex="1 1 440px", min_width="0")
        self._feet_words.layout = widgets.Layout(flex="1 1 300px", min_width="0")
        return widgets.VBox(
            [
                controls.start,
                self.progress.view,
                self._message,
                self.pad,
                controls.edits,
                control_row([controls.keep_feet, self._feet_words]),
                self.feet,
                control_row([self.files, controls.session, controls.open_session]),
                control_row([self.title, self.text]),
                self.code.view,
            ],
            layout=widgets.Layout(width="100%"),
        )


def _clip_traits(clip: Clip) -> dict[str, Any]:
    motion = clip.space.motion
    nodes = body_nodes(motion.skeleton)
    return {
        "parents": nodes.parents,
        "sides": nodes.sides,
        "head": nodes.head,
        "offsets": _offsets(motion.skeleton),
        "joint_names": list(motion.skeleton.names),
        "frame_time": float(motion.frame_time),
        "ghost": np.concatenate([joint_positions(motion), end_site_positions(motion)], axis=1),
        "time": 0.0,
        "selected": -1,
    }


def _offsets(skeleton: Skeleton) -> NDArray[np.float64]:
    ends = [site.offset for site in skeleton.end_sites]
    return np.concatenate([skeleton.offsets, np.reshape(ends, (-1, 3))])


def _scene_traits(scene: Scene, shares: NDArray[np.float64]) -> dict[str, Any]:
    return {
        "kernel": scene.kernel,
        "epsilon": scene.epsilon or 0.0,
        "markers": scene.positions,
        "marker_poses": scene.poses.reshape(len(scene.markers), -1),
        "marker_roots": scene.roots,
        "marker_frames": scene.frames,
        "marker_names": [marker.name for marker in scene.markers],
        "influence": shares,
        "embedding": scene.embedding,
        "points": scene.trajectory.points,
        "times": scene.trajectory.times,
        "follows": scene.follows,
    }


def _about(clip: Clip, scene: Scene) -> str:
    duration = scene.trajectory.duration
    words = [
        f"{scene.n_frames} frames ({scene.n_frames * scene.frame_time:.1f} s)",
        f"{clip.space.motion.skeleton.n_joints} joints",
        f"{len(scene.markers)} key poses",
        f"the curve {'is the clip’s own' if scene.follows else 'is yours'}, {duration:.1f} s",
    ]
    return " · ".join(words)


def _about_places(refined: Errors | None) -> str:
    if refined is None:
        return ""
    return (
        f"in-between frames: error {refined.before:.3g} before the optimizer and "
        f"{refined.after:.3g} after it, in rad per frame per joint"
    )


def _about_feet(speeds: NDArray[np.float32], unit: str, kept: bool) -> str:
    if len(speeds) == 0:
        return ""
    before, after = (
        f"{_short(speed.mean())} {unit} in the mean, {_short(speed.max())} at most"
        for speed in speeds
    )
    words = f"as rebuilt {before}; if it is kept {after}"
    return remark("Supporting foot slides", words + "; it is kept" * kept)


def _short(number: float) -> str:
    """Write three digits, without an exponent."""
    return f"{float(f'{number:.3g}'):g}"
