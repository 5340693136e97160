"""What a participant reads. No method is named here."""

from __future__ import annotations

from html import escape

import ipywidgets as widgets

from workbench.study.answers import HIGHEST_RATING, LOWEST_RATING
from workbench.study.design import StudyDesign

#: What is asked for, and what is told whatever failed: its own words might name a method.
WATCH_FIRST = "Watch the figures to the end once. Then you can rate them."
EXERCISE = " This one is an exercise: nothing of it is stored."
FETCHING = '<p role="status">The figures are being fetched …</p>'
RATE_ALL = "Please rate all figures first."
CHANGED = (
    "The ratings of these figures were changed in another window. These are the stored ones: "
    "please look whether they are right, then go on."
)
CLOSED = "This study cannot be opened. Please call whoever leads the study."
FAILED = "That did not work. Nothing that was stored is lost. Please call whoever leads the study."

_PAGE = (
    '<div class="wb-study-text" style="max-width: 44em; font-size: 15px; line-height: 1.5">{}</div>'
)


def welcome_text(design: StudyDesign) -> str:
    """Tell what will happen, how long it takes and what is stored."""
    n_items = len(design.items)
    minutes = max(1, round(design.minutes))
    exercise = "First there is an exercise that does not count. " if design.practice else ""
    return _page(
        design.title,
        f"You will see {n_items} {'movement' if n_items == 1 else 'movements'}, each of them as "
        "several stick figures side by side that move in step. They show the same movement, but "
        "may not show it equally well.",
        f"Watch them to the end at least once, as often as you like. Then give each figure a "
        f"rating from {LOWEST_RATING} (lowest quality) to {HIGHEST_RATING} (highest). Two figures "
        "may get the same rating. There is no right answer: what you see counts.",
        f"It takes about {minutes} {'minute' if minutes == 1 else 'minutes'}. {exercise}"
        "You can stop whenever you want.",
        "Only your ratings are stored, on this machine, under a number. Nobody asks for your name.",
    )


def onward_text(index: int, n_items: int) -> str:
    """Say what the button does that leads on from an item, counted from 0; −1 is the exercise."""
    if index < 0:
        return "Start"
    return "Finish" if index + 1 == n_items else "Next movement"


def recalled_text(code: str) -> str:
    """Say as whom a page goes on that has remembered somebody."""
    return f'<span role="status">You go on as {escape(code)}.</span>'


def thanks_text(code: str) -> str:
    """Say that everything is done."""
    return _page(
        "Thank you",
        f"All your ratings are stored. You took part as {code}; you may close this page.",
    )


def page_button(text: str, tooltip: str, style: str = "") -> widgets.Button:
    """Make a button of a participant's page."""
    layout = widgets.Layout(width="auto", min_width="110px")
    return widgets.Button(description=text, tooltip=tooltip, button_style=style, layout=layout)


def _page(title: str, *paragraphs: str) -> str:
    heading = f'<h2 style="margin: 0 0 8px; line-height: 1.25">{escape(title)}</h2>'
    words = "".join(f'<p style="margin: 0 0 8px">{escape(words)}</p>' for words in paragraphs)
    return _PAGE.format(heading + words)
