"""The command ``reproduce``."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.options import Json, report
from workbench.errors import WorkbenchError


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
        int | None, typer.Option(min=1, help="Runs at once; by default one for each core.")
    ] = None,
    seed: Annotated[int, typer.Option(help="Seed of everything random.")] = 0,
    out: Annotated[Path, typer.Option(help="Folder for the report.")] = Path("reproduction"),
    json: Json = False,
) -> None:
    """Regenerate figures and tables of the theses and compare them with the published ones."""
    from workbench.experiments.items import item_state, select_items
    from workbench.experiments.reproduce import reproduce as run

    items = select_items(ids)
    if list_:
        rows = [
            {"id": item.id, "notebook": item.notebook, "state": item_state(item, out)}
            for item in items
        ]
        if json:
            report({"items": rows}, as_json=True)
            return
        for row, item in zip(rows, items, strict=True):
            typer.echo(f"{row['id']:<20}  {row['state']:<10}  {item.title}")
        return
    outcome = run(ids, profile=profile.value, jobs=jobs, out=out, seed=seed)
    typer.echo(f"The report is {outcome.index}", err=json)
    if json:
        report(
            {
                "items": [
                    {"id": item.id, "notebook": item.notebook, "state": item_state(item, out)}
                    for item in items
                ]
            },
            as_json=True,
        )
    if outcome.failed:
        raise WorkbenchError(f"failed: {', '.join(outcome.failed)}; the report shows the errors")
