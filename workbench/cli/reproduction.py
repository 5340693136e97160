"""The command ``reproduce``."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from workbench.cli.options import Json, Seed, report
from workbench.errors import WorkbenchError

if TYPE_CHECKING:
    from workbench.reproduction.items import Item


class Profile(StrEnum):
    """How much data a reproduction uses."""

    quick = "quick"
    full = "full"


def reproduce(
    ids: Annotated[
        list[str] | None,
        typer.Argument(metavar="[ID]...", help="Figures and tables, as --list shows them."),
    ] = None,
    list_: Annotated[
        bool, typer.Option("--list", help="List the figures and tables and their state.")
    ] = False,
    profile: Annotated[
        Profile, typer.Option(help="quick: bundled data, minutes; full: all data found.")
    ] = Profile.quick,
    jobs: Annotated[
        int, typer.Option(help="Processes that compute at once; -1 for one on each core.")
    ] = -1,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS", help="Compute on a Dask cluster, such as tcp://127.0.0.1:8786."
        ),
    ] = None,
    seed: Seed = 0,
    study: Annotated[
        Path | None, typer.Option(help="Answers of a user study: CSV, Parquet or SQLite.")
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder for the report.")] = Path("reproduction"),
    json: Json = False,
) -> None:
    """Regenerate figures and tables of the theses and compare them with the published ones."""
    from workbench.reproduction.items import select_items
    from workbench.reproduction.reproduce import reproduce as run

    items = select_items(ids)
    if list_:
        rows = _describe(items, out)
        if json:
            report({"items": rows}, as_json=True)
            return
        for row, item in zip(rows, items, strict=True):
            typer.echo(f"{row['id']:<20}  {row['state']:<10}  {item.title}")
        return
    outcome = run(
        ids,
        profile=profile.value,
        jobs=jobs,
        scheduler=scheduler,
        out=out,
        seed=seed,
        study=study,
    )
    if json:
        report({"items": _describe(items, out)}, as_json=True)
    else:
        typer.echo(f"The report is {outcome.index}")
    if outcome.failed:
        notebooks = ", ".join(outcome.errors)
        raise WorkbenchError(f"failed: {notebooks}; {outcome.index} shows the errors")


def _describe(items: list[Item], out: Path) -> list[dict[str, str]]:
    from workbench.reproduction.items import item_state

    return [
        {"id": item.id, "notebook": item.notebook, "state": item_state(item, out)} for item in items
    ]
