"""The projection comparison: embeddings of the same samples side by side."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.dashboards.arguments import (
    Settings,
    checked_moves,
    checked_panels,
    checked_selection,
)
from workbench.dashboards.background import Background
from workbench.dashboards.code_cell import comparison_code
from workbench.dashboards.comparison_view import ComparisonView
from workbench.dashboards.controls import Controls
from workbench.dashboards.exports import comparison_page, results_table
from workbench.dashboards.jobs import Job, Methods, PanelResult
from workbench.dashboards.panels import Panel
from workbench.dashboards.plan import Plan
from workbench.dashboards.session import Session
from workbench.dashboards.sources import (
    Source,
    available,
    loaded_here,
    reread,
    source_of,
    standardized,
)
from workbench.dashboards.worker import Worker
from workbench.errors import WorkbenchError
from workbench.files import write_atomically
from workbench.spaces import Space

if TYPE_CHECKING:
    import pandas as pd

Data = str | Path | Space | Sequence[str | Path | Space]


def compare_projections(
    data: Data = "uci/iris",
    panels: Sequence[str | Panel] = ("pca", "tsne"),
    *,
    standardize: bool = False,
    label: str | None = None,
    ratio: float = 0.03,
    random_state: int = 0,
    back_projector: str | None = None,
    color_by: str | None = None,
    selection: ArrayLike = (),
    moved: Mapping[str, ArrayLike] | None = None,
    repeat: int = 1,
) -> ProjectionComparison:
    """Compare projections of a data set or of motions in a dashboard.

    Parameters
    ----------
    data : str, path-like, Space, or a sequence of them
        A data set's name, a file's path, or samples in memory; several clips of one skeleton
        are shown on one map.
    panels : sequence of str or Panel
        One to six projectors by name; ``Panel("tsne", {"perplexity": 10}, optimized=True)``
        for parameters and for the optimized embedding.
    standardize : bool
        Whether to standardise the columns of a table.
    label : str, optional
        The column of a table of your own that holds the classes.
    ratio : float
        Share of control points, 0.01 to 0.5.
    random_state : int
        Seed of the choice of control points and of the projectors.
    back_projector : str, optional
        A registered name; by default spatial keyframes for motions and RBF for tables.
    color_by : {"class", "time", "none"} or a local quality, optional
        What colours stand for: the qualities are "stress", "trustworthiness", "continuity",
        "neighbourhood preservation" and "reconstruction error" of each sample. By default what
        suits the samples.
    selection : array-like of shape (n_selected,)
        Indices of samples to select.
    moved : mapping of str to array-like of shape (n_control_points, 2), optional
        Where to move control points of panels, by letter.
    repeat : int
        Over how many seeds the quality is measured, to show its spread.

    Returns
    -------
    ProjectionComparison
        Shown by a notebook as the last expression of a cell.

    Raises
    ------
    WorkbenchError
        If an argument is not valid. Data that cannot be loaded are told in the dashboard.
    """
    settings = Settings(
        standardize=standardize,
        label=label,
        ratio=ratio,
        random_state=random_state,
        back_projector=back_projector,
        color_by=color_by,
        selection=selection,
        moved=moved or {},
        repeat=repeat,
    )
    return ProjectionComparison(data, panels, settings)


class ProjectionComparison:
    """A dashboard with one to six embeddings of the same samples.

    It computes beside the kernel; :meth:`finished` waits for that. Outside a notebook, where
    nothing could show progress, each change is computed before it returns.

    Parameters
    ----------
    data, panels
        As for :func:`compare_projections`.
    settings : Settings, optional
        Its other arguments.

    Attributes
    ----------
    controls : Controls
        What can be chosen.
    view : ComparisonView
        What is shown.
    """

    def __init__(
        self,
        data: Data = "uci/iris",
        panels: Sequence[str | Panel] = ("pca", "tsne"),
        settings: Settings | None = None,
    ) -> None:
        settings = settings or Settings()
        chosen = checked_panels(panels)
        source = source_of(data, settings.label, settings.standardize)
        self._methods = Methods()
        self.controls = Controls(
            available(),
            self._methods.projectors.names(),
            self._methods.back_projectors.names(),
            chosen,
            settings.color_by,
        )
        self._set_up(settings)
        self.view = ComparisonView(self.controls)
        self._plan = Plan(source, self.controls)
        self._plan.moves.expect(checked_moves(settings.moved))
        self._expected_selection = checked_selection(settings.selection)
        self._quiet = False
        self._background = Background(Session)
        self._worker: Worker[Job] = Worker(
            self._background,
            missing=self._plan.missing,
            failures=self._plan.failures,
            prepare=self._prepared,
            done=self._take,
            changed=self._show,
            report=self._report,
        )
        self._show_choice()
        self._connect()
        self._worker.wake()

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        self._offer()
        return self.view.root._repr_mimebundle_(**kwargs)

    @property
    def selection(self) -> NDArray[np.int32]:
        """Sorted indices of the selected samples; set it to mark others."""
        selected: NDArray[np.int32] = self.view.scatter.selection
        return selected

    @selection.setter
    def selection(self, samples: ArrayLike) -> None:
        indices = checked_selection(samples)
        limit = self._plan.summary.n_samples if self._plan.summary else 0
        if indices.size and indices.max() >= limit:
            raise WorkbenchError(
                f"selection: got index {indices.max()}, want indices below {limit}"
                if limit
                else "selection: got indices before there are data to select from"
            )
        self.view.scatter.selection = indices

    @property
    def moved(self) -> dict[str, NDArray[np.float32]]:
        """Positions of control points that were moved, by the letters of panels.

        Each of shape (n_control_points, 2), in the order of the results' ``control_points``.
        Set it to move others; empty puts all back.
        """
        moves = {
            letter: self._plan.moves.of(letter, run) for letter, run in self._plan.runs.items()
        }
        return {letter: move.places for letter, move in moves.items() if move is not None}

    @moved.setter
    def moved(self, moved: Mapping[str, ArrayLike]) -> None:
        places = checked_moves(moved)
        plan = self._plan
        plan.moves.forget()
        plan.moves.expect(places)
        n_control = len(plan.control_points)
        for letter, run in plan.runs.items() if n_control else ():
            plan.moves.settle(letter, run, n_control)
        self._worker.wake()

    @property
    def results(self) -> dict[str, PanelResult]:
        """What the panels show, by their letters, as far as it is there."""
        return self._plan.results

    @property
    def message(self) -> str:
        """Why the data that were asked for are not shown; empty if they are."""
        return self._plan.failures.get(self._plan.wanted, "")

    @property
    def code(self) -> str:
        """The code of a cell that makes this view again."""
        controls = self.controls
        plan = self._plan
        source = plan.source if plan.source is not None and self.message else plan.wanted
        rounded = {
            letter: [[round(float(x), 6) for x in place] for place in places]
            for letter, places in self.moved.items()
        }
        settings = {
            "standardize": source.standardize,
            "label": source.label,
            "ratio": round(controls.ratio.value, 4),
            "random_state": controls.seed.value,
            "back_projector": controls.back_projector.value or None,
            "color_by": controls.color_by.value,
            "selection": self.selection.tolist() or (),
            "moved": rounded,
            "repeat": controls.n_repeats,
        }
        return comparison_code(source, controls.panels, settings, vars(Settings()))

    async def finished(self) -> None:
        """Wait until everything is computed: ``await dashboard.finished()``."""
        await self._worker.finished()

    def open(self, data: Data, label: str | None = None) -> None:
        """Show other data; those shown now stay if the new ones cannot be loaded.

        Parameters
        ----------
        data : str, path-like, Space, or a sequence of them
            As for :func:`compare_projections`.
        label : str, optional
            The column of a table of your own that holds the classes.
        """
        self._want(source_of(data, label, self.controls.standardize.value))

    def cancel(self) -> None:
        """End what is being computed; panels that are complete stay."""
        self._worker.cancel()

    def recompute(self) -> None:
        """Compute what failed or was cancelled, or everything anew if nothing did.

        A file that was edited meanwhile is read again.
        """
        self._offer()
        plan = self._plan
        wanted = reread(plan.wanted)
        if not plan.failures and wanted == plan.wanted:
            plan.forget()
        plan.failures.clear()
        plan.wanted = wanted
        self._worker.wake()

    def to_frame(self) -> pd.DataFrame:
        """Put positions and qualities of the samples in a table, one row for each.

        Returns
        -------
        pandas.DataFrame
            Columns ``sample``, ``class``, ``selected``, ``control point``, and for each panel
            its coordinates and local qualities.

        Raises
        ------
        WorkbenchError
            If there are no data.
        """
        if self._plan.summary is None:
            raise WorkbenchError("data: got none so far, want some to write")
        return results_table(self._plan.summary, self.results, self.selection)

    def save_csv(self, path: str | Path) -> Path:
        """Write the table of :meth:`to_frame` to a file; one that exists is replaced."""
        text = self.to_frame().to_csv(index=False)
        write_atomically(Path(path), text.encode())
        return Path(path)

    def save_html(self, path: str | Path) -> Path:
        """Write the views to one HTML file that stays interactive without a kernel."""
        page = comparison_page(self.view, self._plan.summary)
        write_atomically(Path(path), page.encode())
        return Path(path)

    def close(self) -> None:
        """End the process that computes, and take the dashboard out of the page."""
        self._background.stop()
        self.view.root.close()

    # Computing.

    def _want(self, source: Source) -> None:
        self._plan.failures.pop(source, None)
        self._plan.wanted = source
        self._show_choice()
        self._worker.wake()

    def _prepared(self, job: Job) -> tuple[Job, Methods]:
        return (loaded_here(job) if isinstance(job, Source) else job), self._methods

    def _take(self, job: Job, result: Any) -> None:
        self._plan.take(job, result)
        if isinstance(job, Source):
            given = job.space is not None and not job.registered
            self.controls.suit(result, may_standardize=not (given or result.body))
            with self._silence():
                self.view.show_samples(result)
            expected, self._expected_selection = self._expected_selection, np.empty(0, int)
            self.view.scatter.selection = expected[expected < result.n_samples]
        self._plan.describe()

    def _report(self, text: str, done: float | None) -> None:
        job, jobs = self._worker.current, self._plan.jobs()
        finished = 0 if isinstance(job, Source) else len(jobs) - len(self._plan.missing())
        words = text if job is None else self._plan.words(job, text)
        self.view.show_progress(words, min(1.0, (finished + (done or 0.0)) / max(1, len(jobs))))

    # Showing.

    def _show(self) -> None:
        plan = self._plan
        with self._silence():
            self.view.show_panels(
                plan.summary.n_samples if plan.summary else 0,
                list(plan.states()),
                self.controls.color_by.value,
                plan.influence,
            )
        self.view.show_busy(self._worker.current is not None)
        self.view.show_message(plan.summary, plan.notes, plan.wanted.name, self.message)
        self.view.code.show(self.code)

    def _show_choice(self) -> None:
        """Let the controls show what is wanted, without wanting it again."""
        with self._silence():
            self.controls.choose(self._plan.wanted)

    def _offer(self) -> None:
        self.controls.offer(self._methods.projectors.names(), self._methods.back_projectors.names())

    @contextmanager
    def _silence(self) -> Iterator[None]:
        """Change what is shown without taking it for a person's wish."""
        before, self._quiet = self._quiet, True
        try:
            yield
        finally:
            self._quiet = before

    # What a person does.

    def _set_up(self, settings: Settings) -> None:
        controls = self.controls
        controls.ratio.value, controls.seed.value = settings.ratio, settings.random_state
        controls.standardize.value = settings.standardize
        controls.back_projector.value = settings.back_projector or ""
        if settings.repeat > 1:
            controls.n_seeds.value, controls.repeat.value = settings.repeat, True

    def _connect(self) -> None:
        controls, scatter = self.controls, self.view.scatter
        controls.on_settings(self._on_settings)
        controls.data.observe(self._on_data, "value")
        controls.further.observe(self._on_data, "value")
        controls.standardize.observe(self._on_standardize, "value")
        controls.open.on_click(self._on_open)
        controls.color_by.observe(lambda _: self._show(), "value")
        scatter.observe(lambda _: self.view.code.show(self.code), "selection")
        scatter.observe(self._on_moved, "moved")
        scatter.on_msg(self._on_message)
        self.view.cancel.on_click(lambda _: self.cancel())
        self.view.again.on_click(lambda _: self.recompute())

    def _on_settings(self) -> None:
        self._plan.describe()
        self._worker.wake()

    def _on_data(self, change: Any) -> None:
        first = self.controls.data.value
        if not first or self._quiet:
            return
        further = self.controls.further.value if change["owner"] is self.controls.further else ()
        self.open([first, *further])

    def _on_open(self, _: Any) -> None:
        if self.controls.path.value.strip():
            self.open(self.controls.path.value, self.controls.label.value.strip() or None)

    def _on_standardize(self, change: Any) -> None:
        plan = self._plan
        base = plan.source if plan.source is not None and self.message else plan.wanted
        self._want(standardized(reread(base), change["new"]))

    def _on_moved(self, change: Any) -> None:
        if not self._quiet:
            self._plan.moves.take(self._plan.runs, change["new"])
            self._worker.wake()

    def _on_message(self, scatter: Any, content: dict[str, Any], _: Any) -> None:
        """Answer the person who wants the views as a file."""
        if content.get("want") != "html":
            return
        try:
            page = comparison_page(self.view, self._plan.summary).encode()
        except Exception as error:  # the person must be told, whatever it is
            scatter.send({"kind": "failure", "text": f"{type(error).__name__}: {error}"})
            return
        scatter.send({"kind": "html", "name": "comparison.html"}, buffers=[page])
