"""Tests that docs/methods.md lists what there is."""

from __future__ import annotations

import inspect
import pkgutil
import re
from importlib import import_module
from pathlib import Path

import pytest

import workbench.quality
from workbench.backprojection import back_projectors
from workbench.interpolation import interpolators
from workbench.optimization import optimizers
from workbench.optimization.markers import marker_searches
from workbench.projection import control_point_projectors, projectors
from workbench.selection import selectors

TEXT = (Path(__file__).parents[1] / "docs" / "methods.md").read_text(encoding="utf-8")
COLUMNS = 5

REGISTRIES = {
    "Selectors": selectors,
    "Interpolators": interpolators,
    "Projectors": projectors,
    "Control-point projectors": control_point_projectors,
    "Back-projectors": back_projectors,
    "Optimizers": optimizers,
    "Marker searches": marker_searches,
}

#: Functions of workbench.quality that measure nothing: checks, parts of measures, defaults.
NO_MEASURES = {
    "as_pair",
    "default_neighborhood_size",
    "femur_length",
    "matrix_neighborhood_quality",
    "pair_sums",
    "row_blocks",
}
NO_MEASURES_IN = {"inputs", "ranks"}


def table(title: str) -> dict[str, list[str]]:
    """Read the rows of a section's table: the name, then the cells."""
    section = re.search(rf"^## {re.escape(title)}\n(.*?)(?=^## |\Z)", TEXT, flags=re.M | re.S)
    assert section, f"no section {title}"
    rows = re.findall(r"^\| `([^`]+)`.*$", section[1], flags=re.M)
    lines = re.findall(r"^\| `.*$", section[1], flags=re.M)
    return {
        name: [c.strip() for c in line.strip("|").split("|")]
        for name, line in zip(rows, lines, strict=True)
    }


def measures() -> dict[str, object]:
    """Find the public measures of workbench.quality."""
    found: dict[str, object] = {}
    for module in pkgutil.iter_modules(workbench.quality.__path__):
        if module.name in NO_MEASURES_IN:
            continue
        here = import_module(f"workbench.quality.{module.name}")
        for name, value in vars(here).items():
            own = inspect.isfunction(value) and value.__module__ == here.__name__
            if own and not name.startswith("_") and name not in NO_MEASURES:
                found[name] = value
    return found


@pytest.mark.parametrize("title", REGISTRIES)
def test_every_registered_method_is_listed(title):
    """No method is missing, and none is listed that is not there."""
    assert set(REGISTRIES[title])
    assert set(table(title)) == set(REGISTRIES[title])


def test_every_measure_is_listed():
    """The same of the measures of quality."""
    assert set(table("Quality")) == set(measures())


@pytest.mark.parametrize("title", [*REGISTRIES, "Quality"])
def test_every_row_tells_all(title):
    """Name, what it does, source, reading and cost; an open one has a dash."""
    for name, cells in table(title).items():
        assert len(cells) == COLUMNS, name
        assert all(cells), name


@pytest.mark.parametrize("title", REGISTRIES)
def test_every_method_explains_itself(title):
    """The class has a docstring of its own, and one for each parameter that it takes."""
    for name in REGISTRIES[title]:
        factory = REGISTRIES[title].factory(name)
        text = vars(factory).get("__doc__") or ""
        assert len(text.splitlines()) > 2, name
        for parameter in inspect.signature(factory).parameters:
            assert re.search(rf"\b{parameter}\b", text), f"{name}: {parameter}"


def test_every_measure_explains_itself():
    """Every function has a docstring that names its parameters."""
    for name, function in measures().items():
        text = inspect.getdoc(function) or ""
        assert len(text.splitlines()) > 2, name
        for parameter in inspect.signature(function).parameters:
            assert re.search(rf"\b{parameter}\b", text), f"{name}: {parameter}"


def test_names_of_projectors_that_take_distances_are_marked():
    """(D) stands beside those that have a metric."""
    marked = set(re.findall(r"^\| `([^`]+)` \(D\)", TEXT, flags=re.M))
    assert marked == {name for name in projectors if hasattr(projectors.create(name), "metric")}
