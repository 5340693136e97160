"""Results on disk."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from workbench.errors import DataError
from workbench.experiments.store import ResultStore
from workbench.files import write_atomically

KEY = "a" * 64
ROW = {"error": 0.1 + 0.2, "dataset": "uci/iris", "optimizer": None, "n_samples": 150}
ARRAYS = {"embedding": np.arange(6.0).reshape(3, 2) / 7}


@pytest.fixture
def store(tmp_path: Path) -> ResultStore:
    """Give a store with one result."""
    store = ResultStore(tmp_path / "results")
    store.write(KEY, ROW, ARRAYS)
    return store


def test_a_result_comes_back_to_the_last_bit(store: ResultStore):
    """Rows and arrays are read as they were written."""
    assert store.read(KEY) == ROW
    assert np.array_equal(store.arrays(KEY)["embedding"], ARRAYS["embedding"])


def test_an_unknown_key_is_no_result(store: ResultStore):
    """What was not stored is not found, and asking for its arrays says so."""
    assert store.read("b" * 64) is None
    with pytest.raises(DataError, match="run it again"):
        store.arrays("b" * 64)


def _truncate(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-20])


def _flip(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(bytes(content))


def _empty(path: Path) -> None:
    path.write_bytes(b"")


def _rename(path: Path) -> None:
    path.write_bytes(path.read_bytes().replace(b"uci/iris", b"uci/wine"))


@pytest.mark.parametrize("damage", [_truncate, _flip, _empty, _rename])
def test_a_damaged_row_is_noticed(store: ResultStore, damage):
    """A row that was cut, altered or emptied counts as not there, with a warning."""
    damage(store.folder / f"{KEY}.json")
    with pytest.warns(UserWarning, match="damaged"):
        assert store.read(KEY) is None


@pytest.mark.parametrize("damage", [_truncate, _flip, _empty, Path.unlink])
def test_damaged_arrays_are_noticed(store: ResultStore, damage):
    """A row whose arrays are damaged or gone counts as not there."""
    damage(next(store.folder.glob("*.npz")))
    with pytest.warns(UserWarning, match="damaged"):
        assert store.read(KEY) is None
    with pytest.raises(DataError):
        store.arrays(KEY)


def test_a_result_of_another_key_is_refused(store: ResultStore):
    """A file that was renamed does not stand for another run."""
    (store.folder / f"{KEY}.json").rename(store.folder / f"{'b' * 64}.json")
    with pytest.warns(UserWarning, match="damaged"):
        assert store.read("b" * 64) is None


def test_an_interrupted_write_leaves_the_old_file(tmp_path: Path, monkeypatch):
    """A write that fails at the last step leaves the earlier content and no litter."""
    path = tmp_path / "file"
    write_atomically(path, b"old")

    def refuse(*_):
        raise OSError("no space")

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(OSError, match="no space"):
        write_atomically(path, b"new")
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_the_table_holds_every_row(store: ResultStore):
    """``runs.parquet`` gathers all results of the folder, different columns too."""
    store.write("c" * 64, {"error": 1.0, "extra": "x"}, {})
    store.write_table()
    table = pd.read_parquet(store.folder / "runs.parquet")
    assert table["error"].tolist() == [ROW["error"], 1.0]
    assert table["extra"].tolist()[1] == "x"


def test_rows_that_json_cannot_hold_are_refused(store: ResultStore):
    """NaN would come back as text that is not JSON."""
    with pytest.raises(ValueError, match="JSON"):
        store.write("d" * 64, {"error": float("nan")}, {})
