"""The dashboards served by Voila, as a person without JupyterLab meets them."""

from __future__ import annotations

import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import workbench
from tests.browser.axe import violations
from tests.browser.chromium import Visit
from tests.browser.lab import wait_for_panels

if os.environ.get("CI") != "true":  # what is missing there must not be skipped
    pytest.importorskip("voila", reason="needs the extra 'app'")
pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Start `workbench app` in an empty folder and read its address from the terminal."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    folder = tmp_path_factory.mktemp("app")
    env = {
        **os.environ,
        "PYTHONPATH": str(Path(workbench.__file__).parents[1]),
        "JUPYTER_CONFIG_DIR": str(folder / "config"),
        "JUPYTER_RUNTIME_DIR": str(folder / "runtime"),
        "IPYTHONDIR": str(folder / "ipython"),
        "WORKBENCH_DATA": "",
        "WORKBENCH_CACHE": str(folder / "cache"),
    }
    words = [sys.executable, "-m", "workbench", "app", "--", "--no-browser", f"--port={port}"]
    server = subprocess.Popen(
        words, env=env, cwd=folder, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    try:
        lines = iter(server.stderr.readline, "")
        yield next(found[0] for line in lines if (found := re.search(r"http://\S+", line)))
    finally:
        os.killpg(server.pid, signal.SIGTERM)
        server.wait(timeout=60)
        server.stderr.close()


def test_a_dashboard_is_one_click_from_the_printed_address(address: str, visit: Visit) -> None:
    """The index leads to the comparison, whose panels appear; nothing leaves the machine."""
    page = visit.page
    page.goto(address.partition("?")[0])
    assert "/login" in page.url

    page.goto(address)
    assert page.get_by_role("heading", level=1).inner_text() == "Dashboards"
    assert violations(page) == []
    with page.context.expect_page() as opened:
        page.get_by_role("link", name="Compare projections").click()
    dashboard = opened.value
    dashboard.on("console", visit.note_message)
    dashboard.on("pageerror", lambda error: visit.complaints.append(str(error)))
    dashboard.set_default_timeout(90_000)
    wait_for_panels(dashboard, "sample")
    assert dashboard.get_by_label("Projector A", exact=True).is_visible()
    assert dashboard.locator(".jp-CodeCell .jp-InputArea").count() == 0
    assert violations(dashboard, "#rendered_cells") == []
