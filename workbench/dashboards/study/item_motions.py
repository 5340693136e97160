"""The motions of a participant's items, made ahead of being shown."""

from __future__ import annotations

from string import ascii_uppercase
from typing import Any

from workbench.study.run import StudyRun
from workbench.study.stimuli import stimulus_motion
from workbench.widgets.player import motion_traits


class ItemMotions:
    """Make the motions of items, and keep those that were made last.

    Parameters
    ----------
    run : StudyRun
        Who takes part.
    """

    def __init__(self, run: StudyRun) -> None:
        self._run = run
        self._made: dict[int, dict[str, Any]] = {}

    def __contains__(self, index: int) -> bool:
        return index in self._made

    def fetch(self, index: int) -> dict[str, Any]:
        """Give what a player shows of an item, by letters, unless it is there already.

        Parameters
        ----------
        index : int
            Which item, from 0; −1 is the exercise.

        Raises
        ------
        DataError
            If a clip is not found, or is another one than the study was prepared with.
        """
        if index not in self._made:
            stimuli = self._run.items[index] if index >= 0 else self._run.design.practice
            letters = ascii_uppercase[: len(stimuli)]
            motions = (stimulus_motion(stimulus) for stimulus in stimuli)
            self._made = {index: motion_traits(dict(zip(letters, motions, strict=True)))}
        return self._made[index]
