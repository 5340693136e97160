"""The analysis of a user study: who took part, what they said, and what it shows."""

from __future__ import annotations

import base64
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import ipywidgets as widgets

from workbench.dashboards.shared.home import Home
from workbench.dashboards.shared.layout import FITTING, alert, control_row
from workbench.dashboards.study.figures import rating_bars
from workbench.dashboards.study.files import known_studies, study_path
from workbench.dashboards.study.tables import comparisons_table, printed_table
from workbench.errors import WorkbenchError
from workbench.study.analysis import MotionAnalysis, analyse_answers
from workbench.study.reading import read_answers, write_csv
from workbench.widgets.figure import FigureView

if TYPE_CHECKING:
    import pandas as pd


def analyse_study(study: str | Path = "") -> StudyAnalysis:
    """Analyse the answers of a user study in a dashboard.

    Parameters
    ----------
    study : str or path-like
        Name or path of a study's file, or of a CSV or Parquet file of answers; by default the
        study that was prepared or used last.

    Returns
    -------
    StudyAnalysis
        Shown by a notebook as the last expression of a cell.
    """
    return StudyAnalysis(study)


class StudyAnalysis:
    """A dashboard with the answers of a study, and paired t tests of them.

    Parameters
    ----------
    study
        As for :func:`analyse_study`.

    Attributes
    ----------
    answers : DataFrame or None
        What participants said, as :func:`workbench.study.answers.check_answers` gives it; None
        if there is nothing.
    found : list of MotionAnalysis
        Motion by motion.
    message : str
        Why there is nothing to show; empty if there is.
    """

    def __init__(self, study: str | Path = "") -> None:
        self.answers: pd.DataFrame | None = None
        self.found: list[MotionAnalysis] = []
        self.message = ""
        known = known_studies()
        self.file = widgets.Combobox(
            value=str(study) or (known[0] if known else ""),
            options=known,
            description="File of the study",
            style=FITTING,
            layout=widgets.Layout(flex="1 1 300px", max_width="640px"),
        )
        self.read = widgets.Button(
            description="Read answers",
            tooltip="Read the file, with answers that came meanwhile",
            layout=widgets.Layout(width="150px"),
        )
        self._about = widgets.HTML()
        self._results = widgets.VBox([])
        self.root = widgets.VBox(
            [control_row([self.file, self.read]), self._about, self._results],
            layout=widgets.Layout(width="100%"),
        )
        self.read.on_click(Home().here(lambda _: self.refresh()))
        self.refresh()

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        return self.root._repr_mimebundle_(**kwargs)

    def refresh(self) -> None:
        """Read the answers that are there now; what cannot be read leaves what is shown."""
        self.file.options = known_studies()
        if not self.file.value.strip():
            self._fail("No study was prepared yet.")
            return
        try:
            path = study_path(self.file.value)
            if not path.exists():
                self._fail(f"There is no study in {path} yet.")
                return
            answers = read_answers(path)
        except WorkbenchError as error:
            self._fail(str(error))
            return
        self.answers, self.message = answers, ""
        self.found = analyse_answers(answers)
        self._about.value = _about(answers)
        before = self._results.children
        self._results.children = [part for found in self.found for part in _shown(found)]
        for part in before:
            part.close()

    def save_csv(self, path: str | Path) -> Path:
        """Write all answers as a CSV file; one that exists is replaced.

        Raises
        ------
        WorkbenchError
            If there are none, or the file cannot be written.
        """
        if self.answers is None:
            raise WorkbenchError("answers: got none so far, want some to save")
        write_csv(self.answers, path)
        return Path(path)

    def close(self) -> None:
        """Take the dashboard out of the page."""
        self.root.close()

    def _fail(self, words: str) -> None:
        self.message = words
        still = " What was read before is still shown." if self.answers is not None else ""
        self._about.value = alert(words + still)


def _shown(found: MotionAnalysis) -> list[widgets.Widget]:
    description = f"Ratings of {found.title}: bars of each stimulus, its mean first"
    figure = FigureView(
        figure=rating_bars(found.ratings, found.title).to_json(),
        description=description,
        layout=widgets.Layout(width="100%", min_width="0"),
    )
    words = (
        printed_table(found) + comparisons_table(found)
        if found.comparisons
        else alert(f"{found.title}: {found.missing}")
    )
    return [figure, widgets.HTML(words)]


def _about(answers: pd.DataFrame) -> str:
    n_people = answers["participant"].nunique()
    stimuli = ["test_case", "motion", "stimulus"]
    n_stimuli = len(answers[stimuli].drop_duplicates())
    n_complete = int((answers["participant"].value_counts() == n_stimuli).sum())
    words = (
        f"{len(answers)} ratings by {n_people} {'participant' if n_people == 1 else 'participants'}"
        f", {n_complete} of whom rated everything that anyone rated"
    )
    table = base64.b64encode(answers.to_csv(index=False, lineterminator="\n").encode()).decode()
    link = (
        '<a style="color: var(--jp-content-link-color, #1565c0); text-decoration: underline" '
        f'download="answers.csv" href="data:text/csv;base64,{table}">Download all as CSV</a>'
    )
    return f'<div role="status" style="line-height: 1.4">{escape(words)}. {link}</div>'
