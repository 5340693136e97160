"""What the preparation of a study computes beside the kernel."""

from __future__ import annotations

from dataclasses import dataclass

from workbench.dashboards.inspection.jobs import Selectors
from workbench.dashboards.shared.background import Report
from workbench.dashboards.shared.sources import Source, load_source
from workbench.errors import WorkbenchError
from workbench.spaces import PoseSpace
from workbench.study.answers import Stimulus
from workbench.study.stimuli import Clip, Method, make_stimuli, practice_stimuli


@dataclass(frozen=True)
class Rebuilding:
    """A clip as the methods rebuild it. Gives a tuple of Stimulus.

    Attributes
    ----------
    source : Source
        The clip.
    methods : tuple of Method
        How keyframes are chosen.
    count : int or None
        How many; None for ``ratio``.
    ratio : float or None
        Which share of the frames; both None for as many as the saliency method finds.
    seconds : float or None
        How much of the clip is shown; None for all.
    seed : int
        Of methods that draw at random.
    test_case : str
        The question that the stimuli belong to.
    name : str
        What tables call the clip; empty for its usual name.
    """

    source: Source
    methods: tuple[Method, ...]
    count: int | None
    ratio: float | None
    seconds: float | None
    seed: int
    test_case: str
    name: str = ""


@dataclass(frozen=True)
class Exercise:
    """A clip to practise on. Gives a tuple of Stimulus.

    Attributes
    ----------
    source : Source
        The clip.
    seconds : float or None
        How much of it is shown; None for all.
    """

    source: Source
    seconds: float | None


Job = Rebuilding | Exercise


class StudySession:
    """Do the jobs of a preparation."""

    def answer(self, job: Job, methods: Selectors, *, report: Report) -> tuple[Stimulus, ...]:
        """Make the stimuli of a clip.

        Raises
        ------
        WorkbenchError
            If it is no motion, or a method fails.
        """
        source = job.source
        report(f"loading {source.name}", 0.0)
        space, _ = load_source(source)
        if not isinstance(space, PoseSpace):
            raise WorkbenchError(f"{source.name}: got a table, want a motion")
        name = job.name if isinstance(job, Rebuilding) else ""
        clip = Clip.from_start(source.name, space.motion, job.seconds, name)
        report(f"choosing keyframes of {source.name}", 0.2)
        if isinstance(job, Exercise):
            return practice_stimuli(clip)
        return make_stimuli(
            clip,
            job.methods,
            count=job.count,
            ratio=job.ratio,
            test_case=job.test_case,
            random_state=job.seed,
            selectors=methods.registry,
        )
