"""Tests of the commands that start servers."""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest

from workbench.cli import serve
from workbench.resources import bundled


@pytest.fixture
def free_port():
    """Find a port that nothing listens on."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def test_lab_listens_on_this_machine_only_and_opens_the_notebooks():
    """JupyterLab gets the loopback address, the notebooks, and options after --."""
    words = [sys.executable, "-m", "workbench", "lab", "--", "--show-config-json"]
    shown = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    config = json.loads(shown)["ServerApp"]
    assert config["ip"] == "127.0.0.1"
    assert Path(config["root_dir"]) == bundled("notebooks")


def test_an_installed_package_opens_a_copy_that_is_the_users(tmp_path, monkeypatch):
    """Notebooks are copied where they may be edited, and an edited one is never overwritten."""
    installed = tmp_path / "site-packages" / "notebooks"
    installed.mkdir(parents=True)
    for name in ("a.ipynb", "b.ipynb"):
        (installed / name).write_text("as shipped")
    monkeypatch.setattr(serve, "bundled", lambda _: installed)
    folder = tmp_path / "mine"
    assert serve._notebooks(folder) == folder
    (folder / "a.ipynb").write_text("edited")
    (folder / "b.ipynb").unlink()
    serve._notebooks(folder)
    assert (folder / "a.ipynb").read_text() == "edited"
    assert (folder / "b.ipynb").read_text() == "as shipped"


def test_app_wants_a_token(free_port):
    """Without the token in the printed address there is a login page, with it the dashboard."""
    pytest.importorskip("voila", reason="needs the extra 'app'")
    words = [sys.executable, "-m", "workbench", "app", "--", "--no-browser"]
    server = subprocess.Popen(
        [*words, f"--port={free_port}"], stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    try:
        lines = iter(server.stderr.readline, "")
        address = next(found[0] for line in lines if (found := re.search(r"http://\S+", line)))
        assert address.startswith(f"http://127.0.0.1:{free_port}/?token=")
        for guess in ("", "?token=guess"):
            with urllib.request.urlopen(f"http://127.0.0.1:{free_port}/{guess}") as answer:
                assert "/login" in answer.url
    finally:
        os.killpg(server.pid, signal.SIGTERM)
        server.wait(timeout=60)
        server.stderr.close()


def test_app_says_what_to_install(run, monkeypatch):
    """Without Voila the command is one line of advice."""
    monkeypatch.setattr(serve, "find_spec", lambda _: None)
    status, _, err = run("app")
    assert status == 2
    assert "pip install 'workbench[app]'" in err
