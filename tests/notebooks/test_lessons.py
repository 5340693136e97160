"""The lessons as files, and run as CI, a teacher and a student run them."""

from __future__ import annotations

import ast
from importlib import import_module
from pathlib import Path
from typing import Any

import nbformat
import papermill
import pytest

from tests.check_notebooks import problems
from workbench.resources import bundled

#: All lessons, in their order.
PATHS = {path.stem: path for path in sorted((bundled("notebooks") / "lessons").glob("*.ipynb"))}

#: A lesson computes with NumPy and shows tables; all methods are the package's.
ALLOWED = {"numpy", "pandas", "workbench"}

lessons = pytest.mark.parametrize("path", PATHS.values(), ids=PATHS)


def _exercises(path: Path) -> list[str]:
    """List the keys of a lesson's exercises."""
    module = import_module(f"workbench.teaching.lesson_{path.stem[0]}")
    return [exercise.key for exercise in module.EXERCISES]


def _cells(notebook: Any, tag: str) -> list[Any]:
    return [cell for cell in notebook.cells if tag in cell.metadata.get("tags", [])]


def test_there_are_five():
    """The numbers lead through them."""
    assert [name[0] for name in PATHS] == ["1", "2", "3", "4", "5"]


@lessons
def test_a_lesson_is_a_clean_notebook(path):
    """It is valid, without outputs or records of a run, and has the two parameters."""
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    assert problems(path) == []
    (parameters,) = _cells(notebook, "parameters")
    names = [node.targets[0].id for node in ast.parse(parameters.source).body]
    assert names == ["solutions", "random_state"]


@lessons
def test_a_lesson_has_all_its_parts(path):
    """It begins with a goal and what one needs, and ends with a summary and further reading."""
    notebook = nbformat.read(path, as_version=4)
    text = [cell.source for cell in notebook.cells if cell.cell_type == "markdown"]
    assert text[0].startswith(f"# Lesson {path.stem[0]}: ")
    assert "**Goal.**" in text[0]
    assert "**You need**" in text[0]
    assert "## Summary" in text[-1]
    assert "## Further reading" in text[-1]


@lessons
def test_each_exercise_is_asked_once(path):
    """Every exercise has a cell, in order, whose error would stop nothing, and a question."""
    notebook = nbformat.read(path, as_version=4)
    cells = _cells(notebook, "exercise")
    keys = [
        node.args[0].value
        for cell in cells
        for node in ast.walk(ast.parse(cell.source))
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "lesson.check"
    ]
    assert keys == _exercises(path)
    assert all("raises-exception" in cell.metadata.tags for cell in cells)
    text = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    assert [f"**Exercise {n}.**" in text for n in range(1, len(keys) + 2)] == [
        *[True] * len(keys),
        False,
    ]


@lessons
def test_a_lesson_holds_no_method_and_no_solution(path):
    """It imports this package, NumPy and pandas, and its functions are left to the student."""
    cells = nbformat.read(path, as_version=4).cells
    tree = ast.parse("\n".join(cell.source for cell in cells if cell.cell_type == "code"))
    for node in ast.walk(tree):
        assert not isinstance(node, ast.ClassDef)
        if isinstance(node, ast.FunctionDef):
            assert ast.unparse(node.body[0]) == "return ..."
        if isinstance(node, ast.ImportFrom):
            assert node.module.split(".")[0] in ALLOWED
        if isinstance(node, ast.Import):
            assert {alias.name.split(".")[0] for alias in node.names} <= ALLOWED


def _names(cells: list[Any], context: type[ast.expr_context]) -> set[str]:
    """List the names that cells define (Store) or need (Load)."""
    nodes = [node for cell in cells for node in ast.walk(ast.parse(cell.source))]
    return {
        node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, context)
    }


@lessons
def test_no_cell_needs_what_an_exercise_defines(path):
    """A student's cell may fail as a whole, and the rest runs all the same."""
    notebook = nbformat.read(path, as_version=4)
    exercises = _cells(notebook, "exercise")
    others = [c for c in notebook.cells if c.cell_type == "code" and c not in exercises]
    own = _names(exercises, ast.Store) - _names(others, ast.Store)
    assert own & _names(others, ast.Load) == set()


def _run(path: Path, folder: Path, kernel: str, *, solutions: bool) -> Any:
    """Run a lesson from top to bottom, from another folder."""
    return papermill.execute_notebook(
        path,
        folder / "executed.ipynb",
        parameters={"solutions": solutions},
        kernel_name=kernel,
        progress_bar=False,
        cwd=folder,
    )


def _shown(cell: Any) -> str:
    """Give what a cell's last expression shows as text."""
    results = [output for output in cell.outputs if output.output_type == "execute_result"]
    return results[-1].data["text/plain"] if results else ""


@lessons
def test_a_lesson_runs_with_solutions(path, tmp_path, kernel):
    """The lesson's own solutions solve every exercise, and their code is shown."""
    notebook = _run(path, tmp_path, kernel, solutions=True)
    cells = _cells(notebook, "exercise")
    assert [_shown(cell).split(":")[0] for cell in cells] == [
        f"✓ Solved ({key})" for key in _exercises(path)
    ]
    assert all("def " in _shown(cell) for cell in cells)
    assert _shown(notebook.cells[-1]) == f"{len(cells)} of {len(cells)} exercises solved"


@lessons
def test_a_lesson_runs_without_answers(path, tmp_path, kernel):
    """Every exercise says what to do, no solution is shown, and all the rest runs."""
    notebook = _run(path, tmp_path, kernel, solutions=False)
    cells = _cells(notebook, "exercise")
    assert [_shown(cell).split(":")[0] for cell in cells] == [
        f"… To do ({key})" for key in _exercises(path)
    ]
    assert not any("def " in _shown(cell) for cell in cells)
    assert _shown(notebook.cells[-1]).startswith(f"0 of {len(cells)} exercises solved")
