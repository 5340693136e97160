"""What the authoring dashboard computes beside the kernel."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.authoring import (
    best_place,
    edits,
    foot_slide,
    influence,
    play,
    refined,
    scene_from_clip,
    scene_on_circle,
)
from workbench.authoring.scene import Scene
from workbench.dashboards.authoring.jobs import (
    CIRCLE,
    Clip,
    Errors,
    Job,
    Methods,
    Placing,
    Played,
    Posing,
    Refined,
    Refining,
    Rendering,
)
from workbench.dashboards.shared.background import Report
from workbench.dashboards.shared.remarks import said_by_warnings
from workbench.dashboards.shared.sources import Source, load_source
from workbench.errors import WorkbenchError
from workbench.spaces import PoseSpace


class AuthorSession:
    """Do the authoring dashboard's jobs, remembering the clip."""

    def __init__(self) -> None:
        self._source: Source | None = None
        self._space: PoseSpace | None = None

    def answer(self, job: Job, methods: Methods, *, report: Report) -> Any:
        """Do a job; see :mod:`workbench.dashboards.authoring.jobs` for what each gives."""
        if isinstance(job, Source):
            return Clip(job, self._load(job, report))
        if isinstance(job, Placing):
            return self.place(job, methods, report=report)
        if isinstance(job, Refining):
            return self.refine(job, report=report)
        if isinstance(job, Posing):
            return self.pose(job, report=report)
        return self.play(job, report=report)

    def place(self, job: Placing, methods: Methods, *, report: Report) -> Scene:
        """Begin a scene: choose key poses and place them."""
        space = self._load(job.source, report)
        report(f"{job.count} key poses by {job.selector}, placed by {job.projector}", 0.2)
        arguments: dict[str, Any] = {
            "selector": methods.selectors.create(job.selector),
            "count": job.count,
            "random_state": job.seed,
        }
        with said_by_warnings():
            if job.projector == CIRCLE:
                scene = scene_on_circle(space, job.source.name, **arguments)
            else:
                projector = methods.projectors.create(job.projector)
                scene = scene_from_clip(space, job.source.name, projector=projector, **arguments)
        # The kernel needs it for each drag; the first time on a machine it is compiled here.
        influence(space, scene.markers)
        return scene

    def refine(self, job: Refining, *, report: Report) -> Refined:
        """Optimize the places of the frames between markers."""
        space = self._load(job.source, report)

        def follow(iteration: int, error: float, embedding: NDArray[np.float64]) -> None:  # noqa: ARG001 - the optimizer's signature
            # How many are to come is not known; most frames rest within twenty.
            report(f"optimizing in-between frames, iteration {iteration}", 1.0 - 0.9**iteration)

        with said_by_warnings():
            result = refined(job.scene, space, callback=follow)
        return Refined(result.scene.embedding, Errors(result.before, result.after))

    def pose(self, job: Posing, *, report: Report) -> Scene:
        """Turn a joint and place the new pose where it fits best."""
        space = self._load(job.source, report)
        report("placing the new pose", None)
        marker = job.scene.markers[job.marker]
        pose = edits.turned(marker.rotations, job.joint, job.degrees)
        with said_by_warnings():
            place = best_place(job.scene, space, pose, marker.position)
        return edits.add_pose(job.scene, pose, marker.root, place)

    def play(self, job: Rendering, *, report: Report) -> Played:
        """Play a scene, and measure how fast the supporting foot is."""
        space = self._load(job.source, report)
        report("measuring the feet", None)
        return played(job.scene, space)

    def _load(self, source: Source, report: Report) -> PoseSpace:
        if self._space is None or source != self._source:
            report(f"loading {source.name}", None)
            space, _ = load_source(source)
            if not isinstance(space, PoseSpace):
                raise WorkbenchError(f"{source.name}: got a table, want a motion")
            self._source, self._space = source, space
        return self._space


def played(scene: Scene, space: PoseSpace) -> Played:
    """Play a scene of a clip, and measure how fast the supporting foot is."""
    roots = play(scene, space).root_translation
    try:
        return Played(roots, foot_slide(scene, space), "")
    except WorkbenchError as error:
        return Played(roots, None, f"no speed of the feet: {error}")
