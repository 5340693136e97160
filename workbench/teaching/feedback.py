"""What a check shows: a box that says by word and sign, not by colour alone, how it went."""

from __future__ import annotations

import html
import re
from dataclasses import dataclass

from workbench.teaching.exercises import State, Verdict

#: Sign, word and colour of each state; the colours keep 3 : 1 to white and to black.
_LOOKS: dict[State, tuple[str, str, str]] = {
    "solved": ("✓", "Solved", "#009E73"),
    "wrong": ("✗", "Not yet", "#D55E00"),
    "unreadable": ("!", "Cannot read the answer", "#B07800"),
    "unsolved": ("…", "To do", "#0072B2"),
}


@dataclass(frozen=True)
class Progress:
    """How many exercises of a lesson are solved.

    Attributes
    ----------
    solved : tuple of (str, bool)
        Each exercise, and whether it is solved.

    Examples
    --------
    >>> Progress((("first", True), ("second", False)))
    1 of 2 exercises solved; open: second
    """

    solved: tuple[tuple[str, bool], ...]

    def __repr__(self) -> str:
        open_ones = ", ".join(key for key, done in self.solved if not done)
        return self.sentence + (f"; open: {open_ones}" if open_ones else "")

    @property
    def sentence(self) -> str:
        """The count, as a student reads it."""
        return f"{sum(done for _, done in self.solved)} of {len(self.solved)} exercises solved"

    def _repr_html_(self) -> str:
        dots = "".join("●" if done else "○" for _, done in self.solved)
        open_ones = ", ".join(
            f"<code>{html.escape(k)}</code>" for k, done in self.solved if not done
        )
        still = f" · open: {open_ones}" if open_ones else " · the lesson is complete"
        state: State = "unsolved" if open_ones else "solved"
        return _box(
            state, f'<span aria-hidden="true">{dots}</span> <strong>{self.sentence}</strong>{still}'
        )


@dataclass(frozen=True)
class Feedback:
    """What a check tells about one answer.

    Attributes
    ----------
    key : str
        Which exercise.
    verdict : Verdict
        What was found.
    progress : Progress
        How many exercises are solved now.
    code : str
        The solution, if it is shown.
    """

    key: str
    verdict: Verdict
    progress: Progress
    code: str = ""

    @property
    def state(self) -> State:
        """What was found, in one word."""
        return self.verdict.state

    def __repr__(self) -> str:
        sign, word, _ = _LOOKS[self.state]
        code = f"\n{self.code}" if self.code else ""
        return f"{sign} {word} ({self.key}): {self.verdict.text}\n{self.progress.sentence}{code}"

    def _repr_html_(self) -> str:
        sign, word, _ = _LOOKS[self.state]
        code = (
            '<details><summary style="cursor:pointer">The lesson’s solution</summary>'
            f'<pre style="overflow-x:auto;margin:.4em 0">{html.escape(self.code)}</pre></details>'
            if self.code
            else ""
        )
        return _box(
            self.state,
            f'<strong><span aria-hidden="true">{sign}</span> {word}</strong>'
            f' · <code>{html.escape(self.key)}</code><div style="margin:.35em 0">'
            f"{_as_html(self.verdict.text)}</div>{code}"
            f'<div style="font-size:.9em;opacity:.8">{self.progress.sentence}</div>',
        )


def _box(state: State, inside: str) -> str:
    """Frame a text in a colour that shows on white and on black."""
    color = _LOOKS[state][2]
    return (
        f'<div role="status" style="border:1px solid {color};border-left-width:6px;'
        f"border-radius:4px;padding:.6em .9em;margin:.3em 0;max-width:46em;line-height:1.45;"
        f'background:{color}14;color:inherit">{inside}</div>'
    )


def _as_html(text: str) -> str:
    """Escape a text, and set what stands between backticks as code."""
    return re.sub("`([^`]+)`", r"<code>\1</code>", html.escape(text, quote=False))
