"""The preparation of a user study: what is shown, and the file in which answers are gathered."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from workbench.dashboards.inspection.jobs import Selectors
from workbench.dashboards.shared.background import Background
from workbench.dashboards.shared.home import Home
from workbench.dashboards.shared.sources import available, loaded_here
from workbench.dashboards.shared.worker import Worker
from workbench.dashboards.study.controls import StudyControls
from workbench.dashboards.study.files import study_path
from workbench.dashboards.study.jobs import Job, StudySession
from workbench.dashboards.study.plan import StudyPlan
from workbench.dashboards.study.preparation_view import PreparationView
from workbench.errors import WorkbenchError
from workbench.study.design import StudyDesign, store_design
from workbench.study.stimuli import Method
from workbench.validation import whole_number

_CLIPS = ("cmu/01_01-jump", "cmu/01_03-walk", "cmu/01_03-swing")
Clips = Sequence[str | Path] | Mapping[str, str | Path]

_METHODS = ("saliency", "scs", "uniform")


def prepare_study(
    clips: Clips = _CLIPS,
    methods: Sequence[str | Method] = _METHODS,
    *,
    test_case: str = "methods",
    count: int | None = None,
    ratio: float | None = None,
    seconds: float | None = None,
    exercise: str | Path | None = "cmu/01_01-turn",
    title: str = StudyDesign.title,
    file: str | Path = "study",
    random_state: int = 0,
) -> StudyPreparation:
    """Prepare a user study in a dashboard.

    Parameters
    ----------
    clips : sequence of str or path-like, or mapping of str to these
        Data sets' names or files' paths; a mapping tells what tables are to call them.
    methods : sequence of str or Method
        Selectors' names, or selectors with settings and a name of their own.
    test_case : str
        What tables call the question that is asked.
    count, ratio : int or float, at most one
        How many keyframes each method gets, or which share of the frames; neither for as many
        as the saliency method finds.
    seconds : float, optional
        Show only so much of each clip.
    exercise : str or path-like, optional
        The clip to practise on; None for no exercise.
    title : str
        What participants are told that it is about.
    file : str or path-like
        What the study's file is called. A name without a folder lies in ``workbench-studies``
        in the home folder, or where ``WORKBENCH_STUDIES`` says.
    random_state : int
        Seed of participants' orders and of methods that draw at random.

    Returns
    -------
    StudyPreparation
        Shown by a notebook as the last expression of a cell.

    Raises
    ------
    WorkbenchError
        If an argument is not valid. A clip that cannot be loaded is told in the dashboard.
    """
    return StudyPreparation(
        clips,
        methods,
        test_case=test_case,
        count=count,
        ratio=ratio,
        seconds=seconds,
        exercise=exercise,
        title=title,
        file=file,
        random_state=random_state,
    )


class StudyPreparation:
    """A dashboard in which a study is prepared.

    Stimuli are made beside the kernel; :meth:`finished` waits for them. Outside a notebook each
    change is computed before it returns.

    Parameters
    ----------
    clips, methods, test_case, count, ratio, seconds, exercise, title, file, random_state
        As for :func:`prepare_study`.

    Attributes
    ----------
    controls : StudyControls
        What can be chosen.
    view : PreparationView
        What is shown.
    """

    def __init__(
        self,
        clips: Clips = _CLIPS,
        methods: Sequence[str | Method] = _METHODS,
        *,
        test_case: str = "methods",
        count: int | None = None,
        ratio: float | None = None,
        seconds: float | None = None,
        exercise: str | Path | None = "cmu/01_01-turn",
        title: str = StudyDesign.title,
        file: str | Path = "study",
        random_state: int = 0,
    ) -> None:
        self._selectors = Selectors()
        listed = [choice for choice in available() if choice.clip]
        self.controls = StudyControls(listed, self._selectors.registry.names())
        self._plan = StudyPlan(self.controls)
        self._choose_methods(methods)
        named = clips if isinstance(clips, Mapping) else {}
        self._plan.names = {str(clip): name for name, clip in named.items()}
        self._plan.test_case = test_case
        self.controls.choose([str(clip) for clip in (named.values() if named else clips)])
        self.controls.choose_exercise(None if exercise is None else str(exercise))
        self.controls.set_count(count, ratio)
        self.controls.seconds.value = seconds or 0.0
        self.controls.title.value = title
        self.controls.file.value = str(study_path(file))
        self.controls.seed.value = whole_number("random_state", random_state, at_least=0)
        self.view = PreparationView(self.controls)
        self._background = Background(StudySession)
        self._worker: Worker[Job] = Worker(
            self._background,
            missing=self._plan.missing,
            failures=self._plan.failures,
            prepare=self._prepared,
            done=self._plan.take,
            changed=self._show,
            report=self._report,
        )
        self._connect()
        self._worker.wake()

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        return self.view.root._repr_mimebundle_(**kwargs)

    @property
    def design(self) -> StudyDesign:
        """The study as it would be stored now.

        Raises
        ------
        WorkbenchError
            If something is missing or failed.
        """
        return self._plan.design()

    @property
    def message(self) -> str:
        """Why there is no study to store yet; empty if there is."""
        return "; ".join(self._plan.told())

    async def finished(self) -> None:
        """Wait until all stimuli are made: ``await preparation.finished()``."""
        await self._worker.finished()

    def save(self, file: str | Path | None = None) -> Path:
        """Make the file of the study, in which answers are then gathered.

        Parameters
        ----------
        file : str or path-like, optional
            Its name or path; by default what the dashboard shows. One that is there is kept.

        Raises
        ------
        WorkbenchError
            If the study is not complete, or the file is there already or cannot be written.
        """
        path = study_path(self.controls.file.value if file is None else file)
        design = self.design
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise WorkbenchError(f"{path}: cannot be written ({error.strerror})") from None
        store_design(path, design)
        return path

    def close(self) -> None:
        """End the process that computes, and take the dashboard out of the page."""
        self._background.stop()
        self.view.root.close()

    # Making.

    def _choose_methods(self, methods: Sequence[str | Method]) -> None:
        chosen = [Method.of(method) for method in methods]
        for method in chosen:
            self._selectors.registry.factory(method.selector)  # refuses what is unknown
        own = [method for method in chosen if method != Method.of(method.selector)]
        self._plan.methods = {method.name: method for method in own}
        listed = [*self._selectors.registry.names(), *self._plan.methods]
        self.controls.methods.options = list(dict.fromkeys(listed))
        self.controls.methods.value = [method.name for method in chosen]

    def _prepared(self, job: Job) -> tuple[Job, Selectors]:
        if job.source.registered:
            loaded_here(job.source)  # says what is wrong with a name that nobody knows
            raise WorkbenchError(
                f"{job.source.name}: is known to this notebook only, want a data set or a file "
                "that the participants' page finds, too"
            )
        return job, self._selectors

    # Showing.

    def _report(self, text: str, done: float | None) -> None:
        part = (done or 0.0) / max(1, len(self._plan.jobs()))
        self.view.progress.show(text, min(1.0, self._plan.share_done() + part))

    def _show(self) -> None:
        told = self._plan.told()
        ready = not told and not self._plan.missing()
        self.view.progress.show_busy(self._worker.current is not None)
        self.view.show(self._plan.items, told, self.design if ready else None)

    # What a person does.

    def _connect(self) -> None:
        here = Home().here
        self.controls.on_settings(here(self._on_settings))
        self.controls.save.on_click(here(lambda _: self._on_save()))
        self.view.progress.cancel.on_click(here(lambda _: self._worker.cancel()))
        self.view.progress.again.on_click(here(lambda _: self._on_again()))

    def _on_settings(self) -> None:
        self.view.saved.value = ""
        self._worker.wake()

    def _on_again(self) -> None:
        self._plan.again()
        self._worker.wake()

    def _on_save(self) -> None:
        try:
            path = self.save()
        except WorkbenchError as error:
            self.view.show_failure(str(error))
        else:
            self.view.show_saved(path)
