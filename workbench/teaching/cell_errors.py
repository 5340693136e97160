"""Tell what stops an exercise's cell in a box, in place of a traceback.

A check sees only answers that came about. A line above it may stop the cell, with a misspelt
name for instance; students then read which line and why, as they read everything else.
"""

from __future__ import annotations

import re
import sys
import traceback
from collections.abc import Callable
from types import TracebackType
from typing import Any

#: Reports that the cell of an exercise was stopped: its key and what to say.
Report = Callable[[str, str], Any]

_CHECK = re.compile(r"\.check\(\s*[\"']([^\"']+)[\"']")


def tell_errors(report: Report) -> None:
    """Let notebook cells that check an answer report what stops them.

    Other cells show their traceback as ever. Outside of IPython, nothing happens.

    Parameters
    ----------
    report : callable
        ``report(key, text)`` gives what the cell shows.
    """
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    if shell is None:
        return

    def handle(
        shell: Any,
        kind: type[Exception],
        error: Exception,
        trace: TracebackType | None,
        tb_offset: int | None = None,
    ) -> list[str] | None:
        from IPython.display import display

        code = shell.user_ns.get("In", [""])[-1]
        found = _CHECK.search(code)
        if found is None:
            shell.showtraceback((kind, error, trace), tb_offset=tb_offset)
            return None
        display(report(found.group(1), what_stopped(error, code)))
        return []

    shell.set_custom_exc((Exception,), handle)


def what_stopped(error: Exception, code: str) -> str:
    """Say in a sentence which line of a cell stopped it, and why.

    Parameters
    ----------
    error : Exception
        What was raised.
    code : str
        The cell.

    Returns
    -------
    str

    Examples
    --------
    >>> what_stopped(ZeroDivisionError("division by zero"), "answer = 1 / 0")
    'The cell stops with ZeroDivisionError: division by zero'
    """
    lines = code.splitlines()
    frames = traceback.extract_tb(error.__traceback__)
    # The cell comes first; below it may be modules that it imports.
    line = next((frame.lineno for frame in frames if frame.name == "<module>"), None)
    where = ""
    if line is not None and line <= len(lines):
        where = f" at its line {line}, `{lines[line - 1].strip()}`,"
    return f"The cell stops{where} with {type(error).__name__}: {error}"
