"""The commands ``datasets list``, ``datasets fetch`` and ``datasets check``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated

import typer

from workbench.cli.options import Json, report
from workbench.errors import DataError

if TYPE_CHECKING:
    from workbench.datasets import Status

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None)

Names = Annotated[list[str], typer.Argument(help="Names of data sets, as listed.")]


@app.command("list")
def list_(json: Json = False) -> None:
    """List all data sets that are known by name, and where each one is."""
    from workbench.datasets import list_datasets

    found = list_datasets()
    if json:
        report({"datasets": [_describe(status) for status in found]}, as_json=True)
        return
    width = max(len(status.entry.name) for status in found)
    for status in found:
        typer.echo(f"{status.entry.name:<{width}}  {status.state:<12}  {status.entry.title}")


@app.command()
def fetch(names: Names, json: Json = False) -> None:
    """Download data sets that are on this machine in no data folder."""
    from workbench.datasets import fetch as fetch_one

    _each(names, fetch_one, json)


@app.command()
def check(
    names: Annotated[
        list[str] | None, typer.Argument(help="Names of data sets; all that are found if none.")
    ] = None,
    json: Json = False,
) -> None:
    """Read data sets and compare them with what the catalogue knows of them."""
    from workbench.datasets import check as check_one
    from workbench.datasets import list_datasets

    if not names:
        here = ("available", "built in")
        names = [status.entry.name for status in list_datasets() if status.state in here]
    _each(names, check_one, json)


def _each(names: list[str], action: Callable[[str], Status], json: bool) -> None:
    """Apply an action to each name, report all, and fail at the end if one failed."""
    done, failures = [], []
    for name in names:
        try:
            status = action(name)
        except DataError as error:
            failures.append(str(error))
            continue
        done.append(_describe(status))
        if not json:
            typer.echo(f"{name}: good")
    if json:
        report({"datasets": done, "failed": failures}, as_json=True)
    if failures:
        for failure in failures[:-1]:
            typer.echo(f"workbench: error: {failure}", err=True)
        raise DataError(failures[-1])


def _describe(status: Status) -> dict[str, object]:
    entry = status.entry
    return {
        "name": entry.name,
        "title": entry.title,
        "state": status.state,
        "path": None if status.path is None else str(status.path),
        "licence": entry.licence,
        "citation": entry.citation,
    }
