"""In which order a participant sees a study: random, balanced, and the same every time.

Items, and the places of the motions inside of an item, follow Williams's designs (Williams
1949): in each block of as many participants as there are things to order, each thing comes
once at each place; in each block (two where their number is odd), each thing follows each
other one equally often. Which thing has which role in a block is drawn at random.

The draws come from SHA-256 rather than from a library's generator, so that a study which is
continued years later gives the same orders.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Sequence
from dataclasses import dataclass

from workbench.errors import WorkbenchError
from workbench.validation import whole_number

#: Letters of codes; none that is taken for another one or for a digit.
_CODE_LETTERS = "ACDEFHJKMNPRTWXY"


@dataclass(frozen=True)
class Presentation:
    """An item as one participant sees it.

    Attributes
    ----------
    item : int
        Which one.
    order : tuple of int
        Its stimuli from left to right.
    """

    item: int
    order: tuple[int, ...]


def presentations(sizes: Sequence[int], participant: int, seed: int) -> list[Presentation]:
    """Give the order in which a participant sees the items, and their stimuli side by side.

    Parameters
    ----------
    sizes : sequence of int
        How many stimuli each item has.
    participant : int
        Number, from 1.
    seed : int
        Of the study.

    Returns
    -------
    list of Presentation
        Every item once.

    Raises
    ------
    WorkbenchError
        If the participant or the seed is no such number.

    Examples
    --------
    >>> [shown.item for shown in presentations([4, 4, 4], participant=1, seed=0)]
    [0, 1, 2]
    """
    turn = whole_number("participant", participant) - 1
    whole_number("seed", seed, at_least=0)
    return [
        Presentation(item, tuple(balanced_order(sizes[item], turn, f"{seed}/stimuli of {item}")))
        for item in balanced_order(len(sizes), turn, f"{seed}/items")
    ]


def balanced_order(n: int, turn: int, purpose: str) -> list[int]:
    """Order n things for the participant whose turn it is.

    Parameters
    ----------
    n : int
        How many.
    turn : int
        The participant's number, from 0.
    purpose : str
        What the draws are for; others for other words.

    Returns
    -------
    list of int
        A permutation of 0 to n − 1.
    """
    if n < 2:
        return list(range(n))
    squares = 1 + n % 2
    block, place = divmod(turn, squares * n)
    square, place = divmod(place, n)
    # A zigzag, whose neighbours are 1, 2, … n − 1 apart, moved on by one from row to row.
    zigzag = [(step + 1) // 2 if step % 2 else (n - step // 2) % n for step in range(n)]
    row = _shuffled(n, f"{purpose}/{block}/rows {square}")[place]
    roles = _shuffled(n, f"{purpose}/{block}/roles")
    order = [roles[(role + row) % n] for role in zigzag]
    return order[::-1] if square else order


def participant_code(participant: int, study_id: str) -> str:
    """Give the code by which a participant goes on: the number, and letters against mistyping.

    The letters differ from study to study, so that hardly any code of one fits another.

    Examples
    --------
    >>> participant_of(participant_code(12, "a study"), "a study")
    12
    """
    number = whole_number("participant", participant)
    digest = _digest(f"{study_id}/code of {number}")
    letters = (_CODE_LETTERS[digest >> shift & 15] for shift in (0, 4, 8))
    return f"{number}-{''.join(letters)}"


def participant_of(code: str, study_id: str) -> int:
    """Tell whose code it is.

    Raises
    ------
    WorkbenchError
        If it is nobody's.
    """
    found = re.fullmatch(r"0*([1-9][0-9]{0,8})\s*-?\s*([A-Z]{3})", code.strip().upper())
    if found is not None:
        number = int(found[1])
        if participant_code(number, study_id).endswith(found[2]):
            return number
    raise WorkbenchError(
        f"code: got {code.strip()!r}, want the number and the three letters that were shown at "
        "the beginning, such as 12-KFM"
    )


def _shuffled(n: int, purpose: str) -> list[int]:
    return sorted(range(n), key=lambda index: _digest(f"{purpose}/{index}"))


def _digest(text: str) -> int:
    return int.from_bytes(hashlib.sha256(text.encode()).digest())
