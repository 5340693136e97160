"""Views for notebooks: traits in Python, everything that follows the mouse in the browser."""

from __future__ import annotations

from workbench.widgets.details import SampleDetails
from workbench.widgets.figure import FigureView
from workbench.widgets.landscape import LandscapeView
from workbench.widgets.pose import PoseView
from workbench.widgets.reconstruction import ReconstructionView
from workbench.widgets.scatter import ScatterPanels
from workbench.widgets.status import StatusLine

__all__ = [
    "FigureView",
    "LandscapeView",
    "PoseView",
    "ReconstructionView",
    "SampleDetails",
    "ScatterPanels",
    "StatusLine",
]
