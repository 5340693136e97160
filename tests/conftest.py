"""Fixtures that tests of several packages share."""

from __future__ import annotations

import os
import sys
from pathlib import Path

# Before anything loads OpenMP: waiting threads that spin slow t-SNE down on a busy machine.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")

import numpy as np
import pytest

from workbench.backprojection import back_projectors
from workbench.cli import main
from workbench.datasets import loaders
from workbench.interpolation import interpolators
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotations_from_euler
from workbench.mocap.skeleton import EndSite, Skeleton
from workbench.optimization import optimizers
from workbench.optimization.markers import marker_searches
from workbench.projection import control_point_projectors, projectors
from workbench.resources import bundled
from workbench.selection import selectors

REGISTRIES = (
    back_projectors,
    control_point_projectors,
    interpolators,
    marker_searches,
    optimizers,
    projectors,
    selectors,
    loaders._registered,
)

#: Files that take longest, those that share a JupyterLab beside each other.
LONGEST = (
    "browser/test_compare_journey.py",
    "browser/test_explain_journey.py",
    "browser/test_inspect_journey.py",
    "browser/test_author_journey.py",
    "browser/test_study_journey.py",
    "browser/test_start_page.py",
    "notebooks/test_lessons.py",
    "projection/test_projection.py",
    "cli/test_cli.py",
    "reproduction/test_reproduce.py",
    "browser/test_voila.py",
    "browser/test_authoring_pad.py",
    "dashboards/test_author.py",
    "notebooks/test_notebooks.py",
    "dashboards/test_compare.py",
    "dashboards/test_inspector.py",
    "dashboards/test_study_killed_kernel.py",
    "test_schemes.py",
    "cli/test_compaction.py",
    "experiments/test_grid_faults.py",
)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Start the files that take longest first, lest one of them runs alone at the end."""
    places = {Path(__file__).parent / name: place for place, name in enumerate(LONGEST)}
    items.sort(key=lambda item: places.get(item.path, len(places)))


@pytest.fixture(autouse=True)
def registrations_end_with_the_test():
    """Forget what a test has registered, so that no other test finds it."""
    before = [dict(registry._entries) for registry in REGISTRIES]
    yield
    for registry, entries in zip(REGISTRIES, before, strict=True):
        registry._entries = entries


def data_folders() -> list[Path]:
    """List the data folders in the package's search order."""
    named = [Path(p) for p in os.environ.get("WORKBENCH_DATA", "").split(os.pathsep) if p]
    return [*named, bundled("datasets")]


def find_clip(name: str) -> Path:
    """Find a BVH file of the data folders, or skip the test and say which one is missing."""
    for folder in data_folders():
        path = folder / "mocap" / "bvh" / f"{name}.bvh"
        if path.is_file():
            return path
    pytest.skip(f"needs {name}.bvh in a folder named by WORKBENCH_DATA")


@pytest.fixture
def arm() -> Skeleton:
    """Give a skeleton of a root with two chains: bones of 1 + 2 + 3, and of 1."""
    channels = ("Zrotation", "Yrotation", "Xrotation")
    return Skeleton(
        names=("root", "upper", "lower", "other"),
        parents=np.array([-1, 0, 1, 0]),
        offsets=np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 1]], dtype=float),
        end_sites=(EndSite(2, np.array([0.0, 0.0, 3.0])), EndSite(3, np.zeros(3))),
        channels=(("Xposition", "Yposition", "Zposition", *channels), *[channels] * 3),
    )


@pytest.fixture
def waving(arm: Skeleton) -> Motion:
    """Give a smooth motion of that skeleton, 60 frames long."""
    t = np.linspace(0, 2 * np.pi, 60)
    angles = np.stack(
        [
            np.stack([40 * np.sin(t), 20 * np.cos(t), 10 * np.sin(2 * t)], axis=1),
            np.stack([30 * np.cos(t), 0 * t, 50 * np.sin(t)], axis=1),
            np.stack([0 * t, 60 * np.sin(t + 1), 0 * t], axis=1),
            np.stack([5 * np.sin(3 * t), 0 * t, 0 * t], axis=1),
        ],
        axis=1,
    )
    path = np.stack([t, np.sin(t), 0 * t], axis=1)
    return Motion(arm, rotations_from_euler("ZYX", angles), path, 1 / 30, name="waving")


@pytest.fixture
def run(monkeypatch, capsys):
    """Run the command line in this process; give status, standard output and error."""

    def call(*words):
        monkeypatch.setattr(sys, "argv", ["workbench", *map(str, words)])
        with pytest.raises(SystemExit) as ending:
            main()
        captured = capsys.readouterr()
        return ending.value.code, captured.out, captured.err

    return call
