"""The projection comparison: embeddings of the same samples side by side."""

from __future__ import annotations

import asyncio
import itertools
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.dashboards.background import Background, Stopped
from workbench.dashboards.comparison_view import ComparisonView, PanelState
from workbench.dashboards.controls import Controls
from workbench.dashboards.quality_view import LETTERS
from workbench.dashboards.session import (
    Panel,
    PanelResult,
    Run,
    Session,
    Source,
    Summary,
    file_version,
)
from workbench.errors import WorkbenchError
from workbench.projection import projectors
from workbench.spaces import Space

_tokens = itertools.count(1)
_RATIOS = (0.01, 0.5)


def compare_projections(
    data: str | Path | Space = "uci/iris",
    panels: Sequence[str | Panel] = ("pca", "tsne"),
    *,
    standardize: bool = False,
    label: str | None = None,
    ratio: float = 0.03,
    random_state: int = 0,
) -> ProjectionComparison:
    """Compare projections of a data set or a motion in a dashboard.

    Parameters
    ----------
    data : str, path-like or Space
        A data set's name, a file's path, or samples in memory.
    panels : sequence of str or Panel
        Two to four projectors by name; ``Panel("tsne", optimized=True)`` for the optimized
        embedding.
    standardize : bool
        Whether to standardise the columns of a table.
    label : str, optional
        The column of a table of your own that holds the classes.
    ratio : float
        Share of control points, 0.01 to 0.5.
    random_state : int
        Seed of the choice of control points and of the projectors.

    Returns
    -------
    ProjectionComparison
        Shown by a notebook as the last expression of a cell.

    Raises
    ------
    WorkbenchError
        If an argument is not valid. Data that cannot be loaded are told in the dashboard.
    """
    return ProjectionComparison(
        data,
        panels,
        standardize=standardize,
        label=label,
        ratio=ratio,
        random_state=random_state,
    )


class ProjectionComparison:
    """A dashboard with two to four embeddings of the same samples.

    It computes beside the kernel; :meth:`finished` waits for that. Outside a notebook, where
    nothing could show progress, each change is computed before it returns. See
    :func:`compare_projections` for the parameters.

    Attributes
    ----------
    controls : Controls
        What can be chosen.
    view : ComparisonView
        What is shown.
    """

    def __init__(
        self,
        data: str | Path | Space = "uci/iris",
        panels: Sequence[str | Panel] = ("pca", "tsne"),
        *,
        standardize: bool = False,
        label: str | None = None,
        ratio: float = 0.03,
        random_state: int = 0,
    ) -> None:
        chosen = _checked(panels)
        if not _RATIOS[0] <= ratio <= _RATIOS[1]:
            raise WorkbenchError(f"ratio: got {ratio}, want {_RATIOS[0]} to {_RATIOS[1]}")
        self._background = Background(Session)
        self._working = False
        # Kept, because a loop holds its tasks only weakly.
        self._task: asyncio.Task[None] | None = None
        self._current: Source | Run | None = None
        self._wanted = _source(data, label, standardize)
        self._source: Source | None = None
        self._summary: Summary | None = None
        self._results: dict[Run, PanelResult] = {}
        self._failures: dict[Source | Run, str] = {}

        self.controls = Controls(_available(), projectors.names(), chosen)
        self.controls.ratio.value = ratio
        self.controls.seed.value = random_state
        self.controls.standardize.value = standardize
        self.view = ComparisonView(self.controls)
        self._show_choice()
        self._connect()
        self._wake()

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        self.controls.offer_projectors(projectors.names())
        return self.view.root._repr_mimebundle_(**kwargs)

    @property
    def selection(self) -> NDArray[np.int32]:
        """Sorted indices of the selected samples; set it to mark others."""
        selected: NDArray[np.int32] = self.view.scatter.selection
        return selected

    @selection.setter
    def selection(self, samples: ArrayLike) -> None:
        indices = np.asarray(samples)
        limit = self._summary.n_samples if self._summary else 0
        if indices.size and indices.dtype.kind in "iu" and indices.max() >= limit:
            raise WorkbenchError(
                f"selection: got index {indices.max()}, want indices below {limit}"
                if limit
                else "selection: got indices before there are data to select from"
            )
        self.view.scatter.selection = samples

    @property
    def results(self) -> dict[str, PanelResult]:
        """What the panels show, by their letters, as far as it is there."""
        runs = self._runs().items()
        return {letter: self._results[run] for letter, run in runs if run in self._results}

    @property
    def message(self) -> str:
        """Why the data that were asked for are not shown; empty if they are."""
        return self._failures.get(self._wanted, "")

    async def finished(self) -> None:
        """Wait until everything is computed: ``await dashboard.finished()``."""
        while self._working and self._task is not None:
            # Shielded, because who gives up waiting does not cancel the computation.
            await asyncio.shield(self._task)

    def open(self, data: str | Path | Space, label: str | None = None) -> None:
        """Show other data; those shown now stay if the new ones cannot be loaded.

        Parameters
        ----------
        data : str, path-like or Space
            A data set's name, a file's path, or samples in memory.
        label : str, optional
            The column of a table of your own that holds the classes.
        """
        self._want(_source(data, label, self.controls.standardize.value))

    def cancel(self) -> None:
        """End what is being computed; panels that are complete stay."""
        for job in self._missing():
            self._failures[job] = "cancelled"
        self._background.stop()
        self._show()

    def recompute(self) -> None:
        """Compute what failed or was cancelled, or everything anew if nothing did.

        A file that was edited meanwhile is read again.
        """
        self.controls.offer_projectors(projectors.names())
        wanted = _reread(self._wanted)
        if not self._failures and wanted == self._wanted:
            self._results.clear()
        self._failures.clear()
        self._wanted = wanted
        self._wake()

    def close(self) -> None:
        """End the process that computes, and take the dashboard out of the page."""
        self._background.stop()
        self.view.root.close()

    # What is wanted, and what of it is missing.

    def _want(self, source: Source) -> None:
        self._failures.pop(source, None)
        self._wanted = source
        self._show_choice()
        self._wake()

    def _runs(self) -> dict[str, Run]:
        """List what the panels are to show, by their letters; nothing without data."""
        if self._source is None:
            return {}
        ratio, seed = round(self.controls.ratio.value, 4), self.controls.seed.value
        panels = zip(LETTERS, self.controls.panels, strict=False)
        return {letter: Run(self._source, panel, ratio, seed) for letter, panel in panels}

    def _missing(self) -> list[Source | Run]:
        """List what is to be computed; data come before panels."""
        if self._wanted != self._source and self._wanted not in self._failures:
            return [self._wanted]
        runs = dict.fromkeys(self._runs().values())
        return [run for run in runs if run not in self._results and run not in self._failures]

    # Computing.

    def _wake(self) -> None:
        """Compute what is missing, and end what is no longer wanted."""
        if self._current is not None and self._current not in self._missing():
            self._background.stop()
        self._show()
        if self._working:
            return
        self._working = True
        loop = _running_loop()
        if loop is None:
            asyncio.run(self._work())
        else:
            self._task = loop.create_task(self._work())

    async def _work(self) -> None:
        try:
            while missing := self._missing():
                self._current = missing[0]
                await self._do(missing[0])
        finally:
            self._working = False
            self._current = None
            self._show()

    async def _do(self, job: Source | Run) -> None:
        self._show()
        try:
            if isinstance(job, Source):
                source = _loaded_here(job)
                summary = await self._background.call("load", source, report=self._report)
                self._take(source, summary)
            else:
                self._results[job] = await self._background.call(
                    "run", job, projectors, report=self._report
                )
        except Stopped:
            pass
        except WorkbenchError as error:
            self._failures[job] = str(error)
        except Exception as error:  # told in its place: nobody awaits the task
            self._failures[job] = f"{type(error).__name__}: {error}"

    def _take(self, source: Source, summary: Summary) -> None:
        """Show samples that were loaded instead of those before."""
        self._source, self._summary = source, summary
        given = source.space is not None and not source.registered
        self.controls.suit(summary, may_standardize=not (given or summary.body))
        self.view.show_samples(summary)

    def _report(self, text: str, done: float | None) -> None:
        runs = self._runs()
        count = len(set(runs.values())) or 1
        finished = count - len(self._missing()) if isinstance(self._current, Run) else 0
        if isinstance(self._current, Run):
            letters = [letter for letter, run in runs.items() if run == self._current]
            text = f"{' and '.join(letters)} ({self._current.panel.projector}): {text}"
        self.view.show_progress(text, min(1.0, max(0.0, (finished + (done or 0.0)) / count)))

    # Showing.

    def _show(self) -> None:
        runs = self._runs()
        states = []
        for letter, panel in zip(LETTERS, self.controls.panels, strict=False):
            run = runs.get(letter)
            title = f"{letter} · {panel.projector}{', optimized' if panel.optimized else ''}"
            if run is None:
                states.append(PanelState(title, None, "no data" if self.message else ""))
            else:
                failure = self._failures.get(run, "")
                states.append(PanelState(title, self._results.get(run), failure))
        self.view.scatter.color_by = self.controls.color_by.value
        self.view.show_panels(self._summary.n_samples if self._summary else 0, states)
        self.view.show_busy(self._current is not None)
        notes = [f"{letter}: {n}" for letter, result in self.results.items() for n in result.notes]
        self.view.show_message(self._summary, notes, self._wanted.name, self.message)

    def _show_choice(self) -> None:
        """Let the drop-down show what is wanted, without wanting it again."""
        self._choosing = True
        try:
            named = self._wanted.registered or not self._wanted.token
            self.controls.choose(self._wanted.name if named else None)
        finally:
            self._choosing = False

    def _connect(self) -> None:
        controls = self.controls
        controls.on_settings(self._wake)
        controls.data.observe(self._on_data, "value")
        controls.standardize.observe(self._on_standardize, "value")
        controls.open.on_click(self._on_open)
        controls.color_by.observe(lambda _: self._show(), "value")
        self.view.cancel.on_click(lambda _: self.cancel())
        self.view.again.on_click(lambda _: self.recompute())

    def _on_data(self, change: Any) -> None:
        if change["new"] and not self._choosing:
            self.open(change["new"])

    def _on_open(self, _: Any) -> None:
        if self.controls.path.value.strip():
            self.open(self.controls.path.value, self.controls.label.value.strip() or None)

    def _on_standardize(self, change: Any) -> None:
        base = self._source if self._source is not None and self.message else self._wanted
        base = _reread(base)
        if base.registered:
            base = replace(base, space=None, token=next(_tokens))
        self._want(replace(base, standardize=change["new"]))


def _checked(panels: Sequence[str | Panel]) -> list[Panel]:
    chosen = [panel if isinstance(panel, Panel) else Panel(panel) for panel in panels]
    if not 2 <= len(chosen) <= len(LETTERS):
        raise WorkbenchError(f"panels: got {len(chosen)}, want 2 to {len(LETTERS)}")
    for panel in chosen:
        if panel.projector not in projectors:
            projectors.factory(panel.projector)  # refuses it and says which there are
    return chosen


def _source(data: str | Path | Space, label: str | None, standardize: bool) -> Source:
    """Say where samples come from, in words that the other process understands."""
    if isinstance(data, Space):
        return Source(data.name or "samples", space=data, token=next(_tokens))
    from workbench.datasets import registered_datasets
    from workbench.datasets.catalogue import lookup

    name = str(data).strip()
    if name not in registered_datasets() and lookup(name) is not None:
        return Source(name, label, standardize)
    path = Path(name).expanduser()
    try:
        if path.exists():
            name = str(path.absolute())
            return Source(name, label, standardize, version=file_version(name))
    except OSError:  # too long for a path, for instance
        pass
    return Source(name, label, standardize, token=next(_tokens), registered=True)


def _reread(source: Source) -> Source:
    """Take notice of a file that was edited."""
    return replace(source, version=file_version(source.name)) if source.version else source


def _loaded_here(source: Source) -> Source:
    """Load what only this kernel can: data registered by its user."""
    if source.space is not None or not source.registered:
        return source
    from workbench.datasets import load_space

    try:
        space = load_space(source.name, label=source.label, standardize=source.standardize)
    except WorkbenchError:
        raise
    except Exception as error:  # a user's loader may fail in any way
        raise WorkbenchError(f"{type(error).__name__}: {error}") from error
    return replace(source, space=space)


def _running_loop() -> asyncio.AbstractEventLoop | None:
    try:
        return asyncio.get_running_loop()
    except RuntimeError:
        return None


def _available() -> list[tuple[str, str]]:
    """List the user's own data sets and those that need no download, as (text, name)."""
    from workbench.datasets import list_datasets, registered_datasets

    own = registered_datasets()
    return [(name, name) for name in own] + [
        (f"{found.entry.name}: {found.entry.title}", found.entry.name)
        for found in list_datasets()
        if found.state in ("available", "built in") and found.entry.name not in own
    ]
