"""Applications for notebooks: they hold state and show it; no algorithm lives here."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from workbench.dashboards.authoring.author import MotionAuthor, author_motion
    from workbench.dashboards.comparison.compare import ProjectionComparison, compare_projections
    from workbench.dashboards.comparison.panels import Panel
    from workbench.dashboards.explanation.explain import OptimizerExplanation, explain_optimizer
    from workbench.dashboards.inspection.inspector import KeyframeInspector, inspect_keyframes
    from workbench.dashboards.study.analysis import StudyAnalysis, analyse_study
    from workbench.dashboards.study.participation import StudyParticipation, take_part_in_study
    from workbench.dashboards.study.preparation import StudyPreparation, prepare_study

_HOMES = {
    "KeyframeInspector": "inspection.inspector",
    "MotionAuthor": "authoring.author",
    "OptimizerExplanation": "explanation.explain",
    "Panel": "comparison.panels",
    "ProjectionComparison": "comparison.compare",
    "StudyAnalysis": "study.analysis",
    "StudyParticipation": "study.participation",
    "StudyPreparation": "study.preparation",
    "analyse_study": "study.analysis",
    "author_motion": "authoring.author",
    "compare_projections": "comparison.compare",
    "explain_optimizer": "explanation.explain",
    "inspect_keyframes": "inspection.inspector",
    "prepare_study": "study.preparation",
    "take_part_in_study": "study.participation",
}

__all__ = [
    "KeyframeInspector",
    "MotionAuthor",
    "OptimizerExplanation",
    "Panel",
    "ProjectionComparison",
    "StudyAnalysis",
    "StudyParticipation",
    "StudyPreparation",
    "analyse_study",
    "author_motion",
    "compare_projections",
    "explain_optimizer",
    "inspect_keyframes",
    "prepare_study",
    "take_part_in_study",
]


# The process that computes beside the kernel imports this package too, and must not wait
# for plotly and ipywidgets.
def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
