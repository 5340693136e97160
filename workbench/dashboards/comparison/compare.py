"""The projection comparison: embeddings of the same samples side by side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.dashboards.comparison.arguments import (
    Settings,
    checked_moves,
    checked_panels,
    checked_selection,
)
from workbench.dashboards.comparison.exports import comparison_page, results_table
from workbench.dashboards.comparison.jobs import PanelResult
from workbench.dashboards.comparison.live import LiveComparison
from workbench.dashboards.comparison.panels import Panel
from workbench.dashboards.shared.sources import source_of
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
        self._live = LiveComparison(source, chosen, settings)
        self.controls, self.view = self._live.controls, self._live.view

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        self._live.offer()
        return self.view.root._repr_mimebundle_(**kwargs)

    @property
    def selection(self) -> NDArray[np.int32]:
        """Sorted indices of the selected samples; set it to mark others."""
        selected: NDArray[np.int32] = self.view.scatter.selection
        return selected

    @selection.setter
    def selection(self, samples: ArrayLike) -> None:
        indices = checked_selection(samples)
        limit = self._live.plan.summary.n_samples if self._live.plan.summary else 0
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
        return self._live.moved

    @moved.setter
    def moved(self, moved: Mapping[str, ArrayLike]) -> None:
        self._live.move(checked_moves(moved))

    @property
    def results(self) -> dict[str, PanelResult]:
        """What the panels show, by their letters, as far as it is there."""
        return self._live.plan.results

    @property
    def message(self) -> str:
        """Why the data that were asked for are not shown; empty if they are."""
        return self._live.message

    @property
    def code(self) -> str:
        """The code of a cell that makes this view again."""
        return self._live.code

    async def finished(self) -> None:
        """Wait until everything is computed: ``await dashboard.finished()``."""
        await self._live.worker.finished()

    def open(self, data: Data, label: str | None = None) -> None:
        """Show other data; those shown now stay if the new ones cannot be loaded.

        Parameters
        ----------
        data : str, path-like, Space, or a sequence of them
            As for :func:`compare_projections`.
        label : str, optional
            The column of a table of your own that holds the classes.
        """
        self._live.want(source_of(data, label, self.controls.standardize.value))

    def cancel(self) -> None:
        """End what is being computed; panels that are complete stay."""
        self._live.worker.cancel()

    def recompute(self) -> None:
        """Compute what failed or was cancelled, or everything anew if nothing did.

        A file that was edited meanwhile is read again.
        """
        self._live.recompute()

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
        if self._live.plan.summary is None:
            raise WorkbenchError("data: got none so far, want some to write")
        return results_table(self._live.plan.summary, self.results, self.selection)

    def save_csv(self, path: str | Path) -> Path:
        """Write the table of :meth:`to_frame` to a file; one that exists is replaced."""
        text = self.to_frame().to_csv(index=False)
        write_atomically(Path(path), text.encode())
        return Path(path)

    def save_html(self, path: str | Path) -> Path:
        """Write the views to one HTML file that stays interactive without a kernel."""
        page = comparison_page(self.view, self._live.plan.summary)
        write_atomically(Path(path), page.encode())
        return Path(path)

    def close(self) -> None:
        """End the process that computes, and take the dashboard out of the page."""
        self._live.background.stop()
        self.view.root.close()
