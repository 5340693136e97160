"""Applications for notebooks: they hold state and show it; no algorithm lives here."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from workbench.dashboards.compare import ProjectionComparison, compare_projections
    from workbench.dashboards.explain import OptimizerExplanation, explain_optimizer
    from workbench.dashboards.inspector import KeyframeInspector, inspect_keyframes
    from workbench.dashboards.panels import Panel

_HOMES = {
    "KeyframeInspector": "inspector",
    "OptimizerExplanation": "explain",
    "Panel": "panels",
    "ProjectionComparison": "compare",
    "compare_projections": "compare",
    "explain_optimizer": "explain",
    "inspect_keyframes": "inspector",
}

__all__ = [
    "KeyframeInspector",
    "OptimizerExplanation",
    "Panel",
    "ProjectionComparison",
    "compare_projections",
    "explain_optimizer",
    "inspect_keyframes",
]


# The process that computes beside the kernel imports this package too, and must not wait
# for plotly and ipywidgets.
def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
