"""The notebooks as files, and run with few data."""

from __future__ import annotations

import ast
from collections.abc import Callable
from pathlib import Path
from typing import Any

import nbformat
import papermill
import pytest

from tests.check_notebooks import problems
from workbench.reproduction.items import EXTRAS, ITEMS, NOTEBOOKS
from workbench.reproduction.outputs import read_parts
from workbench.resources import bundled

NAMES = sorted({item.notebook for item in ITEMS})

#: What a notebook may import besides this package: it shows, it does not compute.
ALLOWED = {"workbench", "IPython"}


def _path(name: str) -> Path:
    return bundled("notebooks") / f"{name}.ipynb"


@pytest.mark.parametrize("name", NAMES)
def test_every_item_has_a_clean_notebook(name):
    """It is there, valid, without outputs, counts or records of a run."""
    nbformat.validate(nbformat.read(_path(name), as_version=4))
    assert problems(_path(name)) == []


@pytest.mark.parametrize("name", NAMES)
def test_one_cell_holds_the_parameters(name):
    """Each notebook takes the profile, the seed, the processes and the folders."""
    cells = nbformat.read(_path(name), as_version=4).cells
    tagged = [cell for cell in cells if "parameters" in cell.metadata.get("tags", [])]
    assert len(tagged) == 1
    names = {node.targets[0].id for node in ast.parse(tagged[0].source).body}
    assert {"profile", "seed", "jobs", "out", "results"} <= names


@pytest.mark.parametrize("name", [notebook.name for notebook in NOTEBOOKS if notebook.runs])
def test_runs_of_a_notebook_can_be_executed_elsewhere(name):
    """A notebook that reads runs takes the address of a scheduler and passes it on."""
    source = "\n".join(cell.source for cell in nbformat.read(_path(name), as_version=4).cells)
    assert source.count("scheduler = None") == source.count("run_grid(") == 1
    assert "scheduler=scheduler" in source


@pytest.mark.parametrize("name", NAMES)
def test_notebooks_hold_no_algorithm(name):
    """They import this package and what displays results, and define no function."""
    cells = nbformat.read(_path(name), as_version=4).cells
    tree = ast.parse("\n".join(cell.source for cell in cells if cell.cell_type == "code"))
    for node in ast.walk(tree):
        assert not isinstance(node, (ast.FunctionDef, ast.ClassDef, ast.Lambda))
        if isinstance(node, ast.ImportFrom):
            assert node.module.split(".")[0] in ALLOWED
        if isinstance(node, ast.Import):
            assert {alias.name.split(".")[0] for alias in node.names} <= ALLOWED


@pytest.fixture
def run(tmp_path: Path, kernel: str) -> Callable[..., list[dict]]:
    """Run a notebook as a user does, from another folder; give what it left."""

    def run(name: str, **parameters: Any) -> list[dict]:
        papermill.execute_notebook(
            _path(name),
            tmp_path / "executed.ipynb",
            parameters={
                "out": str(tmp_path),
                "results": str(tmp_path / "results"),
                "jobs": 1,
                **parameters,
            },
            kernel_name=kernel,
            progress_bar=False,
            cwd=tmp_path,
        )
        return read_parts(tmp_path)

    return run


def test_table_5_1_runs_on_one_clip(run):
    """With one clip and two schemes, the notebook makes its figure and both tables."""
    parts = run("costa2018_table_5_1", clips=["cmu/01_01-jump"], schemes=["Slerp", "PCA"], seed=3)
    made = {(part["item"], part["kind"], part["name"]) for part in parts}
    assert made == {
        ("costa2018:fig5.3", "figure", "costa2018_fig5.3"),
        ("costa2018:tab5.1", "table", "costa2018_tab5.1"),
        ("costa2018:tab5.1", "table", "costa2018_tab5.1_against_slerp"),
    }
    assert all("1 CMU clip of 300 frames" in part["caption"] for part in parts[:2])


def test_figure_5_13_runs_alone(run):
    """Asked for one figure, the notebook makes that figure, its values and its table."""
    parts = run("costa2018_uci", items=["costa2018:fig5.13"])
    assert {part["item"] for part in parts} == {"costa2018:fig5.13"}
    assert sorted(part["kind"] for part in parts) == ["figure", "table", "values"]


def test_optimizers_run_on_one_clip(run):
    """With one clip and one projector, the notebook makes its figure and its three tables."""
    parts = run("optimizers", clips=["cmu/01_01-jump"], projectors=["PCA"])
    made = {(part["item"], part["kind"], part["name"]) for part in parts}
    assert made == {
        ("extra:optimizers", "figure", "extra_optimizers"),
        ("extra:optimizers", "table", "extra_optimizers"),
        ("extra:optimizers", "table", "extra_optimizers_higher"),
        ("extra:optimizers", "table", "extra_optimizers_markers"),
    }


def test_ids_are_unique_and_every_extra_has_a_notebook():
    """No id stands for two things."""
    ids = [item.id for item in (*ITEMS, *EXTRAS)]
    assert len(ids) == len(set(ids))
    assert {item.notebook for item in EXTRAS} <= set(NAMES)
