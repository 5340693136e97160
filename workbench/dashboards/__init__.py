"""Applications for notebooks: they hold state and show it; no algorithm lives here."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from workbench.dashboards.author import MotionAuthor, author_motion
    from workbench.dashboards.compare import ProjectionComparison, compare_projections
    from workbench.dashboards.explain import OptimizerExplanation, explain_optimizer
    from workbench.dashboards.inspector import KeyframeInspector, inspect_keyframes
    from workbench.dashboards.panels import Panel
    from workbench.dashboards.study_analysis import StudyAnalysis, analyse_study
    from workbench.dashboards.study_participation import StudyParticipation, take_part_in_study
    from workbench.dashboards.study_preparation import StudyPreparation, prepare_study

_HOMES = {
    "KeyframeInspector": "inspector",
    "MotionAuthor": "author",
    "OptimizerExplanation": "explain",
    "Panel": "panels",
    "ProjectionComparison": "compare",
    "StudyAnalysis": "study_analysis",
    "StudyParticipation": "study_participation",
    "StudyPreparation": "study_preparation",
    "analyse_study": "study_analysis",
    "author_motion": "author",
    "compare_projections": "compare",
    "explain_optimizer": "explain",
    "inspect_keyframes": "inspector",
    "prepare_study": "study_preparation",
    "take_part_in_study": "study_participation",
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
