"""Tests that the README tells the truth."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
COMMANDS = re.findall(r"^    workbench (.+)$", README, flags=re.M)


def test_the_quick_start_runs(capsys):
    """Ten lines of Python print an error below that of slerp, and more."""
    code = re.search(r"```python\n(.*?)```", README, flags=re.S)[1]
    assert len(code.splitlines()) <= 10
    exec(compile(code, "README.md", "exec"), {})
    optimized, slerp = map(float, capsys.readouterr().out.splitlines()[:2])
    assert optimized < slerp


@pytest.mark.parametrize("command", COMMANDS)
def test_the_commands_exist(run, command):
    """Every command that the README names is there, with every option."""
    words = shlex.split(command)
    options = [word for word in words if word.startswith("--")]
    status, out, _ = run(*words[: 2 if words[0] == "datasets" else 1], "--help")
    assert status == 0
    assert all(option in out for option in options)


def test_links_and_pictures_are_there():
    """Every local link of the README leads to a file."""
    links = re.findall(r"\]\(([^)#:]+)\)", README)
    folder = Path(__file__).parents[1]
    assert links
    assert [link for link in links if not (folder / link).exists()] == []
