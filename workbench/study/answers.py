"""What a user study collects: one rating per participant and stimulus."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any

from workbench.errors import DataError

if TYPE_CHECKING:
    import pandas as pd

#: The scale of Halit 2010, chapter 5; the highest is the best.
LOWEST_RATING, HIGHEST_RATING = 1, 10

#: What every table of answers tells, and what it may tell.
REQUIRED_COLUMNS = ("participant", "test_case", "motion", "stimulus", "rating")
COLUMNS = (*REQUIRED_COLUMNS, "position", "parameters")


@dataclass(frozen=True)
class Stimulus:
    """A motion as participants see it.

    Attributes
    ----------
    test_case : str
        The question that the stimulus belongs to, such as "methods"; one motion may be
        shown in several.
    motion : str
        What is shown side by side: all stimuli of one test case and motion.
    name : str
        How it was made, such as "original" or "saliency"; hidden from participants.
    parameters : dict
        Everything that is needed to make it again: clip, selector, count, settings. JSON.

    Examples
    --------
    >>> Stimulus("methods", "walking", "uniform", {"clip": "cmu/02_01", "count": 10}).key
    ('methods', 'walking', 'uniform')
    """

    test_case: str
    motion: str
    name: str
    # No part of equality: a stimulus is known by its names, and a dict has no hash.
    parameters: Mapping[str, Any] = field(default_factory=dict, compare=False)

    @property
    def key(self) -> tuple[str, str, str]:
        """What tells it from others: test case, motion and name."""
        return self.test_case, self.motion, self.name

    @property
    def parameters_text(self) -> str:
        """The parameters as JSON with sorted keys.

        Raises
        ------
        DataError
            If they hold what JSON has no word for.
        """
        try:
            return json.dumps(
                dict(self.parameters), sort_keys=True, ensure_ascii=False, allow_nan=False
            )
        except (TypeError, ValueError) as error:
            raise DataError(
                f"stimulus {' / '.join(self.key)}: parameters that are no JSON ({error})"
            ) from None


def check_answers(frame: pd.DataFrame, source: str = "answers") -> pd.DataFrame:
    """Check a table of answers and give it the columns and types that all else relies on.

    Parameters
    ----------
    frame : DataFrame
        One row per answer, with the columns

        - ``participant``: a number or a made-up code, never a name,
        - ``test_case``, ``motion``, ``stimulus``: what was rated (see :class:`Stimulus`),
        - ``rating``: a whole number from 1 to 10, 10 being the best,
        - ``position``, may be missing: the place of the stimulus in the order that this
          participant saw, from 1,
        - ``parameters``, may be missing: a JSON object that says how the stimulus was made.

        Other columns are left out.
    source : str
        Where the table comes from, for messages.

    Returns
    -------
    DataFrame
        The columns in that order; text but for ``rating`` and ``position`` (0: not told).

    Raises
    ------
    DataError
        If a column is missing, a value is not as said, a participant rates a stimulus twice
        or a stimulus has two different parameters.

    Examples
    --------
    >>> import pandas as pd
    >>> frame = pd.DataFrame([(1, "methods", "walking", "uniform", 7)], columns=REQUIRED_COLUMNS)
    >>> check_answers(frame)[["participant", "rating", "position"]].to_dict("records")
    [{'participant': '1', 'rating': 7, 'position': 0}]
    """
    if not hasattr(frame, "columns"):
        raise DataError(f"{source}: got {type(frame).__name__}, want a DataFrame of answers")
    check_columns(frame.columns, source)
    if frame.columns.duplicated().any():
        raise DataError(f"{source}: got two columns of one name")
    names = [name for name in COLUMNS if name in frame.columns]
    rows = zip(*(frame[name].tolist() for name in names), strict=True)
    return check_rows(
        (dict(zip(names, row, strict=True)) for row in rows),
        place=lambda index: f"{source}, row {index + 1}",
        source=source,
    )


def check_columns(names: Iterable[object], source: str) -> None:
    """Refuse a table that lacks a column.

    Raises
    ------
    DataError
        If it does; the message names all that are missing.
    """
    missing = [name for name in REQUIRED_COLUMNS if name not in set(names)]
    if missing:
        raise DataError(
            f"{source}: found no column {', '.join(missing)}, want {', '.join(REQUIRED_COLUMNS)}"
        )


def check_rows(
    rows: Iterable[Mapping[str, Any]], place: Callable[[int], str], source: str
) -> pd.DataFrame:
    """Check answers one by one, as :func:`check_answers` says.

    Parameters
    ----------
    rows : iterable of mappings
        Values by column.
    place : callable
        Gives the words for the place of a row, by its index from 0.
    source : str
        Where they come from, for the message when there is none.

    Raises
    ------
    DataError
        As :func:`check_answers`.
    """
    # Imported here because it takes most of a second and the command line needs none of it.
    import pandas as pd

    seen: dict[tuple[str, ...], int] = {}
    made: dict[tuple[str, ...], str] = {}
    checked = []
    for index, row in enumerate(rows):
        here = place(index)
        answer = _check_row(row, here)
        participant, *stimulus = answer[:4]
        key = (participant, *stimulus)
        if key in seen:
            raise DataError(
                f"{here}: participant {participant} has rated {' / '.join(stimulus)} before "
                f"({place(seen[key])}), want one answer each"
            )
        seen[key] = index
        if made.setdefault(tuple(stimulus), answer[-1]) != answer[-1]:
            raise DataError(
                f"{here}: parameters: got other ones for {' / '.join(stimulus)} than above, "
                "want one stimulus to be the same for all participants"
            )
        checked.append(answer)
    if not checked:
        raise DataError(f"{source}: found no answer")
    return pd.DataFrame(checked, columns=list(COLUMNS))


def check_rating(value: object, here: str = "answer") -> int:
    """Take a rating as a whole number from 1 to 10.

    Raises
    ------
    DataError
        If it is none.

    Examples
    --------
    >>> check_rating("7"), check_rating(7.0), check_rating("7.0")
    (7, 7, 7)
    """
    rating = _whole(value)
    if rating is None or not LOWEST_RATING <= rating <= HIGHEST_RATING:
        raise DataError(
            f"{here}: rating: got {value!r}, "
            f"want a whole number from {LOWEST_RATING} to {HIGHEST_RATING}"
        )
    return rating


def check_position(value: object, here: str = "answer") -> int:
    """Take a place in the order of presentation, from 1; 0 where it is not told.

    Raises
    ------
    DataError
        If it is neither.
    """
    position = 0 if _is_missing(value) else _whole(value)
    if position is None or position < 0:
        raise DataError(f"{here}: position: got {value!r}, want a whole number from 1")
    return position


def motions_of(answers: pd.DataFrame) -> list[tuple[str, str]]:
    """List the test cases and motions of checked answers, in order of appearance."""
    pairs = answers[["test_case", "motion"]].drop_duplicates()
    return [(str(case), str(motion)) for case, motion in pairs.itertuples(index=False)]


def ratings_of(answers: pd.DataFrame, test_case: str, motion: str) -> pd.DataFrame:
    """Arrange the answers on one motion as a table of participants and stimuli.

    Parameters
    ----------
    answers : DataFrame
        As from :func:`check_answers`.
    test_case, motion : str
        Which of them.

    Returns
    -------
    DataFrame of shape (n_participants, n_stimuli)
        Ratings; NaN where a participant did not rate a stimulus. Participants and stimuli
        stand in the order of their first answer, numbered participants by number, "original"
        first.

    Raises
    ------
    DataError
        If nobody rated that motion.
    """
    chosen = answers[(answers["test_case"] == test_case) & (answers["motion"] == motion)]
    if chosen.empty:
        known = "; ".join(f"{case} / {name}" for case, name in motions_of(answers))
        raise DataError(f"{test_case} / {motion}: found no answer to it, have {known}")
    stimuli = sorted(chosen["stimulus"].unique(), key=lambda name: name != "original")
    participants = sorted(chosen["participant"].unique(), key=_numbers_first)
    table = chosen.set_index(["participant", "stimulus"])["rating"].unstack()  # noqa: PD010 - each once
    return table.reindex(index=participants, columns=stimuli).astype(float)


def _numbers_first(participant: str) -> tuple[bool, int]:
    number = participant.isascii() and participant.isdigit()
    # Equal keys leave codes that are no numbers in their order.
    return not number, int(participant) if number else 0


def _check_row(row: Mapping[str, Any], here: str) -> tuple[str, str, str, str, int, int, str]:
    participant, test_case, motion, stimulus = (
        _text(row.get(name), name, here) for name in REQUIRED_COLUMNS[:4]
    )
    return (
        participant,
        test_case,
        motion,
        stimulus,
        check_rating(row.get("rating"), here),
        check_position(row.get("position"), here),
        _parameters(row.get("parameters"), here),
    )


def _text(value: object, name: str, here: str) -> str:
    whole = _whole(value)
    text = str(whole) if whole is not None and not isinstance(value, str) else value
    if not isinstance(text, str) or not text.strip():
        raise DataError(f"{here}: {name}: got {value!r}, want a word or a number")
    return text.strip()


def _whole(value: object) -> int | None:
    """Read a whole number, however a file's format stored it, or tell by None that it is none."""
    if isinstance(value, str):
        # Programs write the whole numbers of a column with gaps as 7.0.
        text = re.sub(r"\.0+$", "", value.strip())
        return int(text) if text.isascii() and text.isdigit() and len(text) < 10 else None
    if isinstance(value, bool):
        return None
    if isinstance(value, Integral):
        return int(value)
    # Tables store whole numbers as floats where some are missing.
    if isinstance(value, Real) and float(value).is_integer():
        return int(float(value))
    return None


def _is_missing(value: object) -> bool:
    import pandas as pd  # for the same reason as above

    return value is None or value is pd.NA or value == "" or value != value


def _parameters(value: object, here: str) -> str:
    if _is_missing(value):
        return "{}"
    try:
        read = json.loads(value) if isinstance(value, str) else None
    except ValueError:
        read = None
    if not isinstance(read, dict):
        raise DataError(f"{here}: parameters: got {value!r}, want a JSON object")
    return json.dumps(read, sort_keys=True, ensure_ascii=False)
