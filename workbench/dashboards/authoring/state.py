"""What the authoring dashboard holds: every scene so far, what is wanted, and what failed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any
from weakref import WeakKeyDictionary, WeakSet

import numpy as np

from workbench.authoring import History, Scene
from workbench.dashboards.authoring.code import REFINED, placing_code, posing_code, script
from workbench.dashboards.authoring.jobs import (
    Clip,
    Errors,
    Job,
    Placing,
    Played,
    Posing,
    Refined,
    Refining,
    Rendering,
)
from workbench.dashboards.shared.sources import Source
from workbench.mocap.motion import Motion


@dataclass(frozen=True, eq=False)
class Step:
    """How a scene was made.

    Attributes
    ----------
    code : str
        A line of a script or more; empty if there is none.
    before : Scene or None
        The scene that it was made of; None if it was made of none.
    """

    code: str
    before: Scene | None


@dataclass(frozen=True, eq=False)
class Opening:
    """A session that waits for its clip.

    Attributes
    ----------
    source : Source
        The clip.
    scene : Scene
        What was saved.
    check : callable
        Refuses a motion that is not the session's clip.
    label : str
        What undoing it is called.
    step : Step
        How the scene was made.
    """

    source: Source
    scene: Scene
    check: Callable[[Motion], None]
    label: str
    step: Step


class AuthorState:
    """Keep scenes with their clips, and derive jobs from what is wanted.

    Attributes
    ----------
    history : History or None
        All scenes; None before the first.
    wanted : Placing, Posing, Opening or None
        What will give the next scene.
    refines : bool
        Whether the optimizer follows RBFP.
    failures : dict of Job to str
        Why jobs have no result, in plain words.
    """

    def __init__(self) -> None:
        self.history: History | None = None
        self.wanted: Placing | Posing | Opening | None = None
        self.refines = True
        self.failures: dict[Job, str] = {}
        self._loaded: Clip | None = None
        self._clips: WeakKeyDictionary[Scene, Clip] = WeakKeyDictionary()
        self._unrefined: WeakSet[Scene] = WeakSet()
        # Of the scene that is shown only: there is a root for each frame of it.
        self._played: tuple[Scene, Played] | None = None
        self._steps: WeakKeyDictionary[Scene, Step] = WeakKeyDictionary()
        self._refined: WeakKeyDictionary[Scene, Errors] = WeakKeyDictionary()

    @property
    def scene(self) -> Scene | None:
        """What is shown."""
        return None if self.history is None else self.history.scene

    @property
    def clip(self) -> Clip | None:
        """The clip of what is shown."""
        return None if self.scene is None else self._clips[self.scene]

    @property
    def played(self) -> Played | None:
        """What the motion of the scene is like, if it is known."""
        known = self._played is not None and self._played[0] is self.scene
        return self._played[1] if self._played is not None and known else None

    @property
    def refined(self) -> Errors | None:
        """What the optimizer was good for, if it placed the frames of the scene."""
        return None if self.scene is None else self._refined.get(self.scene)

    @property
    def code(self) -> str:
        """A script that makes the scene and its motion again; empty if there is no scene."""
        scene, clip, steps = self.scene, self.clip, list[str]()
        if scene is None or clip is None:
            return ""
        while scene is not None:
            step = self._steps[scene]
            steps.append(step.code)
            scene = step.before
        return script(clip.source, reversed(steps))

    def optimized_since(self, before: Scene) -> int | None:
        """Count the optimizer's results since a scene; None if something else came between."""
        count, scene = 0, self.scene
        while scene is not None and scene is not before:
            step = self._steps[scene]
            if step.code != REFINED:
                return None
            count, scene = count + 1, step.before
        return None if scene is None else count

    # Scenes.

    def do(
        self, label: str, scene: Scene, step: Step, *, clip: Clip | None = None, moved: bool
    ) -> None:
        """Add a scene after the present one.

        Parameters
        ----------
        label : str
            What undoing it is called.
        scene : Scene
            The scene.
        step : Step
            How it was made.
        clip : Clip, optional
            Its clip; by default that of the present scene.
        moved : bool
            Whether markers have changed, so that the frames between them can be placed better.
        """
        before = self.scene
        found = clip or self.clip
        assert found is not None  # a scene without a clip is never made
        self._clips[scene], self._steps[scene] = found, step
        if moved or (before in self._unrefined and _same_places(scene, before)):
            self._unrefined.add(scene)
        if self.history is None:
            self.history = History(scene)
        else:
            self.history.do(label, scene)
        self.drop_pose()
        self.drop_failed()

    def open(self, opening: Opening, clip: Clip) -> None:
        """Add the scene of a session, whose clip was checked, after the present one."""
        self.do(opening.label, opening.scene, opening.step, clip=clip, moved=False)

    def ask_to_refine(self) -> None:
        """Let the optimizer place the frames of the present scene, whether or not it did."""
        if self.scene is not None:
            self._unrefined.add(self.scene)

    def drop_failed(self) -> None:
        """Forget what could not be done: the person has gone on to something else."""
        if self.wanted is not None and self.has_failed(self.wanted):
            self.wanted = None
        self.failures.clear()

    def has_failed(self, wanted: Placing | Posing | Opening) -> bool:
        """Tell whether what is wanted, or loading its clip, could not be done."""
        return wanted in self.failures or wanted.source in self.failures

    def drop_pose(self) -> bool:
        """Give up a new pose whose place is not known yet; tells whether there was one."""
        if not isinstance(self.wanted, Posing):
            return False
        waited = self.wanted not in self.failures
        self.wanted = None
        return waited

    def clip_of(self, source: Source) -> Clip | None:
        """Give a clip that is in memory."""
        known = [self._loaded, self.clip]
        return next((clip for clip in known if clip is not None and clip.source == source), None)

    # Jobs.

    def missing(self) -> list[Job]:
        """List what is neither done nor failed, the next scene first."""
        return [job for job in self._jobs() if job not in self.failures]

    def take(self, job: Job, result: Any) -> None:
        """Keep a result."""
        if isinstance(job, Source):
            self._loaded = result
            if isinstance(self.wanted, Opening):
                opening, self.wanted = self.wanted, None
                opening.check(result.space.motion)
                self.open(opening, result)
        elif isinstance(job, (Placing, Posing)):
            self.wanted = None
            self._begin(job, _frozen(result))
        elif isinstance(job, Rendering):
            self._played = job.scene, result
        elif job.scene is self.scene and self.history is not None:
            self._amend(job.scene, result)

    def told(self) -> list[str]:
        """Say in words what failed, and what is shown nevertheless."""
        shown = f"; still shown: {self.clip.source.name}" if self.clip else ""
        told = []
        for job, failure in self.failures.items():
            if isinstance(job, Source):
                words = failure if failure.startswith(job.name) else f"{job.name}: {failure}"
                if isinstance(self.wanted, Opening):
                    words += "; open the session's clip first if it is elsewhere now"
                told.append(words + shown)
            elif isinstance(job, Placing):
                told.append(f"placing markers: {failure}" + "; shown as before" * bool(shown))
            elif isinstance(job, Posing):
                told.append(f"placing the new pose: {failure}")
            elif isinstance(job, Refining) and job.scene is self.scene:
                told.append(f"optimizing: {failure}; in-between frames stay where RBFP put them")
            elif isinstance(job, Rendering) and job.scene is self.scene:
                told.append(f"speed of the feet: {failure}")
        return told

    def _jobs(self) -> list[Job]:
        jobs: list[Job] = []
        wanted, scene, clip = self.wanted, self.scene, self.clip
        if wanted is not None:
            if isinstance(wanted, Posing):
                # A new pose belongs to the scene in which it was made: better places of its
                # frames, which would make another one, have to wait.
                if wanted not in self.failures:
                    return [wanted]
            elif self.clip_of(wanted.source) is None:
                jobs.append(wanted.source)
            elif isinstance(wanted, Placing):
                jobs.append(wanted)
        if scene is None or clip is None:
            return jobs
        if self.played is None:
            jobs.append(Rendering(clip.source, scene))
        if self.refines and scene in self._unrefined:
            jobs.append(Refining(clip.source, scene))
        return jobs

    def _begin(self, job: Placing | Posing, scene: Scene) -> None:
        if isinstance(job, Posing):
            step = Step(posing_code(job), job.scene)
            self.do("new pose", scene, step, moved=True)
            return
        label = f"place {job.count} markers by {job.projector}"
        if self.clip is None or self.clip.source != job.source:
            label = f"open {job.source.name}"
        step = Step(placing_code(job), None)
        self.do(label, scene, step, clip=self.clip_of(job.source), moved=False)

    def _amend(self, before: Scene, result: Refined) -> None:
        assert self.history is not None  # whoever calls has looked
        scene = before.laid_out(before.markers, result.embedding)
        self._clips[scene] = self._clips[before]
        self._steps[scene] = Step(REFINED, before)
        self._refined[scene] = result.errors
        self.history.amend(scene)


def _same_places(scene: Scene, before: Scene | None) -> bool:
    return before is not None and np.array_equal(scene.embedding, before.embedding)


def _frozen(scene: Scene) -> Scene:
    """Make arrays of a scene that came from another process read-only again."""
    return replace(
        scene,
        markers=tuple(replace(marker) for marker in scene.markers),
        trajectory=replace(scene.trajectory),
    )
