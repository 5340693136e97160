"""The command line: ``workbench COMMAND …``.

With ``--json`` a command prints one JSON object on standard output and nothing else there.
Errors go to standard error as one line, with exit status 2 and no traceback.
"""

from __future__ import annotations

import os
import sys
import warnings

import typer

from workbench.cli import compaction, data, methods, reproduction, serve
from workbench.errors import AdjustmentWarning, DegenerateDataWarning, WorkbenchError

# Plain help and plain errors: one line each, and rich takes a quarter of a second to import.
app = typer.Typer(
    name="workbench",
    help="Interactive multidimensional projection and motion capture.",
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)
app.add_typer(data.app, name="datasets", help="List, fetch and check data sets.")
for command, summary in (
    (methods.project, "Project a table or a motion to the plane."),
    (methods.keyframes, "Select keyframes of a motion."),
    (compaction.compact, "Keep keyframes, rebuild the rest, measure the loss."),
    (compaction.expand, "Rebuild a motion from a compact file."),
    (reproduction.reproduce, "Regenerate figures and tables of the theses."),
    (serve.lab, "Open the notebooks in JupyterLab."),
    (serve.app, "Serve the dashboards with Voila."),
):
    app.command(short_help=summary)(command)


@app.callback(invoke_without_command=True)
def _version(
    context: typer.Context,
    version: bool = typer.Option(False, "--version", help="Print the version and end."),
) -> None:
    """Interactive multidimensional projection and motion capture."""
    if version:
        from workbench import __version__

        typer.echo(f"workbench {__version__}")
        raise typer.Exit
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())


def main() -> None:
    """Run the command line; this is the ``workbench`` program."""
    # On a busy machine OpenMP's waiting threads spin and make t-SNE up to eight times slower.
    os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")
    _show_notes_as_lines()
    try:
        status = app(standalone_mode=False)
    except (WorkbenchError, typer.TyperException) as error:
        message = error.format_message() if isinstance(error, typer.TyperException) else str(error)
        _fail(" ".join(message.split()), 2)
    except typer.Abort:
        _fail("interrupted", 130)
    except BrokenPipeError:
        # The reader, `head` for instance, has seen enough.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
    except MemoryError:
        _fail("the machine's memory does not suffice; take fewer samples", 2)
    except OSError as error:
        _fail(f"{error.filename or 'file'}: {error.strerror or error}", 2)
    sys.exit(status if isinstance(status, int) else 0)


def _fail(message: str, status: int) -> None:
    typer.echo(f"workbench: error: {message}", err=True)
    sys.exit(status)


def _show_notes_as_lines() -> None:
    """Show the package's own warnings as one line each, without source positions.

    Warnings of other packages would not tell a user of the command line what to do.
    """

    def show(message: Warning | str, category: type[Warning], *_: object) -> None:
        if issubclass(category, (AdjustmentWarning, DegenerateDataWarning)):
            typer.echo(f"workbench: note: {message}", err=True)

    warnings.showwarning = show  # type: ignore[assignment]  # fewer positional names, same call
    warnings.simplefilter("default")
