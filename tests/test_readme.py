"""Tests that the README tells the truth."""

from __future__ import annotations

import re
import shlex
import textwrap
from pathlib import Path

import pytest

from workbench.backprojection import back_projectors
from workbench.datasets import load_space, loaders
from workbench.projection import control_point_projectors, projectors
from workbench.schemes import SpatialScheme
from workbench.selection import selectors

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
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


def test_the_examples_for_contributors_run(monkeypatch):
    """The snippets of CONTRIBUTING.md register methods and data that then work by name."""
    registries = (projectors, control_point_projectors, selectors, back_projectors)
    for registry in (*registries, loaders._registered):
        monkeypatch.setattr(registry, "_entries", dict(registry._entries))
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    blocks = re.findall(r"(?:^    .*\n|^\n(?=    ))+", text, flags=re.M)
    exec(textwrap.dedent("".join(blocks)), {})
    space = load_space("mine/cube")
    scheme = SpatialScheme("axes", selector="nearest", back_projector="forest")
    assert scheme.run(space, ratio=0.2, random_state=0).error > 0
    around = SpatialScheme("axes", two_step="nearest-control-point", selector="nearest")
    assert 7 in around.run(space, ratio=0.2, fixed=[7], random_state=0).control_points


def test_links_and_pictures_are_there():
    """Every local link of the README leads to a file."""
    links = re.findall(r"\]\(([^)#:]+)\)", README)
    assert links
    assert [link for link in links if not (ROOT / link).exists()] == []
