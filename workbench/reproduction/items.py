"""The figures and tables that are reproduced, and the notebooks that make them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from workbench.errors import WorkbenchError
from workbench.reproduction.outputs import NOT_MADE, read_error, read_parts

if TYPE_CHECKING:
    from workbench.experiments.runs.base import Run


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


@dataclass(frozen=True)
class Notebook:
    """A notebook and what it makes.

    Attributes
    ----------
    name : str
        Name of its file, without its ending.
    items : tuple of Item
        What can be asked for.
    extras : tuple of Item
        What it makes beside them, when it makes all of them.
    runs : str
        Where the function ``planned_runs(profile, seed)`` lies that lists the runs it reads,
        as a module of :mod:`workbench.reproduction`; empty if it reads none. So a
        reproduction executes the runs of all notebooks at once, each of them once.
    tables : bool
        Whether it uses tables, which are then downloaded if that takes seconds.
    """

    name: str
    items: tuple[Item, ...]
    extras: tuple[Item, ...] = ()
    runs: str = ""
    tables: bool = False

    def planned_runs(self, profile: str, seed: int) -> list[Run]:
        """List the runs that the notebook will read."""
        if not self.runs:
            return []
        module = import_module(f"workbench.reproduction.{self.runs}")
        found: list[Run] = module.planned_runs(profile, seed)
        return found


#: What is before the colon of an id, and how the thesis is cited.
_THESES = {"costa2018": "Costa 2018", "halit2010": "Halit 2010"}
_KINDS = {"fig": "Figure", "tab": "Table", "sec": "section"}


def _notebook(
    name: str,
    items: dict[str, tuple[int, str]],
    *,
    own: dict[str, tuple[str, str]] | None = None,
    extras: dict[str, tuple[str, str]] | None = None,
    runs: str = "",
    tables: bool = False,
) -> Notebook:
    """Describe a notebook by pages and titles of published items, places and titles of ours."""
    published = [Item(i, title, _place(i, page), name) for i, (page, title) in items.items()]
    ours = [Item(i, title, place, name) for i, (place, title) in (own or {}).items()]
    beside = [Item(i, title, place, name) for i, (place, title) in (extras or {}).items()]
    return Notebook(name, (*published, *ours), tuple(beside), runs, tables)


def _place(item_id: str, page: int) -> str:
    """Cite a thesis: "Costa 2018, Figure 5.3, page 30"."""
    thesis, _, place = item_id.partition(":")
    return f"{_THESES[thesis]}, {_KINDS[place[:3]]} {place[3:]}, page {page}"


#: In the order of the theses; ours come last. A notebook that is asked for by one of its items
#: may make items of several chapters.
NOTEBOOKS = (
    _notebook(
        "costa2018_workflows",
        {
            "costa2018:fig2.1": (8, "Two-step projection by RBFP, control points by ROLS"),
            "costa2018:fig3.1": (13, "Workflow of a temporal scheme"),
            "costa2018:fig3.2": (14, "Workflow of a spatial scheme"),
            "costa2018:fig3.3": (14, "Workflow of a spatial scheme with RBF projection"),
        },
    ),
    _notebook(
        "costa2018_embeddings",
        {
            "costa2018:fig3.4": (16, "Two-step projections of the poses of one clip"),
            "costa2018:fig4.1": (18, "Optimized projections of the poses of one clip"),
            "costa2018:fig6.2": (41, "Projections and keyframes of the poses of one clip"),
        },
        runs="costa2018.embeddings",
    ),
    _notebook(
        "costa2018_poses",
        {
            "costa2018:fig4.2": (19, "Twelve poses of one clip"),
            "costa2018:fig6.1": (
                39,
                "Authoring: inspect poses, deform the curve, choose keys",
            ),
        },
        runs="costa2018.poses",
    ),
    _notebook(
        "costa2018_keyframe_ratio",
        {"costa2018:fig5.1": (28, "Reconstruction error against the share of keyframes")},
        runs="costa2018.keyframe_ratio",
    ),
    _notebook(
        "costa2018_selectors",
        {"costa2018:fig5.2": (29, "Mean error of selectors with temporal and spatial schemes")},
        runs="costa2018.selectors",
    ),
    _notebook(
        "costa2018_table_5_1",
        {
            "costa2018:fig5.3": (30, "Reconstruction error of temporal and spatial schemes"),
            "costa2018:tab5.1": (23, "Reconstruction error of the schemes, in numbers"),
        },
        runs="costa2018.keyframe_errors",
    ),
    _notebook(
        "costa2018_two_step",
        {
            "costa2018:fig5.4": (30, "Error of one-step and two-step projection"),
            "costa2018:tab5.2": (26, "Stress after optimization over stress before, motion"),
            "costa2018:fig5.6": (31, "Walk cycle, RBFP with LLE, before and after optimization"),
            "costa2018:fig5.7": (32, "Jump and balance, RBFP with Force"),
            "costa2018:fig5.8": (32, "Walk on uneven terrain, RBFP with MDS"),
            "costa2018:fig5.9": (33, "Dance, RBFP with t-SNE"),
            "costa2018:fig5.10": (33, "Dance, RBFP with PCA"),
            "costa2018:fig5.11": (34, "Basketball, RBFP with Isomap"),
        },
        runs="costa2018.two_step",
    ),
    _notebook(
        "costa2018_running_time",
        {"costa2018:fig5.5": (31, "Running time of projectors, per frame")},
        runs="costa2018.running_time",
    ),
    _notebook(
        "costa2018_compression",
        {"costa2018:sec5.1": (24, "Size of compacted motion: formulas and bytes written")},
        runs="costa2018.compression",
    ),
    _notebook(
        "costa2018_uci",
        {
            "costa2018:tab5.3": (27, "Stress after optimization over stress before, tables"),
            "costa2018:fig5.12": (34, "Ionosphere, RBFP with MDS"),
            "costa2018:fig5.13": (35, "Iris, RBFP with Isomap"),
            "costa2018:fig5.14": (35, "Seeds, RBFP with LLE"),
            "costa2018:fig5.15": (36, "Wine, RBFP with Force"),
            "costa2018:fig5.16": (36, "Page blocks, RBFP with PCA"),
            "costa2018:fig5.17": (37, "Yeast, RBFP with t-SNE"),
        },
        extras={
            "extra:uci-cloud": (
                "Not a figure of the thesis; the data set is in Table 5.3",
                "Cloud, RBFP with LLE",
            ),
        },
        runs="costa2018.uci_projections",
        tables=True,
    ),
    _notebook(
        "halit2010_overview",
        {
            "halit2010:fig2.1": (4, "Three families of keyframe extraction"),
            "halit2010:fig3.1": (10, "Outline of the saliency method"),
            "halit2010:fig3.2": (11, "Steps of the saliency method"),
        },
    ),
    _notebook(
        "halit2010_saliency",
        {
            "halit2010:fig3.3": (15, "Saliency of the frames of a walk"),
            "halit2010:fig3.4": (15, "Candidate keyframes on a motion curve"),
        },
    ),
    _notebook(
        "halit2010_parameters",
        {
            "halit2010:fig4.1": (26, "Error against the number of components and the scale"),
            "halit2010:fig4.2": (27, "Running time against the number of frames"),
        },
        runs="halit2010.parameters",
    ),
    _notebook(
        "halit2010_comparison",
        {
            "halit2010:tab4.1": (23, "Error of keyframe extraction methods"),
            "halit2010:tab4.2": (24, "Signal-to-noise ratio of keyframe extraction methods"),
        },
        runs="halit2010.comparison",
    ),
    _notebook(
        "halit2010_thumbnails",
        {
            "halit2010:fig4.3": (29, "Keyframes of a motion and their thumbnail"),
            "halit2010:figA.1": (52, "Summary of a basketball motion"),
            "halit2010:figA.2": (53, "Summary of a walking motion"),
            "halit2010:figA.3": (54, "Summary of a boxing motion"),
            "halit2010:figA.4": (55, "Summary of a flip"),
            "halit2010:figA.5": (56, "Summary of a dancing motion"),
        },
    ),
    _notebook(
        "halit2010_user_study",
        {
            item: (page, f"{what} {test}")
            for number, (page, test) in enumerate(
                (
                    (33, "of methods, basketball"),
                    (34, "of methods, boxing"),
                    (35, "of methods, walking"),
                    (37, "of parameters, basketball"),
                    (38, "of parameters, flip"),
                    (39, "of parameters, walking"),
                    (41, "of contact handling, basketball"),
                    (42, "of contact handling, dancing"),
                    (43, "of contact handling, walking"),
                ),
                1,
            )
            for item, what in (
                (f"halit2010:fig5.{number}", "Ratings"),
                (f"halit2010:tab5.{number}", "Paired comparisons"),
            )
        },
    ),
    _notebook(
        "halit2010_readings",
        {},
        own={
            "extra:saliency-readings": (
                "Not in the thesis, whose Tables 4.1 and 4.2 it tries to reach",
                "Readings of the saliency method, and how selectors compare at its counts",
            ),
        },
        runs="halit2010.readings",
    ),
    _notebook(
        "optimizers",
        {},
        own={
            "extra:optimizers": (
                "Not in the thesis, whose optimizer is Costa 2018, Alg. 12",
                "Our optimizers, local and global, beside Alg. 12",
            ),
        },
        runs="beyond.optimizer_runs",
    ),
    _notebook(
        "selection_optimum",
        {},
        own={
            "extra:selection-optimum": (
                "Not in the theses, whose selectors are greedy",
                "How far keyframe selectors are from the optimum",
            ),
        },
        runs="beyond.selection_optimum",
    ),
    _notebook(
        "control_point_share",
        {},
        own={
            "extra:control-point-share": (
                "Future work in Costa 2018, chapter 7",
                "Which share of control points serves the optimizer best on tables",
            ),
        },
        runs="beyond.control_point_share",
        tables=True,
    ),
    _notebook(
        "three_dimensions",
        {},
        own={
            "extra:three-dimensions": (
                "Future work in Costa 2018, chapter 7",
                "Embeddings in three dimensions: error and bytes",
            ),
        },
        runs="beyond.three_dimensions",
        tables=True,
    ),
    _notebook(
        "held_out",
        {},
        own={
            "extra:held-out": (
                "Not in the thesis, whose optimizer sees the samples that it is judged by",
                "Does optimization help on samples that it has not seen?",
            ),
        },
        runs="beyond.held_out",
        tables=True,
    ),
)

ITEMS = tuple(item for notebook in NOTEBOOKS for item in notebook.items)

#: What the notebooks make beside what they are asked for.
EXTRAS = tuple(item for notebook in NOTEBOOKS for item in notebook.extras)


def select_items(ids: Sequence[str] | None = None) -> list[Item]:
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
