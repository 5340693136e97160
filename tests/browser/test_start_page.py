"""The notebook on which JupyterLab opens."""

from __future__ import annotations

import re

import nbformat
import pytest

from tests.browser.chromium import Visit
from tests.browser.lab import Lab
from workbench.cli.dashboards import DASHBOARDS
from workbench.reproduction.items import NOTEBOOKS
from workbench.resources import bundled

START = "start.ipynb"


def linked() -> list[str]:
    """List the addresses of the start page's links."""
    cells = nbformat.read(bundled("notebooks") / START, as_version=4).cells
    return re.findall(r"\]\(([^)]+)\)", "\n".join(cell.source for cell in cells))


def test_every_notebook_can_be_reached() -> None:
    """Figures, lessons and dashboards have one link each, and each link has its notebook."""
    folder = bundled("notebooks")
    links = linked()
    assert len(links) == len(set(links))
    assert [link for link in links if not (folder / link).is_file()] == []
    lessons = [f"lessons/{path.name}" for path in sorted((folder / "lessons").glob("*.ipynb"))]
    assert [link for link in links if link.startswith("lessons/")] == lessons
    wanted = {f"{notebook.name}.ipynb" for notebook in NOTEBOOKS}
    wanted |= {f"{name}.ipynb" for name in DASHBOARDS}
    assert wanted <= set(links)


def test_notebooks_of_figures_are_in_the_order_of_the_theses() -> None:
    """They stand as the report shows them."""
    names = [link.removesuffix(".ipynb") for link in linked()]
    figures = [notebook.name for notebook in NOTEBOOKS]
    by_chapter = sorted(figures, key=lambda name: not name.startswith(("costa", "halit")))
    moved = [name for name in names if name in figures]
    assert moved[:10] == by_chapter[:10]
    assert set(moved) == set(figures)


def test_every_published_figure_is_named_beside_its_notebook() -> None:
    """The start page says which figures and tables a notebook makes."""
    cells = nbformat.read(bundled("notebooks") / START, as_version=4).cells
    rows = dict(re.findall(r"\]\((\w+)\.ipynb\) \| (.+) \|", "\n".join(c.source for c in cells)))
    for notebook in NOTEBOOKS:
        numbers = [
            re.search(r"(?:fig|tab|sec)([\w.]+)$", item.id)[1]
            for item in notebook.items
            if not item.id.startswith("extra")
        ]
        for number in {numbers[0], numbers[-1]} if numbers else ():
            assert number in rows[notebook.name], (notebook.name, number)


@pytest.mark.browser
def test_a_dashboard_is_one_click_away(lab: Lab, visit: Visit) -> None:
    """The start page is shown as text, and its links open notebooks in tabs of their own."""
    page = visit.page
    page.set_default_timeout(90_000)
    page.goto(lab.page(START))
    page.get_by_role("heading", name="Workbench").wait_for()
    link = page.get_by_role("link", name="Compare projections")
    link.click()
    page.wait_for_function(
        "jupyterapp.shell.currentWidget.title.label === 'compare_projections.ipynb'"
    )
    assert page.get_by_role("tab", name=START).is_visible()
