"""The tables of Table 5.3 of Costa 2018, and the figures that show them."""

from __future__ import annotations

from dataclasses import dataclass, field

from workbench.figures.style import BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILLION
from workbench.reproduction.published import published, published_ids

#: Seeds of the full profile, beginning with that of the notebook.
N_SEEDS = 3

_OLIVE, _VIOLET, _BROWN = "#7D7A1E", "#6A4C9C", "#8A5A3B"


@dataclass(frozen=True)
class UciTable:
    """A table of Table 5.3, and the figure that shows it.

    Attributes
    ----------
    dataset : str
        Name of the table.
    title : str
        What the thesis calls it.
    item : str
        Id of its figure.
    method : str
        The seed projector of the figure, one of the names in ``PROJECTORS``.
    styles : dict of str to (colour, symbol)
        Its classes, in the order and nearest to the colours of the figure's caption.
    large : bool
        Whether it has so many rows that the quick profile makes its figure alone, and the
        full one takes fewer seeds.
    n_seeds : int
        From how many seeds the full profile runs it.
    note : str
        What a reader should know of the figure.
    """

    dataset: str
    title: str
    item: str
    method: str
    styles: dict[str, tuple[str, str]] = field(default_factory=dict, hash=False)
    large: bool = False
    n_seeds: int = N_SEEDS
    note: str = ""

    @property
    def published_ratio(self) -> float | None:
        """The stress ratio in the caption of the published figure."""
        return published(self.item).value if self.item in published_ids() else None


#: In the order of the figures; Cloud is in Table 5.3 and has none.
UCI_TABLES = (
    UciTable(
        "uci/ionosphere",
        "Ionosphere",
        "costa2018:fig5.12",
        "MDS",
        {"good": (GREEN, "circle"), "bad": (BLUE, "circle")},
    ),
    UciTable(
        "uci/iris",
        "Iris",
        "costa2018:fig5.13",
        "Isomap",
        {
            "setosa": (BLUE, "circle"),
            "versicolor": (GREEN, "circle"),
            "virginica": (VERMILLION, "circle"),
        },
    ),
    UciTable(
        "uci/seeds",
        "Seeds",
        "costa2018:fig5.14",
        "LLE",
        {
            "Kama": (BLUE, "circle"),
            "Rosa": (GREEN, "circle"),
            "Canadian": (VERMILLION, "circle"),
        },
    ),
    UciTable(
        "uci/wine",
        "Wine",
        "costa2018:fig5.15",
        "Force",
        {
            "cultivar 1": (BLUE, "circle"),
            "cultivar 2": (GREEN, "circle"),
            "cultivar 3": (VERMILLION, "circle"),
        },
    ),
    UciTable(
        "uci/page-blocks",
        "Page blocks",
        "costa2018:fig5.16",
        "PCA",
        {
            "text": (BLUE, "circle"),
            "horizontal line": (SKY, "triangle-up"),
            "picture": (GREEN, "diamond"),
            "vertical line": (PURPLE, "square"),
            "graphic": (VERMILLION, "diamond"),
        },
        large=True,
        n_seeds=1,
    ),
    UciTable(
        "uci/yeast",
        "Yeast",
        "costa2018:fig5.17",
        "t-SNE",
        {
            "CYT": (BLUE, "circle"),
            "NUC": (GREY, "circle"),
            "MIT": (ORANGE, "circle"),
            "ME3": (_OLIVE, "diamond"),
            "ME2": (VERMILLION, "diamond"),
            "ME1": (_VIOLET, "diamond"),
            "EXC": (GREEN, "triangle-up"),
            "VAC": (_BROWN, "square"),
            "POX": (PURPLE, "square"),
            "ERL": (SKY, "triangle-up"),
        },
        large=True,
    ),
    UciTable(
        "uci/cloud",
        "Cloud",
        "extra:uci-cloud",
        "LLE",
        large=True,
        note="Not a figure of the thesis, whose Table 5.3 has a change for this table with LLE.",
    ),
)
