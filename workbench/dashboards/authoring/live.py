"""The authoring dashboard at work: what people do, computed and shown."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from workbench.authoring import Scene, Session, edits, play
from workbench.dashboards.authoring.controls import AuthorControls
from workbench.dashboards.authoring.edits import BEST, Edited
from workbench.dashboards.authoring.jobs import Clip, Job, Methods, Placing, Posing
from workbench.dashboards.authoring.openings import opening_of
from workbench.dashboards.authoring.revisions import Revisions
from workbench.dashboards.authoring.session import AuthorSession
from workbench.dashboards.authoring.state import AuthorState, Opening, Step
from workbench.dashboards.authoring.view import AuthorView
from workbench.dashboards.shared.background import Background
from workbench.dashboards.shared.sources import Source, loaded_here, reread
from workbench.dashboards.shared.worker import Worker
from workbench.errors import WorkbenchError

#: Stands in a script for a scene that was set.
FROM_PYTHON = "# scene: the one that was set from Python"

_POSE_DROPPED = (
    "the new pose was given up, because something else was done before its place was found: "
    "turn the joint again"
)


class LiveAuthor:
    """Turn what a person does into scenes, and scenes into what is shown.

    Parameters
    ----------
    controls : AuthorControls
        What can be chosen.
    methods : Methods
        Selectors and projectors.

    Attributes
    ----------
    state : AuthorState
        All scenes, and what is wanted.
    view : AuthorView
        What is shown.
    worker : Worker
        What computes beside the kernel.
    refusal : str
        Why the last edit in the pad was not done; empty if it was.
    trouble : str
        Why a session could not be opened.
    """

    def __init__(self, controls: AuthorControls, methods: Methods) -> None:
        self.controls = controls
        self.state = AuthorState()
        self.view = AuthorView(controls)
        self.refusal = self.trouble = ""
        self._methods = methods
        self._answered = 0
        self._revisions = Revisions()
        self._shown: tuple[Any, ...] = ()
        self._background = Background(AuthorSession)
        self.worker: Worker[Job] = Worker(
            self._background,
            missing=self.state.missing,
            failures=self.state.failures,
            prepare=self._prepared,
            done=self._take,
            changed=self._show,
            report=self._report,
        )

    @property
    def clip(self) -> Clip:
        """The clip of what is shown.

        Raises
        ------
        WorkbenchError
            If there is none yet.
        """
        if self.state.clip is None:
            told = "; ".join(self.told()) or "wait until it is loaded"
            raise WorkbenchError(f"clip: there is none yet: {told}")
        return self.state.clip

    @property
    def scene(self) -> Scene:
        """What is shown.

        Raises
        ------
        WorkbenchError
            If there is nothing yet.
        """
        _ = self.clip
        assert self.state.scene is not None  # there is a clip
        return self.state.scene

    def told(self) -> list[str]:
        """Say in words what could not be done, but for edits in the pad."""
        return [*self.state.told(), *([self.trouble] if self.trouble else [])]

    def do(self, result: Edited) -> None:
        """Go on with what came of an edit."""
        self._go_on()
        # Of a scene that comes from Python nobody knows how it was made.
        before = result.before or self.state.scene
        step = Step(result.code or FROM_PYTHON, before if result.code else None)
        self.state.do(result.label, result.scene, step, moved=result.moved)
        self.wake(result.selected)

    def step(self, back: bool) -> None:
        """Undo or redo."""
        self._go_on()
        if self.state.history is not None:
            _ = self.state.history.undo() if back else self.state.history.redo()
        self.wake()

    def edit(self, edit: dict[str, Any]) -> None:
        """Do what the pad tells of, and answer it; one that cannot be done is answered in words."""
        self._answered = int(edit.get("number", 0))
        kind = edit.get("kind")
        if kind in ("undo", "redo"):
            self.step(back=kind == "undo")
            return
        try:
            if kind == "turn" and edit.get("place") == BEST:
                self._want_pose(edit)
            else:
                self.do(self._revisions.edited(self.state, self.scene, edit))
        except Exception as error:  # the pad waits for an answer, whatever went wrong
            self.refusal = in_words(error)
            self.wake()

    def follow_clip(self) -> None:
        """Give up a trajectory that was drawn, deformed or retimed."""
        code = "scene = edits.follow_clip(scene)"
        self.do(Edited(edits.follow_clip(self.scene), "back to the clip's curve", code))

    def keep_feet(self, keep: bool) -> None:
        """Choose whether the feet are kept from sliding; refuse it where no feet are found."""
        scene = edits.set_keep_feet(self.scene, keep)
        play(scene, self.clip.space)
        label = "keep the feet" if keep else "let the feet slide"
        self.do(Edited(scene, label, f"scene = edits.set_keep_feet(scene, {keep})"))

    def set_kernel(self, kernel: str, epsilon: float | None = None) -> None:
        """Choose the radial function between key poses."""
        scene = edits.set_kernel(self.scene, kernel, epsilon)
        code = f"scene = edits.set_kernel(scene, {kernel!r}, {epsilon!r})"
        self.do(Edited(scene, f"radial function {kernel}", code, moved=True))

    def want_placing(self, source: Source) -> None:
        """Begin with key poses of a clip as the controls say."""
        self._go_on()
        controls = self.controls
        self.state.wanted = Placing(
            source,
            controls.selector.value,
            controls.count.value,
            controls.projector.value,
            controls.seed.value,
        )
        self.wake()

    def place_anew(self) -> None:
        """Place markers of the clip that is shown, or of the one that is being opened."""
        wanted, clip = self.state.wanted, self.state.clip
        if isinstance(wanted, Placing) and wanted.source not in self.state.failures:
            self.want_placing(reread(wanted.source))
        elif clip is not None:
            self.want_placing(reread(clip.source))

    def attempt(self, act: Callable[[], None]) -> None:
        """Do something, or say in words why it cannot be done."""
        try:
            act()
        except WorkbenchError as error:
            self.trouble = str(error)
            self.wake()

    def open_session(self, session: Session, path: str, *, uploaded: bool = False) -> None:
        """Go on with a session of a file; refuse it if its clip is here and is another one."""
        opening = opening_of(session, path, self.state.clip, uploaded=uploaded)
        clip = self.state.clip_of(opening.source)
        if clip is not None:
            session.check(clip.space.motion)
        self._go_on()
        if clip is None:
            self.state.wanted = opening
        else:
            self.state.open(opening, clip)
        self.wake()

    def recompute(self) -> None:
        """Compute what failed or was cancelled, or else let the optimizer run again."""
        self.controls.offer(self._methods.selectors.names(), self._methods.projectors.names())
        if not self.state.failures:
            self.state.ask_to_refine()
        self.state.failures.clear()
        self.wake()

    def stop(self) -> None:
        """End the process that computes."""
        self._background.stop()

    def wake(self, selected: int | None = None) -> None:
        """Show what there is, and compute what is missing."""
        self._show_scene(selected)
        self.worker.wake()

    def _go_on(self) -> None:
        """Forget what could not be done: the person does something else."""
        self.refusal = ""
        self.trouble = _POSE_DROPPED if self.state.drop_pose() else ""
        self.state.drop_failed()

    # Computing.

    def _want_pose(self, edit: dict[str, Any]) -> None:
        self._revisions.seen(self.state, edit)
        wanted = self.state.wanted
        if isinstance(wanted, (Placing, Opening)) and not self.state.has_failed(wanted):
            raise WorkbenchError("new pose: other markers are on the way: please wait for them")
        marker, joint, degrees = edit["marker"], edit["joint"], edit["angles"]
        edits.turn_joint(self.scene, marker, joint, degrees)  # refuses what cannot be done
        self._go_on()
        angles = tuple(map(float, degrees))
        self.state.wanted = Posing(self.clip.source, self.scene, marker, joint, angles)
        self.wake()

    def _prepared(self, job: Job) -> tuple[Job, Methods]:
        return (loaded_here(job) if isinstance(job, Source) else job), self._methods

    def _take(self, job: Job, result: Any) -> None:
        before = len(self.state.scene.markers) if self.state.scene is not None else 0
        self.state.take(job, result)
        selected = before if isinstance(job, Posing) else None
        self._show_scene(selected)

    def _report(self, text: str, done: float | None) -> None:
        self.view.progress.show(text, done or 0.0)

    # Showing.

    def _show_scene(self, selected: int | None = None) -> None:
        """Show the scene, as far as anything about it is new."""
        state = self.state
        if state.history is None or state.clip is None:
            return
        scene, played = state.history.scene, state.played
        kept = played if scene.keep_feet else None
        revision = self._revisions.show(scene)
        now = (scene, kept, self._answered, self.refusal)
        self._show_controls(scene)
        if now != self._shown or selected is not None:
            self._shown = now
            self.view.show(
                state.clip,
                state.history,
                roots=None if kept is None else kept.roots,
                answered=self._answered,
                revision=revision,
                selected=selected,
                message=self.refusal,
            )
            self.view.show_code(lambda: state.code)
        self.view.show_feet(state.clip, scene, played)

    def _show_controls(self, scene: Scene) -> None:
        own = edits.follow_clip(scene).trajectory
        same = scene.follows and np.array_equal(own.times, scene.trajectory.times)
        with self.controls.silence():
            self.controls.keep_feet.value = scene.keep_feet
            self.controls.kernel.value = scene.kernel
            self.controls.follow.disabled = same

    def _show(self) -> None:
        state = self.state
        self.view.progress.show_busy(self.worker.current is not None)
        self.view.show_message(state.clip, state.scene, state.refined, self.told())
        wanted = state.wanted
        if state.clip is not None and (wanted is None or wanted.source in state.failures):
            with self.controls.silence():
                self.controls.choose(state.clip.source)


def in_words(error: Exception) -> str:
    """Say what went wrong; what is not ours says its kind, too."""
    return str(error) if isinstance(error, WorkbenchError) else f"{type(error).__name__}: {error}"
