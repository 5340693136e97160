"""What the preparation of a study wants, what of it is there, and what failed."""

from __future__ import annotations

from workbench.dashboards.shared.sources import Source, reread, source_of
from workbench.dashboards.study.controls import StudyControls
from workbench.dashboards.study.jobs import Exercise, Job, Rebuilding
from workbench.errors import WorkbenchError
from workbench.study.answers import Stimulus
from workbench.study.design import StudyDesign
from workbench.study.stimuli import Method


class StudyPlan:
    """Derive jobs from the controls, and a study from their results.

    Parameters
    ----------
    controls : StudyControls
        What can be chosen.

    Attributes
    ----------
    methods : dict of str to Method
        Methods that have settings of their own, by the names under which they are listed.
    names : dict of str to str
        What tables call clips, by how the controls list them; others have their usual names.
    test_case : str
        The question that the stimuli belong to.
    failures : dict of Job to str
        Why jobs have no result, in plain words.
    """

    def __init__(self, controls: StudyControls) -> None:
        self.methods: dict[str, Method] = {}
        self.names: dict[str, str] = {}
        self.test_case = "methods"
        self.failures: dict[Job, str] = {}
        self._controls = controls
        self._results: dict[Job, tuple[Stimulus, ...]] = {}
        self._sources: dict[str, Source] = {}

    @property
    def items(self) -> list[tuple[Stimulus, ...]]:
        """What is to be shown, as far as it is there."""
        return [self._results[job] for job in self._rebuildings() if job in self._results]

    def jobs(self) -> list[Job]:
        """List what is wanted."""
        exercise = self._exercise()
        return [*self._rebuildings(), *([exercise] if exercise else [])]

    def missing(self) -> list[Job]:
        """List what is neither done nor failed."""
        return [job for job in self.jobs() if job not in self._results and job not in self.failures]

    def share_done(self) -> float:
        """Tell how much of what is wanted is done or failed, 0 to 1."""
        return 1.0 - len(self.missing()) / max(1, len(self.jobs()))

    def take(self, job: Job, result: tuple[Stimulus, ...]) -> None:
        """Keep a result."""
        self._results[job] = result

    def again(self) -> None:
        """Forget what failed, or everything if nothing did; files are read again."""
        # What failed of other settings is not what a person wants again.
        if not any(job in self.failures for job in self.jobs()):
            self._results.clear()
        self.failures.clear()
        self._sources = {name: reread(source) for name, source in self._sources.items()}

    def told(self) -> list[str]:
        """Say in words what failed, and what is still to be chosen."""
        told = []
        for job in self.jobs():
            words = self.failures.get(job, "")
            if words:
                name = job.source.name
                told.append(words if words.startswith(name) else f"{name}: {words}")
        told += self._alike()
        if not self._controls.names:
            told.append("Choose at least one clip.")
        if not self._controls.methods.value:
            told.append("Choose at least one method.")
        return told

    def design(self) -> StudyDesign:
        """Put the study together.

        Raises
        ------
        WorkbenchError
            If something is missing or failed.
        """
        told = self.told()
        if told or self.missing():
            raise WorkbenchError("; ".join(told) or "the stimuli are still being made")
        exercise = self._exercise()
        return StudyDesign(
            tuple(stimulus for item in self.items for stimulus in item),
            practice=self._results[exercise] if exercise else (),
            seed=self._controls.seed.value,
            title=self._controls.title.value.strip() or StudyDesign.title,
        )

    def _alike(self) -> list[str]:
        """Say which clips tables would call the same."""
        clips: dict[str, list[str]] = {}
        for original, *_ in self.items:
            clips.setdefault(original.motion, []).append(str(original.parameters["clip"]))
        return [
            f"{' and '.join(paths)}: would both be called {name}, want names of their own: "
            "rename a file."
            for name, paths in clips.items()
            if len(paths) > 1
        ]

    def _rebuildings(self) -> list[Rebuilding]:
        controls = self._controls
        methods = tuple(self.methods.get(n, Method.of(n)) for n in controls.methods.value)
        if not methods:
            return []
        return [
            Rebuilding(
                self._source(name),
                methods,
                count=controls.wanted_count,
                ratio=controls.wanted_ratio,
                seconds=controls.wanted_seconds,
                seed=controls.seed.value,
                test_case=self.test_case,
                name=self.names.get(name, ""),
            )
            for name in controls.names
        ]

    def _exercise(self) -> Exercise | None:
        name = self._controls.exercise.value
        return Exercise(self._source(name), self._controls.wanted_seconds) if name else None

    def _source(self, name: str) -> Source:
        # Kept, because what is only registered here is a new source each time.
        if name not in self._sources:
            self._sources[name] = source_of(name)
        return self._sources[name]
