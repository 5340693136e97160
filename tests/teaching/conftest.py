"""What the cells of each lesson give to the checks, on the lesson's own data."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import nbformat
import pytest

from workbench.resources import bundled
from workbench.teaching import Feedback, Lesson


@cache
def _given(number: int) -> dict[str, dict[str, Any]]:
    """Run a lesson's cells without its dashboards and note what its checks are given."""
    (path,) = (bundled("notebooks") / "lessons").glob(f"{number}_*.ipynb")
    noted: dict[str, dict[str, Any]] = {}
    check = Lesson.check

    def note(lesson: Lesson, key: str, answer: Any = ..., **given: Any) -> Feedback:
        noted[key] = given
        return check(lesson, key, answer, **given)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Lesson, "check", note)
        names: dict[str, Any] = {"__name__": "lesson"}
        for cell in nbformat.read(path, as_version=4).cells:
            if cell.cell_type == "code" and cell.id != "dashboard":
                exec(compile(cell.source, f"<{cell.id}>", "exec"), names)
    return noted


@pytest.fixture
def given() -> Callable[[int], dict[str, dict[str, Any]]]:
    """Give, by a lesson's number, the arguments of each of its checks."""
    return _given
