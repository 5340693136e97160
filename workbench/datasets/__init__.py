"""Data sets: the catalogue, a user's own files, the search path and downloads."""

from __future__ import annotations

from workbench.datasets.entries import Entry
from workbench.datasets.files import read_table
from workbench.datasets.loaders import (
    Status,
    check,
    fetch,
    list_datasets,
    load,
    load_space,
    register_dataset,
    registered_datasets,
)
from workbench.datasets.tables import Table

__all__ = [
    "Entry",
    "Status",
    "Table",
    "check",
    "fetch",
    "list_datasets",
    "load",
    "load_space",
    "read_table",
    "register_dataset",
    "registered_datasets",
]
