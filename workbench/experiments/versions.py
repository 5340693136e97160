"""Versions of what decides numerical results."""

from __future__ import annotations

import platform
from functools import cache
from importlib.metadata import PackageNotFoundError, version

from workbench import __version__

_PACKAGES = ("numpy", "scipy", "scikit-learn", "umap-learn", "numba")


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
