"""Sides of the body: which joints are on the left, and which on the right."""

from __future__ import annotations

from collections.abc import Sequence

LEFT, RIGHT, MIDDLE = "left", "right", "middle"


def joint_sides(names: Sequence[str]) -> list[str]:
    """Tell left from right joints by their names.

    A joint is on the left if exchanging left for right gives the name of another joint
    (``LeftArm``, ``lfemur``, ``hand_l``, ``Bip01 L Foot``), so that ``LowerBack`` and
    ``root`` stay in the middle.

    Parameters
    ----------
    names : sequence of str
        Joint names of one skeleton.

    Returns
    -------
    list of {"left", "right", "middle"}

    Examples
    --------
    >>> joint_sides(["Hips", "LowerBack", "LHipJoint", "RHipJoint"])
    ['middle', 'middle', 'left', 'right']
    """
    known = {name.lower() for name in names}
    return [_side(name.lower(), known) for name in names]


def _side(name: str, known: set[str]) -> str:
    for own, other, side in (("l", "r", LEFT), ("r", "l", RIGHT)):
        words = {"l": "left", "r": "right"}
        mirrored = {name.replace(words[own], words[other])}
        mirrored |= {
            name[:place] + other + name[place + 1 :]
            for place, letter in enumerate(name)
            if letter == own and _stands_for_a_side(name, place)
        }
        if (mirrored - {name}) & known:
            return side
    return MIDDLE


def _stands_for_a_side(name: str, place: int) -> bool:
    """Tell whether a letter can mean a side: at either end, or alone between marks."""
    before, after = name[place - 1 : place], name[place + 1 : place + 2]
    return place == 0 or (not before.isalnum() and not after.isalnum())
