"""What tests of grids share."""

from __future__ import annotations

import pytest

from workbench.projection import projectors
from workbench.projection.pca import PCA


@pytest.fixture
def counted(monkeypatch) -> list[int]:
    """Register a projector "counted" and give the list to which each projection adds."""
    calls: list[int] = []

    class Counted(PCA):
        def _project(self, X):
            calls.append(len(X))
            return super()._project(X)

    monkeypatch.setitem(projectors._entries, "counted", Counted)
    return calls
