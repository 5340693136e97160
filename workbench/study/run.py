"""One participant's way through a study, which goes on wherever it was left."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from workbench.errors import WorkbenchError
from workbench.study.answers import Stimulus
from workbench.study.database import enrol_participant
from workbench.study.design import StudyDesign, load_design
from workbench.study.order import participant_code, participant_of
from workbench.study.participation import participants, rate, ratings_given, settle


class StudyRun:
    """What a participant sees, item by item, and has rated so far.

    Nothing is remembered here but who it is: answers are read from the study's file and written
    to it at once, so that a run which was killed goes on where it was.

    Parameters
    ----------
    path : path-like
        A study made by :func:`workbench.study.design.store_design`.
    participant : int
        Number from :func:`workbench.study.database.enrol_participant`.

    Attributes
    ----------
    design : StudyDesign
        The study.
    participant : int
        Who takes part.
    items : list of tuple of Stimulus
        What is shown, in this participant's order, each from left to right.

    Raises
    ------
    DataError
        If the file is no such study, or the participant is unknown to it.
    """

    def __init__(self, path: str | Path, participant: int) -> None:
        self._path = Path(path)
        self.design: StudyDesign = load_design(path)
        self.participant = participant
        self.items = self.design.shown_to(participant)
        ratings_given(path, participant)  # refuses who is unknown

    @classmethod
    def begin(cls, path: str | Path) -> StudyRun:
        """Enrol another participant."""
        load_design(path)  # nobody is enrolled in what is no study
        return cls(path, enrol_participant(path))

    @classmethod
    def resume(cls, path: str | Path, code: str) -> StudyRun:
        """Go on as the participant who was given a code.

        Raises
        ------
        DataError
            If the file is no such study.
        WorkbenchError
            If it is nobody's code.
        """
        number = participant_of(code, load_design(path).study_id)
        if number not in participants(path):
            raise WorkbenchError(f"code: got {code.strip()!r}, which nobody was given")
        return cls(path, number)

    @property
    def code(self) -> str:
        """What leads back to this participant."""
        return participant_code(self.participant, self.design.study_id)

    @property
    def has_begun(self) -> bool:
        """Whether something was rated."""
        return bool(ratings_given(self._path, self.participant))

    @property
    def current(self) -> int | None:
        """The first item that is not settled; None when all are."""
        given = ratings_given(self._path, self.participant)
        for index, item in enumerate(self.items):
            if not all(s.key in given and given[s.key].settled for s in item):
                return index
        return None

    def ratings(self, index: int) -> list[int]:
        """Tell how an item was rated so far, from left to right; 0 for what was not."""
        given = ratings_given(self._path, self.participant)
        return [given[s.key].rating if s.key in given else 0 for s in self.items[index]]

    def rate(self, index: int, place: int, rating: int) -> None:
        """Store a rating of what stands at a place of an item, both counted from 0.

        Raises
        ------
        WorkbenchError
            If there is no such place, or the rating cannot be stored.
        """
        before = sum(len(item) for item in self.items[:index])
        rate(self._path, self.participant, self._at(index, place), rating, before + place + 1)

    def settle(self, index: int, ratings: Sequence[int]) -> None:
        """Be done with an item.

        Parameters
        ----------
        index : int
            Which one.
        ratings : sequence of int
            What the participant sees of it when going on, from left to right.

        Raises
        ------
        RatingChangedError
            If something else is stored.
        DataError
            If a rating is missing, or it cannot be stored.
        WorkbenchError
            If there is not one rating for each stimulus.
        """
        item = self.items[index]
        if len(ratings) != len(item):
            raise WorkbenchError(f"ratings: got {len(ratings)}, want {len(item)}")
        settle(self._path, self.participant, dict(zip(item, ratings, strict=True)))

    def _at(self, index: int, place: int) -> Stimulus:
        if not 0 <= place < len(self.items[index]):
            raise WorkbenchError(f"place: got {place}, want 0 to {len(self.items[index]) - 1}")
        return self.items[index][place]
