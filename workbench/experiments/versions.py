"""Versions of what decides numerical results."""

from __future__ import annotations

import hashlib
import platform
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from workbench import __version__

_PACKAGES = ("numpy", "scipy", "scikit-learn", "umap-learn", "numba")

#: Parts of this package that decide no result: what shows results, what starts runs, and what
#: reads data, whose content has a checksum of its own.
_NOT_NUMERICAL = (
    "__main__.py",
    "authoring",
    "cli",
    "dashboards",
    "datasets",
    "errors.py",
    "experiments",
    "figures",
    "reproduction",
    "resources.py",
    "study",
    "widgets",
)
#: The part of experiments that does decide results.
_RUNS = "experiments/runs/"


@cache
def versions() -> dict[str, str]:
    """Tell the versions of Python, this package and those that decide numerical results."""
    found = {"python": platform.python_version(), "workbench": __version__}
    for package in _PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:  # an optional projector's package may be left out
            found[package] = "not installed"
    return found


@cache
def code_digest() -> str:
    """Compute a digest of the code of this package that decides numerical results.

    In an editable checkout the code changes while the version stays. What is not listed as
    without influence counts, so that a new module is not forgotten.

    Returns
    -------
    str
        SHA-256 in hexadecimal digits.
    """
    return digest_of_code(Path(__file__).resolve().parents[1])


def digest_of_code(package: Path) -> str:
    """Compute the digest of :func:`code_digest` for a package folder."""
    digest = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        name = path.relative_to(package).as_posix()
        if name.split("/")[0] not in _NOT_NUMERICAL or name.startswith(_RUNS):
            digest.update(name.encode() + b"\0")
            digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()
