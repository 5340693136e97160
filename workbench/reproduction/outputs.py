"""What notebooks leave in the output folder: figures, tables and how each run ended.

OUT/figures/NAME.html, .json, .png    OUT/tables/NAME.csv, .md, .tex
OUT/parts/NAME.json                   what it is, its caption, which item it belongs to
OUT/claims/ID.json                    evidence for or against a claim
OUT/notebooks/NOTEBOOK.ipynb, .outcome.json
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from workbench.experiments.bootstrap import Estimate
from workbench.files import write_atomically
from workbench.reproduction.claims import Evidence, claim_by_id
from workbench.reproduction.tables import as_latex, as_markdown

if TYPE_CHECKING:
    import pandas as pd
    import plotly.graph_objects as go

FIGURE = "figure"
TABLE = "table"
VALUES = "values"
NOT_MADE = "not made"


class Outputs:
    """Save what a notebook makes, for the report.

    Parameters
    ----------
    out : path-like or None
        The output folder; None saves nothing, for a notebook that is only looked at.
    profile : str, optional
        Profile of the run, kept with all that it makes: a folder may hold parts of several.
    seed : int, optional
        Its seed, kept likewise.
    """

    def __init__(
        self, out: str | Path | None, *, profile: str | None = None, seed: int | None = None
    ) -> None:
        self.folder = None if out is None else Path(out)
        self._made_with = {"profile": profile, "seed": seed}
        # Imported here: listing what there is to make needs no plotly.
        from workbench.figures.style import offer_no_upload

        offer_no_upload()

    def figure(
        self, item: str, figure: go.Figure, *, caption: str, alt: str, name: str = ""
    ) -> None:
        """Save a figure as HTML and JSON; ``reproduce`` adds the PNG.

        Parameters
        ----------
        item : str
            Id of the item that it belongs to.
        figure : plotly.graph_objects.Figure
            The figure.
        caption : str
            What it shows, on which data.
        alt : str
            What a reader who does not see it should know.
        name : str
            Tells several figures of one item apart.
        """
        if self.folder is None:
            return
        path = self.folder / "figures" / _stem(item, name)
        write_atomically(path.with_name(f"{path.name}.json"), (figure.to_json() or "").encode())
        # plotly.js is written once, beside the figures, so that the folder works offline.
        figure.write_html(
            path.with_name(f"{path.name}.html"),
            include_plotlyjs="directory",
            # plotly.js offers to upload a chart unless it is told not to.
            config={"responsive": True, "displaylogo": False, "showSendToCloud": False},
        )
        self._part(item, path.name, kind=FIGURE, caption=caption, alt=alt)

    def table(self, item: str, table: pd.DataFrame, *, caption: str, name: str = "") -> None:
        """Save a table as CSV, Markdown and LaTeX.

        Parameters
        ----------
        item : str
            Id of the item that it belongs to.
        table : DataFrame
            The table. Two levels of columns are joined by a blank, except in the report.
        caption : str
            What it shows, on which data.
        name : str
            Tells several tables of one item apart.
        """
        if self.folder is None:
            return
        stem = _stem(item, name)
        flat = table.copy()
        if flat.columns.nlevels > 1:
            flat.columns = [" ".join(str(level) for level in column) for column in flat.columns]
        path = self.folder / "tables" / f"{stem}.csv"
        write_atomically(path, flat.to_csv(lineterminator="\n").encode())
        write_atomically(path.with_suffix(".md"), as_markdown(flat, caption).encode())
        write_atomically(path.with_suffix(".tex"), as_latex(flat, caption, stem).encode())
        self._part(item, stem, kind=TABLE, caption=caption, **_table_content(table))

    def values(self, item: str, values: Mapping[str, float]) -> None:
        """Save our values of an item of which a single value was published.

        Parameters
        ----------
        item : str
            Id of the item.
        values : mapping of str to float
            What each value was computed on, and the value.
        """
        if self.folder is not None:
            self._part(item, slug(item), kind=VALUES, values=dict(values))

    def claim(self, claim: str, evidence: Evidence) -> None:
        """Save the evidence for or against a claim, for the ledger of claims.

        Parameters
        ----------
        claim : str
            Id of the claim, as in ``claims.toml``.
        evidence : Evidence
            The effect with its interval; without one the claim is not decidable.

        Raises
        ------
        WorkbenchError
            If there is no such claim.
        """
        claim_by_id(claim)
        if self.folder is None:
            return
        record = {"claim": claim, **self._made_with, **asdict(evidence)}
        path = self.folder / "claims" / f"{slug(claim)}.json"
        write_atomically(path, json.dumps(record, indent=1).encode())

    def data(self, notebook: str, table: pd.DataFrame) -> None:
        """Record which data the runs of a notebook used, for the report's introduction.

        Parameters
        ----------
        notebook : str
            Name of the notebook.
        table : DataFrame
            From :func:`workbench.experiments.grid.run_grid`.
        """
        if self.folder is None:
            return
        done = table[table["status"] == "done"]
        record = {
            "notebook": notebook,
            "n_runs": len(table),
            "n_failed": len(table) - len(done),
            "sizes": {
                str(name): int(size)
                for name, size in done.groupby("dataset", sort=False)["n_samples"].first().items()
            },
        }
        path = self.folder / "data" / f"{notebook}.json"
        write_atomically(path, json.dumps(record, indent=1).encode())

    def not_made(self, item: str, reason: str) -> None:
        """Say why an item cannot be made, so that it is not silently missing.

        Parameters
        ----------
        item : str
            Id of the item.
        reason : str
            What is missing, and what the reader can do.
        """
        if self.folder is not None:
            self._part(item, slug(item), kind=NOT_MADE, caption=reason)

    def _part(self, item: str, name: str, **content: Any) -> None:
        assert self.folder is not None
        record = {"item": item, "name": name, **self._made_with, **content}
        path = self.folder / "parts" / f"{name}.{record['kind'].replace(' ', '-')}.json"
        write_atomically(path, json.dumps(record, indent=1).encode())


def slug(item: str) -> str:
    """Make a file name of an id.

    Examples
    --------
    >>> slug("costa2018:fig5.3")
    'costa2018_fig5.3'
    """
    return re.sub(r"[^\w.-]", "_", item)


def _stem(item: str, name: str) -> str:
    return slug(item) + (f"_{name}" if name else "")


def read_parts(out: Path) -> list[dict[str, Any]]:
    """Read what the notebooks left in an output folder, in the order of its names."""
    return list(_parts(out).values())


def read_evidence(out: Path, claim: str) -> Evidence | None:
    """Read the evidence that was found about a claim; None if its notebook has not run."""
    path = out / "claims" / f"{slug(claim)}.json"
    if not path.is_file():
        return None
    record = _read(path)
    found = record["estimate"]
    estimate = None if found is None else Estimate(**found)
    return Evidence(estimate, record["units"], record["note"])


def forget(out: Path, notebook: str, items: set[str]) -> None:
    """Forget what a notebook made of its items earlier, before it runs again."""
    for path, part in _parts(out).items():
        if part["item"] in items:
            path.unlink(missing_ok=True)
    (out / "data" / f"{notebook}.json").unlink(missing_ok=True)


def write_outcome(
    out: Path, notebook: str, *, items: Sequence[str], seconds: float, error: str
) -> None:
    """Record how the run of a notebook for some items ended; an empty error means well."""
    record = {"notebook": notebook, "items": list(items), "seconds": seconds, "error": error}
    write_atomically(_outcome_path(out, notebook), json.dumps(record, indent=1).encode())


def read_outcome(out: Path, notebook: str) -> dict[str, Any] | None:
    """Read how the last run of a notebook ended; None if it was not run."""
    path = _outcome_path(out, notebook)
    return _read(path) if path.is_file() else None


def read_error(out: Path, notebook: str, item: str) -> str:
    """Read the error that kept a notebook from making an item.

    Empty if the last run ended well, or was not for this item, which is then as it was.
    """
    outcome = read_outcome(out, notebook)
    if outcome is None:
        return ""
    concerned = item in outcome["items"]
    return str(outcome["error"]) if concerned else ""


def _outcome_path(out: Path, notebook: str) -> Path:
    return out / "notebooks" / f"{notebook}.outcome.json"


def _parts(out: Path) -> dict[Path, dict[str, Any]]:
    """Read the parts that are there, though another notebook may forget its own meanwhile."""
    parts = {}
    for path in sorted((out / "parts").glob("*.json")):
        with suppress(FileNotFoundError):
            parts[path] = _read(path)
    return parts


def _read(path: Path) -> dict[str, Any]:
    content: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return content


def _table_content(table: pd.DataFrame) -> dict[str, Any]:
    """Put a table in a form that JSON can hold and the report can show."""
    import pandas as pd

    columns = [list(c) if isinstance(c, tuple) else [str(c)] for c in table.columns]
    rows = [
        [None if pd.isna(value) else value for value in row]
        for row in table.astype(object).to_numpy().tolist()
    ]
    return {
        "index_name": str(table.index.name or ""),
        "index": [str(name) for name in table.index],
        "columns": columns,
        "rows": rows,
    }
