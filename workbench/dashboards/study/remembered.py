"""What a participant's tab remembers, so that it goes on after a reload."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from workbench.dashboards.study.files import study_with_id
from workbench.errors import DataError, WorkbenchError
from workbench.study.design import load_design
from workbench.study.run import StudyRun

#: What the memory is called: one name for all studies, since it must tell which of them it was.
MEMORY_NAME = "study"
_PRACTISED = "practised"


@dataclass(frozen=True)
class Remembered:
    """Who a tab belongs to. No path and no method can be told from it.

    Attributes
    ----------
    study_id : str
        Of the study's file.
    code : str
        Of the participant.
    practised : bool
        Whether the exercise is done, which the file does not tell.

    Examples
    --------
    >>> Remembered.of(Remembered("1f", "12-KFM", practised=True).word)
    Remembered(study_id='1f', code='12-KFM', practised=True)
    """

    study_id: str
    code: str
    practised: bool = False

    @classmethod
    def of(cls, word: str) -> Remembered:
        """Read a word that a tab has kept."""
        study_id, _, rest = word.partition(" ")
        code, _, more = rest.partition(" ")
        return cls(study_id, code, more == _PRACTISED)

    @property
    def word(self) -> str:
        """What the tab keeps."""
        return " ".join([self.study_id, self.code, *([_PRACTISED] if self.practised else [])])

    def path(self, opened: Path | None, asked: str) -> Path | None:
        """Find the study.

        Parameters
        ----------
        opened : Path or None
            The study that the page shows.
        asked : str
            The study that the page was asked for, in whose place no other one comes; empty for
            none.

        Returns
        -------
        Path or None
            None if it is not there, or another one was asked for.

        Raises
        ------
        DataError
            If the study that the page shows cannot be read.
        """
        if not self.study_id:
            return None
        if opened is not None and load_design(opened).study_id == self.study_id:
            return opened
        return None if asked else study_with_id(self.study_id)

    def run(self, path: Path) -> StudyRun | None:
        """Go on in a study; None if it does not know the participant.

        Raises
        ------
        DataError
            If it cannot be read.
        """
        try:
            return StudyRun.resume(path, self.code)
        except DataError:
            raise
        except WorkbenchError:
            return None
