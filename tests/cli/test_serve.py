"""Tests of the commands that start servers."""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import sys
import urllib.error
import urllib.request
from importlib.util import find_spec
from pathlib import Path
from types import SimpleNamespace

import pytest

from workbench.cli import serve
from workbench.cli.dashboards import DASHBOARDS, describe_dashboard
from workbench.resources import bundled

HAS_VOILA = find_spec("voila") is not None
if HAS_VOILA or os.environ.get("CI") == "true":  # what is missing there must not be skipped
    from workbench.cli import dashboard_server

needs_voila = pytest.mark.skipif(not HAS_VOILA, reason="needs the extra 'app'")


@pytest.fixture(scope="module")
def free_port():
    """Find a port that nothing listens on."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def test_lab_listens_on_this_machine_only_and_opens_the_notebooks():
    """JupyterLab gets the loopback address, the notebooks, and options after --."""
    words = [sys.executable, "-m", "workbench", "lab", "--", "--show-config-json"]
    shown = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    config = json.loads(shown)
    assert config["ServerApp"]["ip"] == "127.0.0.1"
    assert Path(config["ServerApp"]["root_dir"]) == bundled("notebooks")
    assert config["LabApp"]["default_url"] == "/lab/tree/start.ipynb"


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """Make notebooks as a wheel carries them, in folders."""
    folder = tmp_path / "site-packages" / "notebooks"
    for name in ("a.ipynb", "b.ipynb", "lessons/1_first.ipynb"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("as shipped")
    monkeypatch.setattr(serve, "bundled", lambda _: folder)
    return folder


def test_an_installed_package_opens_a_copy_that_is_the_users(installed, tmp_path, capsys):
    """Notebooks are copied with their folders, and the terminal says where they are."""
    folder = tmp_path / "mine"
    assert serve._notebooks(folder) == folder
    copied = sorted(str(path.relative_to(folder)) for path in folder.rglob("*.ipynb"))
    assert copied == ["a.ipynb", "b.ipynb", "lessons/1_first.ipynb"]
    assert capsys.readouterr().err == f"workbench: notebooks are in {folder}, 3 added\n"


def test_a_later_version_adds_notebooks_and_overwrites_none(installed, tmp_path, capsys):
    """What the user edited stays as it is, what is missing comes, and both are said."""
    folder = tmp_path / "mine"
    serve._notebooks(folder)
    (folder / "lessons" / "1_first.ipynb").write_text("solved")
    (installed / "lessons" / "2_second.ipynb").write_text("as shipped")
    capsys.readouterr()
    serve._notebooks(folder)
    assert (folder / "lessons" / "1_first.ipynb").read_text() == "solved"
    assert (folder / "lessons" / "2_second.ipynb").read_text() == "as shipped"
    said = capsys.readouterr().err
    assert "1 added, 1 kept that differ from those of this version" in said


@pytest.fixture(scope="module")
def app(free_port):
    """Start the dashboards' server and read its address as a user would."""
    words = [sys.executable, "-m", "workbench", "app", "--", "--no-browser"]
    server = subprocess.Popen(
        [*words, f"--port={free_port}"], stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    try:
        lines = iter(server.stderr.readline, "")
        yield next(found[0] for line in lines if (found := re.search(r"http://\S+", line)))
    finally:
        os.killpg(server.pid, signal.SIGTERM)
        server.wait(timeout=60)
        server.stderr.close()


@needs_voila
def test_app_wants_a_token(app, free_port):
    """Without the token in the printed address there is a login page, with it the index."""
    assert app.startswith(f"http://127.0.0.1:{free_port}/?token=")
    for path in ("", "?token=guess", "voila/render/compare_projections.ipynb"):
        with urllib.request.urlopen(f"http://127.0.0.1:{free_port}/{path}") as answer:
            assert "/login" in answer.url
    with urllib.request.urlopen(app) as answer:
        page = answer.read().decode()
    for name in DASHBOARDS:
        assert f'href="/voila/render/{name}.ipynb"' in page


@needs_voila
def test_app_serves_the_dashboards_and_nothing_else(app):
    """An unknown page, and a notebook that is no dashboard, give a plain page that says so."""
    root, _, token = app.partition("?")
    for path in ("nothing", "voila/render/optimizers.ipynb", "voila/render/../start.ipynb"):
        with pytest.raises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(f"{root}{path}?{token}")
        with refused.value as answer:
            page = answer.read().decode()
        assert answer.code == 404
        assert "Not Found" in page
        assert "Traceback" not in page


@pytest.mark.parametrize("name", DASHBOARDS)
def test_each_dashboard_has_a_heading_and_a_sentence(name):
    """The index shows what the notebook says of itself."""
    described = describe_dashboard(bundled("notebooks") / f"{name}.ipynb")
    assert described.title
    assert described.summary.endswith(".")


@needs_voila
def test_the_browser_is_opened_with_the_token(monkeypatch):
    """The page that opens by itself is the index, not the login."""
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    server = SimpleNamespace(display_url="http://127.0.0.1:1/?token=t")
    dashboard_server.DashboardServer.launch_browser(server)
    assert opened == ["http://127.0.0.1:1/?token=t"]


def test_app_says_what_to_install(run, monkeypatch):
    """Without Voila the command is one line of advice."""
    monkeypatch.setattr(serve, "find_spec", lambda _: None)
    status, _, err = run("app")
    assert status == 2
    assert "pip install 'workbench[app]'" in err
