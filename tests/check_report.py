"""Check a report of the quick profile: all there, some values where they should be, readable.

python -m tests.check_report OUT

Complaints are printed one a line; the exit status is 1 if there are any.
"""

from __future__ import annotations

import os
import sys
import tomllib
from pathlib import Path
from typing import Any

import pandas as pd

from tests.browser.chromium import open_browser
from tests.notebooks.screenshot_report import open_report
from workbench.reproduction.claims import all_claims
from workbench.reproduction.items import ITEMS, item_state
from workbench.reproduction.outputs import NOT_MADE, read_evidence, read_parts

#: Values of tables, with the interval that each has to lie in: wide enough for other versions of
#: the numerical packages, narrow enough that a mistake leaves it.
VALUES = Path(__file__).with_name("report_values.toml")

#: Widths of a phone and of a screen, in pixels.
WIDTHS = (390, 1280)

#: What a reader without sight, or with a keyboard, meets on the page.
_ACCESSIBILITY = """
() => {
  const complaints = [];
  let level = 0;
  for (const heading of document.querySelectorAll("h1, h2, h3, h4, h5, h6")) {
    const next = Number(heading.tagName[1]);
    if (next > level + 1) complaints.push(`heading "${heading.textContent.trim()}" skips a level`);
    level = next;
  }
  for (const image of document.querySelectorAll("img, [role=img], .plot")) {
    const text = image.getAttribute("alt") ?? image.getAttribute("aria-label") ?? "";
    if (text.trim().length < 20) complaints.push(`a figure has hardly a text: "${text}"`);
  }
  for (const link of document.querySelectorAll("a, button, summary")) {
    const text = link.textContent.trim() || link.getAttribute("aria-label");
    if (!text) complaints.push(`a link has no text: ${link.outerHTML.slice(0, 80)}`);
    if (/share chart|plotly cloud|upload/i.test(text))
      complaints.push(`a link leads off the machine: ${text}`);
  }
  const ids = [...document.querySelectorAll("[id]")].map((element) => element.id);
  for (const id of new Set(ids.filter((id, at) => ids.indexOf(id) !== at)))
    complaints.push(`the id ${id} is there twice`);
  for (const [label, target] of [...document.querySelectorAll("[aria-labelledby]")].map((e) => [
    e, document.getElementById(e.getAttribute("aria-labelledby"))]))
    if (!target) complaints.push(`nothing labels ${label.outerHTML.slice(0, 80)}`);
  return complaints;
}
"""


def missing_items(out: Path) -> list[str]:
    """Name the figures and tables that are not there without a reason, and the failed ones."""
    explained = {part["item"] for part in read_parts(out) if part["kind"] == NOT_MADE}
    return [
        f"{item.id}: {item_state(item, out)}"
        for item in ITEMS
        if item_state(item, out) != "done" and item.id not in explained
    ]


def missing_claims(out: Path) -> list[str]:
    """Name the claims for which no evidence was given."""
    return [f"{claim}: no evidence" for claim in all_claims() if read_evidence(out, claim) is None]


def values_out_of_range(out: Path) -> list[str]:
    """Compare some values of tables with the intervals that they should lie in."""
    complaints = []
    for name, expected in tomllib.loads(VALUES.read_text(encoding="utf-8")).items():
        low, high = expected["between"]
        table = pd.read_csv(out / "tables" / f"{expected['table']}.csv", index_col=0)
        value = float(table.loc[expected["row"], expected["column"]])
        if not low <= value <= high:
            complaints.append(f"{name}: got {value:.4g}, want {low} to {high}")
    return complaints


def page_complaints(out: Path) -> list[str]:
    """Open the page from its folder, on a phone and on a screen, and look for faults."""
    found: list[str] = []
    with open_browser() as browser:
        if browser is None:
            return ["no chromium: the page was not opened"] if os.environ.get("CI") else []
        for width in WIDTHS:
            page: Any = open_report(browser, out, width=width)
            found += [f"{width} px: {text}" for text in page.complaints]
            wide = page.evaluate("document.documentElement.scrollWidth")
            if wide > width:
                found.append(f"{width} px: the page is {wide} px wide")
            if width == WIDTHS[-1]:
                found += page.evaluate(_ACCESSIBILITY)
            page.close()
    return found


def main(out: Path) -> int:
    """Print what is wrong with a report; 1 if anything is."""
    complaints = [
        *missing_items(out),
        *missing_claims(out),
        *values_out_of_range(out),
        *page_complaints(out),
    ]
    for complaint in complaints:
        print(complaint)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
