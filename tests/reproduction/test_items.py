"""The list of figures and tables."""

from __future__ import annotations

import re

from workbench.reproduction.items import EXTRAS, ITEMS, NOTEBOOKS


def test_every_figure_and_table_of_both_theses_is_listed():
    """The 62 figures and tables that the theses' own lists name, none missing, none twice."""
    costa = [f"fig{n}" for n in ("2.1", "3.1", "3.2", "3.3", "3.4", "4.1", "4.2", "6.1", "6.2")]
    costa += [f"fig5.{n}" for n in range(1, 18)] + [f"tab5.{n}" for n in (1, 2, 3)]
    halit = [f"fig{n}" for n in ("2.1", "3.1", "3.2", "3.3", "3.4", "4.1", "4.2", "4.3")]
    halit += [f"fig5.{n}" for n in range(1, 10)] + [f"figA.{n}" for n in range(1, 6)]
    halit += ["tab4.1", "tab4.2"] + [f"tab5.{n}" for n in range(1, 10)]
    expected = [f"costa2018:{place}" for place in costa] + [f"halit2010:{p}" for p in halit]
    assert len(expected) == 62
    found = [item.id for item in ITEMS if re.match(r"(costa2018|halit2010):(fig|tab)", item.id)]
    assert sorted(found) == sorted(expected)


def test_places_cite_the_thesis_and_the_page():
    """A published item says where it stands; ours do not pretend to be published."""
    for item in (*ITEMS, *EXTRAS):
        cited = re.fullmatch(
            r"(Costa 2018|Halit 2010), (Figure|Table|section) [\dA.]+, page \d+", item.place
        )
        assert bool(cited) == (not item.id.startswith("extra:")), item


def test_every_notebook_makes_something_and_is_named_once():
    """Names are unique, and an item's notebook is the one that lists it."""
    names = [notebook.name for notebook in NOTEBOOKS]
    assert len(set(names)) == len(names)
    for notebook in NOTEBOOKS:
        assert notebook.items
        assert {item.notebook for item in (*notebook.items, *notebook.extras)} == {notebook.name}
