"""The report of a reproduction: one page that opens from a folder, without a network."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from workbench.experiments.progress import duration
from workbench.experiments.versions import versions
from workbench.files import write_atomically
from workbench.reproduction.items import Item, item_state
from workbench.reproduction.ledger import count_verdicts, write_ledger
from workbench.reproduction.outputs import (
    FIGURE,
    NOT_MADE,
    TABLE,
    VALUES,
    read_error,
    read_outcome,
    read_parts,
    slug,
)
from workbench.reproduction.published import published, published_ids
from workbench.reproduction.tables import format_cell

_TEMPLATES = Path(__file__).with_name("templates")

#: Headings of the report by what is before the colon of an id.
_CHAPTERS = {
    "costa2018": "Costa 2018: spatial keyframes and the optimizer of projections",
    "halit2010": "Halit 2010: keyframes by motion saliency",
}
_BEYOND = "Beyond the theses"

#: Columns whose numbers are differences, shown with their sign.
_SIGNED = "difference"


def write_report(out: Path, items: Sequence[Item]) -> Path:
    """Write ``index.html`` from what lies in an output folder.

    Parameters
    ----------
    out : Path
        The output folder.
    items : sequence of Item
        What to show, whether it was made or not.

    Returns
    -------
    Path
        The report.
    """
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(_TEMPLATES),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters["duration"] = duration
    page = environment.get_template("report.html").render(
        style=(_TEMPLATES / "report.css").read_text(encoding="utf-8"),
        script=(_TEMPLATES / "report.js").read_text(encoding="utf-8"),
        **_content(out, items),
    )
    index = out / "index.html"
    write_atomically(index, page.encode())
    return index


def _content(out: Path, items: Sequence[Item]) -> dict[str, Any]:
    run = json.loads((out / "run.json").read_text(encoding="utf-8"))
    parts = read_parts(out)
    notebooks = list(dict.fromkeys(item.notebook for item in items))
    sections = [_section(out, item, parts, run) for item in items]
    claims = write_ledger(out, notebooks)
    data = _data(out, notebooks)
    outcomes = [read_outcome(out, name) for name in notebooks]
    return {
        "run": run,
        "data": data,
        "used": _describe_data(data),
        "sections": sections,
        "chapters": _chapters(sections),
        "n_done": sum(section["state"] == "done" for section in sections),
        "claims": claims,
        "verdicts": count_verdicts(claims),
        "notebooks": [outcome for outcome in outcomes if outcome is not None],
        "versions": versions(),
    }


def _chapters(sections: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Group sections by where they are published; what is in no thesis comes last."""
    chapters: dict[str, list[dict[str, Any]]] = {}
    for section in sections:
        source = section["item"].id.partition(":")[0]
        chapters.setdefault(_CHAPTERS.get(source, _BEYOND), []).append(section)
    order = [*_CHAPTERS.values(), _BEYOND]
    return [
        {"title": title, "anchor": slug(title), "sections": chapters[title]}
        for title in order
        if title in chapters
    ]


def _section(
    out: Path, item: Item, parts: Sequence[dict[str, Any]], run: dict[str, Any]
) -> dict[str, Any]:
    mine = [part for part in parts if part["item"] == item.id]
    values = {
        label: f"{value:.2f}"
        for part in mine
        if part["kind"] == VALUES
        for label, value in part["values"].items()
    }
    return {
        "item": item,
        "anchor": slug(item.id),
        "state": item_state(item, out),
        "ours": values,
        "published": _published_value(item.id),
        "figures": [_figure(out, part) for part in mine if part["kind"] == FIGURE],
        "tables": [_table(part) for part in mine if part["kind"] == TABLE],
        "not_made": [part["caption"] for part in mine if part["kind"] == NOT_MADE],
        "error": read_error(out, item.notebook, item.id),
        "made_otherwise": _made_otherwise(mine, run),
    }


def _made_otherwise(parts: Sequence[dict[str, Any]], run: dict[str, Any]) -> list[str]:
    """Name the profiles and seeds of parts left by other runs than the one of the header."""
    # Parts that a user's own notebook left may not say it.
    made_with = {(part.get("profile"), part.get("seed")) for part in parts}
    others = made_with - {(run["profile"], run["seed"]), (None, None)}
    return sorted(f"{profile} profile, seed {seed}" for profile, seed in others)


def _published_value(item_id: str) -> dict[str, Any] | None:
    """Give a published single value; published tables stand in the tables themselves."""
    if item_id not in published_ids():
        return None
    found = published(item_id)
    if found.value is None:
        return None
    return {"value": f"{found.value:.2f}", "quantity": found.quantity}


def _figure(out: Path, part: dict[str, Any]) -> dict[str, Any]:
    """Prepare a figure: its data go into a script of their own, which is read when it is seen.

    A page opened from a folder may not fetch files, but it may load scripts; with the data of
    all figures inside it, the page would be slow to open.
    """
    path = out / "figures" / f"{part['name']}.json"
    content = path.read_text(encoding="utf-8")
    script = f"showFigure({json.dumps(part['name'])}, {content});\n"
    write_atomically(path.with_suffix(".js"), script.encode())
    height = json.loads(content).get("layout", {}).get("height", 450)
    has_image = path.with_suffix(".png").exists()
    return {**part, "height": height, "has_image": has_image}


def _table(part: dict[str, Any]) -> dict[str, Any]:
    """Prepare a table: header rows with spans, and cells as text."""
    columns = part["columns"]
    two_levels = bool(columns) and len(columns[0]) == 2
    groups: list[dict[str, Any]] = []
    for column in columns if two_levels else []:
        if groups and groups[-1]["name"] == column[0]:
            groups[-1]["span"] += 1
        else:
            groups.append({"name": column[0], "span": 1})
    starts = [
        index == 0 or column[0] != columns[index - 1][0] for index, column in enumerate(columns)
    ]
    heads = [
        {"name": column[-1], "first": two_levels and starts[index]}
        for index, column in enumerate(columns)
    ]
    rows = []
    for name, values in zip(part["index"], part["rows"], strict=True):
        cells = [
            {
                "text": format_cell(value, signed=column[-1] == _SIGNED),
                "first": head["first"],
                "ours": column[-1] == "ours",
            }
            for value, column, head in zip(values, columns, heads, strict=True)
        ]
        rows.append({"name": name, "cells": cells})
    return {**part, "groups": groups, "heads": heads, "body": rows}


def _data(out: Path, notebooks: Sequence[str]) -> list[dict[str, Any]]:
    """Say which data each notebook used."""
    found = []
    for name in notebooks:
        path = out / "data" / f"{name}.json"
        if path.is_file():
            found.append(json.loads(path.read_text(encoding="utf-8")))
    return found


def _describe_data(data: Sequence[dict[str, Any]]) -> str:
    """Say in a sentence how many clips and which tables were used."""
    sizes = {name: size for record in data for name, size in record["sizes"].items()}
    clips = {name: size for name, size in sizes.items() if name.startswith("cmu")}
    tables = [
        f"{name.removeprefix('uci/')} ({size} rows)"
        for name, size in sizes.items()
        if name not in clips
    ]
    parts = []
    if clips:
        lengths = f"{min(clips.values())} to {max(clips.values())} frames"
        parts.append(f"{len(clips)} motion capture clips of {lengths}")
    if tables:
        parts.append(f"{len(tables)} tables: {', '.join(tables)}")
    return f"Data: {'; '.join(parts)}." if parts else "No data were used."
