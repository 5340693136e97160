"""Cells that stop before their check."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from IPython.core.interactiveshell import InteractiveShell

SETUP = """
import numpy as np
from workbench.teaching import Lesson

lesson = Lesson(1)
pair = {"samples": np.array([[0.0, 0.0], [3.0, 4.0]]), "pair": (0, 1)}
"""
CHECK = 'lesson.check("distance", answer, **pair)'


@pytest.fixture
def shell() -> Iterator[Any]:
    """Start a shell as notebooks have it, with a lesson."""
    InteractiveShell.clear_instance()
    shell = InteractiveShell.instance()
    assert shell.run_cell(SETUP, store_history=True).success
    yield shell
    shell.history_manager.end_session()
    InteractiveShell.clear_instance()


STOPPED = {
    "a misspelt name": (
        "# mine\nanswer = no_such_name",
        "at its line 2, `answer = no_such_name`, with",
    ),
    "a division by zero": ("answer = 1 / 0", "ZeroDivisionError: division by zero"),
    "inside a library": ("answer = np.linalg.inv(np.zeros((2, 2)))", "Singular matrix"),
}


@pytest.mark.parametrize(("code", "told"), STOPPED.values(), ids=STOPPED)
def test_what_stops_an_exercise_is_told_in_a_box(code, told, shell, capsys):
    """The box names the line and the error; there is no traceback, and the next answer counts."""
    shell.run_cell(f"{code}\n{CHECK}", store_history=True)
    printed = capsys.readouterr().out
    assert "! Cannot read the answer (distance)" in printed
    assert told in printed
    assert "Traceback" not in printed
    shell.run_cell(f"answer = 5.0\n{CHECK}", store_history=True)
    assert "1 of 6 exercises solved" in capsys.readouterr().out


def test_other_cells_show_their_traceback(shell, capsys):
    """What is no exercise fails as in any notebook."""
    shell.run_cell("1 / 0", store_history=True)
    printed = capsys.readouterr().out
    assert "Traceback" in printed
    assert "Cannot read" not in printed
