"""The figures and tables that are reproduced, and the notebooks that make them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from workbench.errors import WorkbenchError
from workbench.reproduction.outputs import NOT_MADE, read_error, read_parts

TABLE_5_1 = "costa2018_table_5_1"
FIGURES_5_12_TO_5_17 = "costa2018_figures_5_12_to_5_17"
OPTIMIZERS = "optimizers"


@dataclass(frozen=True)
class Item:
    """A figure or table, of a thesis or of our own.

    Attributes
    ----------
    id : str
        Such as ``"costa2018:fig5.3"``.
    title : str
        What it shows.
    place : str
        Where it is published.
    notebook : str
        Name of the notebook that makes it, without its ending.
    """

    id: str
    title: str
    place: str
    notebook: str


def _uci(number: int, page: int, title: str) -> Item:
    return Item(
        f"costa2018:fig5.{number}",
        title,
        f"Costa 2018, Figure 5.{number}, page {page}",
        FIGURES_5_12_TO_5_17,
    )


ITEMS = (
    Item(
        "costa2018:fig5.3",
        "Reconstruction error of temporal and optimized spatial schemes",
        "Costa 2018, Figure 5.3, page 30",
        TABLE_5_1,
    ),
    Item(
        "costa2018:tab5.1",
        "Reconstruction error of temporal and optimized spatial schemes, in numbers",
        "Costa 2018, Table 5.1, page 23",
        TABLE_5_1,
    ),
    _uci(12, 34, "Ionosphere, projected by MDS"),
    _uci(13, 35, "Iris, projected by Isomap"),
    _uci(14, 35, "Seeds, projected by LLE"),
    _uci(15, 36, "Wine, projected by Force"),
    _uci(16, 36, "Page blocks, projected by PCA"),
    _uci(17, 37, "Yeast, projected by t-SNE"),
    Item(
        "extra:optimizers",
        "Our optimizers, local and global, beside Alg. 12",
        "Not in the thesis, whose optimizer is Costa 2018, Alg. 12",
        OPTIMIZERS,
    ),
)

#: What the notebooks make beside what they are asked for.
EXTRAS = (
    Item(
        "extra:uci-cloud",
        "Cloud, projected by LLE",
        "Not a figure of the thesis; the data set is in Table 5.3",
        FIGURES_5_12_TO_5_17,
    ),
    Item(
        "extra:uci-stress",
        "Stress ratios of all tables found",
        "In the manner of Costa 2018, Table 5.3, page 27",
        FIGURES_5_12_TO_5_17,
    ),
)


def select_items(ids: list[str] | tuple[str, ...] | None = None) -> list[Item]:
    """Look up items by id.

    Parameters
    ----------
    ids : sequence of str, optional
        Such as ``["costa2018:fig5.3"]``; all if None or empty.

    Returns
    -------
    list of Item
        In the order of :data:`ITEMS`.

    Raises
    ------
    WorkbenchError
        If an id is unknown; the message lists those that exist.
    """
    known = [item.id for item in ITEMS]
    for item_id in ids or ():
        if item_id not in known:
            raise WorkbenchError(f"id: got {item_id!r}, want one of {', '.join(known)}")
    return [item for item in ITEMS if not ids or item.id in ids]


def item_state(item: Item, out: str | Path) -> str:
    """Tell whether an item has been made in an output folder.

    Parameters
    ----------
    item : Item
        The item.
    out : path-like
        The output folder; it need not exist.

    Returns
    -------
    {"done", "missing", "failed"}
        "failed" if its notebook, run for it, ended with an error, "missing" if it was not
        run or its data were not there.
    """
    if read_error(Path(out), item.notebook, item.id):
        return "failed"
    made = [part for part in read_parts(Path(out)) if part["item"] == item.id]
    return "done" if any(part["kind"] != NOT_MADE for part in made) else "missing"
