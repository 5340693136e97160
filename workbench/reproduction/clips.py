"""Clips for pictures: the published one, or what stands in for it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from workbench.errors import WorkbenchError
from workbench.reproduction.profiles import excerpts, motion_clips

#: A clip of every checkout that moves much and comes back to where it was.
BUNDLED = "cmu/01_01-two-jumps"


@dataclass(frozen=True)
class PictureClip:
    """A clip that a picture shows.

    Attributes
    ----------
    name : str
        As :func:`workbench.load_space` knows it.
    title : str
        What is done in it.
    note : str
        A sentence that says what it stands in for; empty for the published clip.
    """

    name: str
    title: str
    note: str = ""

    def __str__(self) -> str:
        return f"{self.name} ({self.title})"


def picture_clip(
    wanted: str, profile: str, *, published: str = "", instead: Sequence[str] = (BUNDLED,)
) -> PictureClip:
    """Choose the clip of a picture.

    Parameters
    ----------
    wanted : str
        What the thesis shows, as text: "cmu/05_10" or "a flip".
    profile : {"quick", "full"}
        ``quick`` takes bundled clips only.
    published : str
        Name of the published clip; empty if the thesis does not tell.
    instead : sequence of str
        What else to take, best first; the first that is there is taken.

    Returns
    -------
    PictureClip

    Raises
    ------
    WorkbenchError
        If none of them is on this machine, or the profile is unknown.
    """
    titles = _titles(profile)
    for name in (published, *instead):
        if name in titles:
            note = "" if name == published else f"{name} stands in for {wanted}"
            if note and published:
                bundled = "not bundled" if profile == "quick" else "not on this machine"
                note += f", which is {bundled}"
            return PictureClip(name, titles[name], f"{note}." if note else "")
    raise WorkbenchError(
        f"picture of {wanted}: found none of {', '.join((published, *instead)).lstrip(', ')}"
    )


def titles_of(profile: str) -> dict[str, str]:
    """Give the clips of a profile and what is done in each."""
    chosen = set(motion_clips(profile))
    return {name: title for name, title in _titles(profile).items() if name in chosen}


def _titles(profile: str) -> dict[str, str]:
    """Give all clips that a profile may show: bundled excerpts, or all there are."""
    from workbench.datasets import list_datasets

    bundled = set(excerpts())
    present = {
        status.entry.name: status.entry.title
        for status in list_datasets()
        if status.state in ("available", "built in") and status.entry.name.startswith("cmu/")
    }
    if profile == "full":
        return present
    motion_clips(profile)  # refuses an unknown profile
    return {name: title for name, title in present.items() if name in bundled}
