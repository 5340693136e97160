"""The authoring dashboard: new motions from the key poses of captured ones."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from workbench.authoring import Scene, play, read_session
from workbench.dashboards.authoring.controls import AuthorControls
from workbench.dashboards.authoring.edits import Edited
from workbench.dashboards.authoring.events import AuthorEvents
from workbench.dashboards.authoring.files import content, save
from workbench.dashboards.authoring.jobs import Errors, Methods
from workbench.dashboards.authoring.live import LiveAuthor
from workbench.dashboards.authoring.view import AuthorView
from workbench.dashboards.shared.sources import available, reread, source_of
from workbench.errors import WorkbenchError
from workbench.mocap.motion import Motion
from workbench.spaces import PoseSpace

Data = str | Path | PoseSpace


def author_motion(
    clip: Data = "cmu/01_01-jump",
    *,
    selector: str = "scs",
    count: int = 12,
    projector: str = "mds",
    random_state: int = 0,
) -> MotionAuthor:
    """Make a motion of key poses of a captured one, in a dashboard.

    Parameters
    ----------
    clip : str, path-like or PoseSpace
        A motion's name, a file's path, or a motion in memory.
    selector : str
        Name of the selector that chooses key poses.
    count : int
        How many, 3 to 60.
    projector : str
        Name of the projector that places them and all other frames, or "circle": they go on
        a circle in the order of time.
    random_state : int
        Seed of both.

    Returns
    -------
    MotionAuthor
        Shown by a notebook as the last expression of a cell.

    Raises
    ------
    WorkbenchError
        If an argument is not valid. A clip that cannot be loaded is told in the dashboard.
    """
    return MotionAuthor(
        clip, selector=selector, count=count, projector=projector, random_state=random_state
    )


class MotionAuthor:
    """A dashboard in which a motion is made from key poses on a plane.

    What takes long is computed beside the kernel; :meth:`finished` waits for that. Outside a
    notebook, where nothing could show progress, each change is computed before it returns.

    Parameters
    ----------
    clip, selector, count, projector, random_state
        As for :func:`author_motion`.

    Attributes
    ----------
    controls : AuthorControls
        What can be chosen.
    view : AuthorView
        What is shown; ``view.pad`` is the pad.
    """

    def __init__(
        self,
        clip: Data = "cmu/01_01-jump",
        *,
        selector: str = "scs",
        count: int = 12,
        projector: str = "mds",
        random_state: int = 0,
    ) -> None:
        self._methods = Methods()
        clips = [choice for choice in available() if choice.clip or choice.name == choice.text]
        self.controls = AuthorControls(
            clips, self._methods.selectors.names(), self._methods.projectors.names()
        )
        self.controls.set_placing(self._methods, selector, count, projector, random_state)
        source = source_of(clip)
        with self.controls.silence():
            self.controls.choose(source)
        self._live = LiveAuthor(self.controls, self._methods)
        self._events = AuthorEvents(self._live)
        self._live.want_placing(source)

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        self.controls.offer(self._methods.selectors.names(), self._methods.projectors.names())
        return self.view.root._repr_mimebundle_(**kwargs)

    # What a notebook reads.

    @property
    def view(self) -> AuthorView:
        """What is shown."""
        return self._live.view

    @property
    def scene(self) -> Scene:
        """Markers, trajectory and settings as they are; set it to change them.

        ``author.scene = edits.move_marker(author.scene, author.space, 0, [0.2, 0.4])``, with
        :mod:`workbench.authoring.edits`, does what dragging a marker does.

        Raises
        ------
        WorkbenchError
            If no clip is loaded, or a scene is set that does not fit it.
        """
        return self._live.scene

    @scene.setter
    def scene(self, scene: Scene) -> None:
        name = self._live.clip.source.name
        if scene.clip != name:
            raise WorkbenchError(f"scene: got one of clip {scene.clip!r}, want one of {name!r}")
        play(scene, self.space)  # refuses what does not fit the clip
        # A copy: a scene of the history has its own step there.
        self._live.do(Edited(replace(scene), "set from Python", ""))

    @property
    def space(self) -> PoseSpace:
        """The clip's poses.

        Raises
        ------
        WorkbenchError
            If no clip is loaded.
        """
        return self._live.clip.space

    @property
    def motion(self) -> Motion:
        """What plays: the poses along the trajectory, feet kept from sliding if that is chosen.

        Raises
        ------
        WorkbenchError
            If no clip is loaded.
        """
        return play(self.scene, self.space)

    @property
    def code(self) -> str:
        """A script that makes :attr:`scene` and :attr:`motion` again, edit by edit."""
        return self._live.state.code

    @property
    def refined(self) -> Errors | None:
        """Error before and after the optimizer; None if it did not run since the last edit."""
        return self._live.state.refined

    @property
    def message(self) -> str:
        """Why what was asked for is not shown; empty if it is."""
        live = self._live
        return "; ".join([*live.told(), *([live.refusal] if live.refusal else [])])

    # What a notebook and a person do.

    async def finished(self) -> None:
        """Wait until everything is computed: ``await author.finished()``."""
        await self._live.worker.finished()

    def open(self, clip: Data) -> None:
        """Begin with another clip; what is there now can be had back by undo.

        If the clip cannot be loaded, the message says why and nothing changes.
        """
        source = source_of(clip)
        with self.controls.silence():
            self.controls.choose(source)
        self._live.want_placing(source)

    def place(
        self,
        *,
        selector: str | None = None,
        count: int | None = None,
        projector: str | None = None,
        random_state: int | None = None,
    ) -> None:
        """Choose key poses of the clip and place them anew.

        Parameters
        ----------
        selector, count, projector, random_state
            As for :func:`author_motion`; by default as they were.

        Raises
        ------
        WorkbenchError
            If one is not valid, or no clip is loaded.
        """
        now = self.controls
        now.set_placing(
            self._methods,
            now.selector.value if selector is None else selector,
            now.count.value if count is None else count,
            now.projector.value if projector is None else projector,
            now.seed.value if random_state is None else random_state,
        )
        self._live.want_placing(reread(self._live.clip.source))

    def undo(self) -> None:
        """Take the last edit back."""
        self._live.step(back=True)

    def redo(self) -> None:
        """Make the edit that was taken back again."""
        self._live.step(back=False)

    def follow_clip(self) -> None:
        """Give up a trajectory that was drawn, deformed or retimed: play the clip's own."""
        self._live.follow_clip()

    def keep_feet(self, keep: bool = True) -> None:
        """Choose whether the feet are kept from sliding; refused where none are found."""
        self._live.keep_feet(keep)

    def set_kernel(self, kernel: str, epsilon: float | None = None) -> None:
        """Choose the radial function between key poses, by the names of ``RBF``.

        Raises
        ------
        WorkbenchError
            If there is no such function, or its width is not above 0.
        """
        self._live.set_kernel(kernel, epsilon)

    def cancel(self) -> None:
        """End what is being computed; what is there stays."""
        self._live.worker.cancel()

    def recompute(self) -> None:
        """Compute what failed or was cancelled, or else let the optimizer run again."""
        self._live.recompute()

    def save(self, path: str | Path) -> Path:
        """Write the session to a .json file, for :meth:`open_session`; replace one that exists."""
        return self._save(path, "session", ".json")

    def open_session(self, path: str | Path) -> None:
        """Go on with a session that was saved; what is there now can be had back by undo.

        Raises
        ------
        DataError
            If the file is damaged, or its clip is another one. Nothing changes then.
        """
        self._live.open_session(read_session(Path(path)), str(path))

    def export_bvh(self, path: str | Path) -> Path:
        """Write :attr:`motion` to a .bvh file; one that exists is replaced."""
        return self._save(path, "bvh", ".bvh")

    def export_html(self, path: str | Path, *, title: str = "", text: str = "") -> Path:
        """Write one .html file in which others scrub and play without Python.

        Parameters
        ----------
        path : path-like
            The file; one that exists is replaced.
        title, text : str
            Its heading, and words below it; by default those of the dashboard's fields.
        """
        return self._save(path, "html", ".html", title=title, text=text)

    def close(self) -> None:
        """End the process that computes, and take the dashboard out of the page."""
        self._live.stop()
        self.view.root.close()

    def _save(self, path: str | Path, want: str, ending: str, **words: str) -> Path:
        live = self._live
        return save(path, ending, lambda: content(want, live.clip, live.scene, live.view, **words))
