"""The table of quality values, with the best ones marked and their spread over seeds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from html import escape

import numpy as np

from workbench.dashboards.comparison.jobs import PanelResult, Values

_MEASURES: tuple[tuple[str, str, bool, Callable[[PanelResult | Values], float]], ...] = (
    (
        "stress",
        "Costa 2018, Eq. 4.1; depends on the scale of the embedding",
        False,
        lambda result: result.quality.stress,
    ),
    (
        "scale-normalised stress",
        "stress of the embedding at its best scale",
        False,
        lambda result: result.quality.scale_normalized_stress,
    ),
    (
        "trustworthiness",
        "how few false neighbours the embedding shows",
        True,
        lambda result: result.quality.trustworthiness,
    ),
    (
        "continuity",
        "how few neighbours the embedding tears apart",
        True,
        lambda result: result.quality.continuity,
    ),
    (
        "neighbourhood preservation",
        "share of the nearest neighbours that stay nearest",
        True,
        lambda result: result.quality.neighborhood_preservation,
    ),
    (
        "reconstruction error",
        "mean error of the samples back-projected from the embedding",
        False,
        lambda result: result.error,
    ),
)
_STYLE = """<style>
.wb-quality { overflow-x: auto; color: var(--jp-ui-font-color0, inherit); }
.wb-quality table { border-collapse: collapse; font-variant-numeric: tabular-nums; width: 100%; }
.wb-quality caption { text-align: left; color: var(--jp-ui-font-color1, inherit); padding: 4px 0; }
.wb-quality th, .wb-quality td { padding: 3px 8px; text-align: right; line-height: 1.35;
  border-bottom: 1px solid var(--jp-border-color2, rgba(128, 128, 128, 0.45)); }
.wb-quality thead th { vertical-align: bottom; font-weight: 600; }
.wb-quality tbody th { text-align: left; font-weight: 400; }
.wb-quality td { white-space: nowrap; }
.wb-quality caption { line-height: 1.35; }
.wb-quality td.best { font-weight: 700; }
.wb-quality td.best::before { content: "★ "; }
.wb-quality td small { display: block; font-weight: 400; font-size: 85%;
  color: var(--jp-ui-font-color1, inherit); }
</style>"""


def quality_table(
    titles: Sequence[str],
    results: Sequence[PanelResult | None],
    repeated: Sequence[Sequence[Values]] = (),
) -> str:
    """Write the quality values as an HTML table, the best of each measure marked.

    Parameters
    ----------
    titles : sequence of str
        What each panel shows.
    results : sequence of PanelResult or None
        As many.
    repeated : sequence of sequence of Values
        For each panel, the quality with other seeds; if there are any, their mean and
        standard deviation together with the value shown are given beside it, and decide what
        is best.

    Returns
    -------
    str
    """
    there = [result for result in results if result is not None]
    if not there:
        return ""
    others = repeated or [()] * len(results)
    counts = {1 + len(values) for r, values in zip(results, others, strict=True) if r and values}
    heads = "".join(f'<th scope="col">{escape(title)}</th>' for title in titles)
    rows = "".join(_row(measure, results, others) for measure in _MEASURES)
    caption = f"★ best. Neighbourhood measures at k = {there[0].quality.k}. "
    caption += "↑ larger is better, ↓ smaller is better."
    if counts:
        seeds = " to ".join(str(count) for count in sorted({min(counts), max(counts)}))
        caption += f" Below each value: mean ± standard deviation of {seeds} seeds."
    return (
        f'{_STYLE}<div class="wb-quality"><table><caption>{caption}</caption>'
        f'<thead><tr><th scope="col"></th>{heads}</tr></thead>'
        f"<tbody>{rows}</tbody></table></div>"
    )


def _row(
    measure: tuple[str, str, bool, Callable[[PanelResult | Values], float]],
    results: Sequence[PanelResult | None],
    repeated: Sequence[Sequence[Values]],
) -> str:
    name, meaning, larger_is_better, value = measure
    shown = [None if result is None else value(result) for result in results]
    spreads = [
        _spread([value(result), *map(value, others)]) if result is not None and others else None
        for result, others in zip(results, repeated, strict=True)
    ]
    all_repeated = all(
        spread or value is None for spread, value in zip(spreads, shown, strict=True)
    )
    judged = [s[0] if s and all_repeated else v for s, v in zip(spreads, shown, strict=True)]
    best = _best(judged, larger_is_better)
    cells = "".join(_cell(*cell) for cell in zip(shown, spreads, best, strict=True))
    arrow = "↑" if larger_is_better else "↓"
    hint = f"{meaning}; {'larger' if larger_is_better else 'smaller'} is better"
    return (
        f'<tr><th scope="row" title="{escape(hint)}">{escape(name)} '
        f'<span aria-hidden="true">{arrow}</span></th>{cells}</tr>'
    )


def _spread(values: Sequence[float]) -> tuple[float, float]:
    """Give the mean and the standard deviation of a sample of seeds."""
    mean, deviation = float(np.mean(values)), float(np.std(values, ddof=1))
    # What equal values differ by is rounding.
    return mean, deviation if deviation > 1e-9 * abs(mean) else 0.0


def _best(values: Sequence[float | None], larger_is_better: bool) -> list[bool]:
    """Mark the best values; values that are shown alike are equally good."""
    shown = [np.nan if value is None else _rounded(value) for value in values]
    if np.isfinite(shown).sum() < 2:
        return [False] * len(shown)
    best = np.nanmax(shown) if larger_is_better else np.nanmin(shown)
    return [value == best for value in shown]


def _cell(value: float | None, spread: tuple[float, float] | None, best: bool) -> str:
    if value is None:
        return "<td>…</td>"
    beside = ""
    if spread is not None:
        beside = f"<small>{_written(spread[0])} ± {float(f'{spread[1]:.2g}'):,.10g}</small>"
    return f"<td{' class=best' if best else ''}>{_written(value)}{beside}</td>"


def _written(value: float) -> str:
    return f"{_rounded(value):,.10g}"


def _rounded(value: float) -> float:
    """Keep three digits: more would pretend a precision that seeds take away."""
    return float(f"{value:.3g}")
