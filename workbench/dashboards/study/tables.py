"""Tables of a user study, as HTML that follows the page's theme."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape

from workbench.reproduction.halit2010.user_study_tables import p_text
from workbench.study.analysis import MotionAnalysis
from workbench.study.answers import Stimulus
from workbench.study.comparisons import PairedComparison

_SIGNIFICANT = 0.05
_MINUS = "\N{MINUS SIGN}"


def stimuli_table(items: Sequence[Sequence[Stimulus]]) -> str:
    """List what will be shown: each clip, how many keyframes, and each method's error."""
    names = list(dict.fromkeys(s.name for item in items for s in item[1:]))
    rows = []
    for original, *rebuilt in items:
        errors = {s.name: s.parameters["error"] for s in rebuilt}
        cells = [
            f"{original.parameters['frames']}",
            f"{original.parameters['seconds']:.1f} s",
            f"{rebuilt[0].parameters['count']}",
            *(f"{errors[name]:.3g}" if name in errors else "" for name in names),
        ]
        rows.append((original.motion, cells))
    caption = (
        "What is shown: the original of each clip beside what each method rebuilds from equally "
        "many keyframes. Under each method the error per frame per joint, in radians."
    )
    return _table(caption, ["clip", "frames", "length", "keyframes", *names], rows)


def printed_table(found: MotionAnalysis) -> str:
    """Write mean differences and one-sided p values as the thesis prints them."""
    names = [str(name) for name in found.ratings.columns]
    by_pair = {(c.first, c.second): c for c in found.comparisons}
    rows = []
    for index, first in enumerate(names[:-1]):
        cells = [
            _printed(by_pair[first, second]) if second in names[index + 1 :] else "–"
            for second in names[1:]
        ]
        rows.append((first, cells))
    caption = (
        f"Mean difference / p (row {_MINUS} column), one-sided in the direction that was found, "
        "as the thesis prints them."
    )
    return _table(caption, ["", *names[1:]], rows)


def comparisons_table(found: MotionAnalysis) -> str:
    """Write what the thesis leaves out: intervals, two-sided p, correction, effect sizes."""
    rows = []
    for c in found.comparisons:
        star = " *" if c.p_holm < _SIGNIFICANT else ""
        cells = [
            str(c.n),
            _signed(c.mean_difference),
            f"{_signed(c.low)} to {_signed(c.high)}",
            _signed(c.t),
            p_text(c.p_two_sided),
            p_text(c.p_holm) + star,
            _signed(c.effect_size),
            _signed(c.corrected_effect_size),
        ]
        rows.append((c.label, cells))
    heads = ["pair", "n", "difference", "95 % interval", "t"]
    heads += ["p two-sided", "p Holm", "d_z", "g_z"]
    notes = dict.fromkeys(f"{c.label}: {c.note}." for c in found.comparisons if c.note)
    caption = (
        f"Paired t tests. p Holm is two-sided and corrected for the {len(rows)} pairs of this "
        "table; * below 0.05. d_z is Cohen's effect size, g_z the same without its bias in small "
        f"samples. {' '.join(notes)}"
    )
    return _table(caption.strip(), heads, rows)


def _printed(comparison: PairedComparison) -> str:
    return f"{_signed(comparison.mean_difference)} / {p_text(comparison.p_one_sided)}"


def _signed(value: float) -> str:
    if not math.isfinite(value):
        return "–" if math.isnan(value) else f"{_MINUS if value < 0 else ''}∞"
    return f"{value:.2f}".replace("-", _MINUS)


def _table(caption: str, heads: Sequence[str], rows: Sequence[tuple[str, Sequence[str]]]) -> str:
    head = "".join(
        f'<th scope="col">{escape(text)}</th>' if text else "<td></td>" for text in heads
    )
    body = "".join(
        f'<tr><th scope="row">{escape(name)}</th>'
        + "".join(f"<td>{escape(cell)}</td>" for cell in cells)
        + "</tr>"
        for name, cells in rows
    )
    return (
        '<div class="wb wb-study-table" tabindex="0" role="region" aria-label="table"><table>'
        f"<caption>{escape(caption)}</caption><thead><tr>{head}</tr></thead>"
        f"<tbody>{body}</tbody></table></div>"
    )
