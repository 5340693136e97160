"""The kernel of the notebooks that are run here."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from workbench.reproduction.notebooks import this_interpreter


@pytest.fixture(scope="module")
def kernel() -> Iterator[str]:
    """Name a kernel of this interpreter, which imports once for all notebooks of a module."""
    with this_interpreter():
        yield "python3"
