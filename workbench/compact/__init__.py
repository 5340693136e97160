"""The compact form of a motion and its file: keyframes, and what tells the other frames.

See :mod:`workbench.compact.reduction` for what is kept and how exactly,
:mod:`workbench.compact.file` for the file, byte by byte, and
:mod:`workbench.compact.sizes` for what that saves.
"""

from __future__ import annotations

from workbench.compact.file import compact_bytes, read_compact, write_compact
from workbench.compact.motion import CompactMotion
from workbench.compact.reduction import compact_motion
from workbench.compact.sizes import Sizes, compare_sizes

__all__ = [
    "CompactMotion",
    "Sizes",
    "compact_bytes",
    "compact_motion",
    "compare_sizes",
    "read_compact",
    "write_compact",
]
