"""Make the pictures of the dashboard for the README: ``python -m tests.browser.make_screenshots``.

The pictures come from JupyterLab with the notebook and the bundled data, so that anyone can
make them again.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

from tests.browser.chromium import Visit, open_browser
from tests.browser.lab import Lab, choose_data, open_and_run, running_lab, wait_for_panels
from workbench.resources import bundled

NOTEBOOK = "compare_projections.ipynb"
DATA = "cmu/01_01-jump"
THEMES = {"light": "JupyterLab Light", "dark": "JupyterLab Dark"}


def main(folder: str = "docs/images") -> int:
    """Write ``dashboard-light.png`` and ``dashboard-dark.png`` to a folder."""
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary, open_browser() as browser:
        if browser is None:
            print("no chromium on this machine: cannot make pictures", file=sys.stderr)
            return 1
        notebooks = Path(temporary, "notebooks")
        notebooks.mkdir()
        shutil.copy(bundled("notebooks") / NOTEBOOK, notebooks)
        with running_lab(Path(temporary, "lab"), notebooks, {"WORKBENCH_DATA": ""}) as lab:
            viewport = {"width": 1280, "height": 1130}
            with Visit.to(browser, viewport=viewport) as visit:
                picture_dashboard(visit.page, lab, target)
    return 0


def picture_dashboard(page: Any, lab: Lab, target: Path) -> None:
    """Take pictures of the comparison with a motion, some frames selected and one hovered."""
    open_and_run(page, lab, NOTEBOOK)
    wait_for_panels(page, "sample")
    choose_data(page, DATA)
    wait_for_panels(page, "frame")
    # Only the dashboard, as wide as a notebook is without the list of files.
    page.evaluate("jupyterapp.commands.execute('application:toggle-left-area')")
    page.locator(".wb-plot").first.scroll_into_view_if_needed()
    for name, theme in THEMES.items():
        page.evaluate(
            "(theme) => jupyterapp.commands.execute('apputils:change-theme', { theme })", theme
        )
        wait_for_theme(page, name)
        select_and_hover(page)
        page.locator(".jp-OutputArea-output").first.screenshot(
            path=target / f"dashboard-{name}.png"
        )


def wait_for_theme(page: Any, name: str) -> None:
    """Wait until the page and the plotly figure have the theme's colours."""
    light = str(name == "light").lower()
    page.wait_for_function(f"document.body.dataset.jpThemeLight === '{light}'")
    page.wait_for_function(
        """(dark) => {
          const { fill } = document.querySelector(".js-plotly-plot .gtitle").style;
          return (Number(fill.match(/\\d+/)[0]) > 128) === dark;
        }""",
        arg=name == "dark",
    )


def select_and_hover(page: Any) -> None:
    """Brush the first panel, then move to a frame with the keyboard."""
    box = page.locator(".wb-base").first.bounding_box()
    page.mouse.move(box["x"] + box["width"] * 0.05, box["y"] + box["height"] * 0.05)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.5, box["y"] + box["height"] * 0.55, steps=4)
    page.mouse.up()
    page.mouse.move(0, 0)
    page.locator(".wb-plot").first.focus()
    page.keyboard.press("Home")
    for _ in range(16):
        page.keyboard.press("ArrowUp")


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
