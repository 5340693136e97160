"""The catalogue against the data it describes."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from workbench.datasets import check, formats, list_datasets, load
from workbench.datasets.catalogue import TABLES, entries, lookup
from workbench.datasets.clips import CLIPS, RELEASED
from workbench.datasets.entries import ClipEntry, TableEntry, clip_checksum
from workbench.datasets.tables import Table
from workbench.errors import DataError
from workbench.mocap.motion import Motion
from workbench.resources import bundled

# Table 5.3 of Costa 2018 gives the number of attributes of its seven data sets.
ATTRIBUTES = {
    "uci/iris": 4,
    "uci/wine": 13,
    "uci/seeds": 7,
    "uci/yeast": 8,
    "uci/ionosphere": 34,
    "uci/page-blocks": 10,
    "uci/cloud": 10,
}
OFFLINE = ["uci/iris", "uci/wine", "uci/yeast", "uci/ionosphere"]
AMC_PAIRS = ["01_01", "05_09", "05_10", "05_13", "07_05", "09_06"]


def table_entry(name: str) -> TableEntry:
    entry = lookup(name)
    assert isinstance(entry, TableEntry)
    return entry


def test_has_the_seven_tables_of_the_thesis() -> None:
    """The seven tables are there with the published numbers of attributes."""
    assert {entry.name: entry.shape[1] for entry in TABLES} == ATTRIBUTES
    for entry in TABLES:
        assert len(entry.columns) == entry.shape[1]
        assert sum(entry.class_counts.values()) in (0, entry.shape[0])


def test_every_entry_says_where_it_is_from() -> None:
    """Each entry has a page, terms and a citation, and can be had without the network or with."""
    for entry in entries().values():
        assert entry.page.startswith("http"), entry.name
        assert entry.licence, entry.name
        assert entry.citation, entry.name
        assert all(
            source.address.startswith("http") for d in entry.downloads for source in d.sources
        )
        assert entry.downloads or entry.name in OFFLINE


@pytest.mark.parametrize("name", OFFLINE)
def test_offline_tables_match_the_catalogue(name: str, cache: Path) -> None:
    """Without network and without folders, the bundled and built-in tables load and check."""
    assert check(name).state in ("available", "built in")
    table = load(name)
    assert isinstance(table, Table)
    entry = table_entry(name)
    assert table.values.shape == entry.shape
    assert table.class_counts == entry.class_counts
    assert not cache.exists()


@pytest.mark.parametrize("name", sorted(ATTRIBUTES))
def test_shared_copies_match_the_catalogue(name: str, shared_data: Path) -> None:
    """Every table of the shared data folder has the content that the catalogue knows."""
    entry = table_entry(name)
    assert entry.read(shared_data / entry.files[0]).checksum == entry.checksum


@pytest.mark.parametrize("name", ["uci/iris", "uci/wine"])
def test_scikit_learn_has_the_published_table(name: str, shared_data: Path) -> None:
    """The table of the installed scikit-learn equals the file, number by number."""
    entry = table_entry(name)
    built, read = entry.build(), entry.read(shared_data / entry.files[0])
    np.testing.assert_array_equal(built.values, read.values)
    assert built.labels is not None
    assert read.labels is not None
    assert built.labels.tolist() == read.labels.tolist()


def test_iris_is_fishers() -> None:
    """Rows 35 and 38 of Iris are Fisher's, in which UCI's copy differs."""
    values = table_entry("uci/iris").build().values
    np.testing.assert_array_equal(values[[34, 37]], [[4.9, 3.1, 1.5, 0.2], [4.9, 3.6, 1.4, 0.1]])


@pytest.mark.parametrize("file", ["uci/yeast.data", "uci/ionosphere_weka.arff"])
def test_bundled_tables_equal_the_shared_ones(file: str, shared_data: Path) -> None:
    """The bundled copies have the content of the shared data folder."""
    read = formats.read_named if file.endswith("yeast.data") else formats.read_arff_rows
    ours, theirs = read(bundled("datasets") / file), read(shared_data / file)
    np.testing.assert_array_equal(ours.values, theirs.values)
    assert ours.codes == theirs.codes


@pytest.mark.parametrize("trial", ["01_01", "01_03"])
def test_bundled_clips_equal_the_shared_ones(trial: str, shared_data: Path) -> None:
    """The bundled clips have the content of the shared data folder."""
    place = f"mocap/bvh/{trial}.bvh"
    assert clip_checksum(bundled("datasets") / place) == clip_checksum(shared_data / place)


@pytest.mark.parametrize(
    ("name", "rewrite"),
    [
        pytest.param(
            "uci/page-blocks", lambda text: text.replace(",", "  ").split("\n", 1)[1], id="blanks"
        ),
        pytest.param("uci/seeds", lambda text: text.replace(",", ""), id="tabs only"),
        pytest.param("uci/seeds", lambda text: re.sub(r"\t", "\t\t", text), id="doubled tabs"),
        pytest.param("uci/cloud", lambda text: f"Clouds.\n\n{text}\n\nsecond\n{text}", id="prose"),
    ],
)
def test_reads_the_form_that_uci_serves(
    name: str, rewrite: Callable[[str], str], shared_data: Path, tmp_path: Path
) -> None:
    """The original forms, differently delimited, have the same content."""
    entry = table_entry(name)
    original = tmp_path / "original"
    original.write_text(rewrite((shared_data / entry.files[0]).read_text()))
    assert entry.read(original).checksum == entry.checksum


@pytest.mark.parametrize("trial", ["01_01", "01_03"])
def test_bundled_clips_match_the_catalogue(trial: str, cache: Path) -> None:
    """The bundled clips load by name, checked, without T-pose and with their scale."""
    motion = load(f"cmu/{trial}")
    assert isinstance(motion, Motion)
    assert motion.name == f"cmu/{trial}"
    assert len(motion) == CLIPS[trial][0]
    assert motion.skeleton.n_joints == 31
    # The subject is as tall as a person only if a unit is 1/0.45 inch.
    assert motion.skeleton.unit_cm == pytest.approx(5.6444, abs=1e-4)
    assert motion.frame_time == pytest.approx(1 / 120, abs=1e-6)


def test_all_shared_clips_match_the_catalogue(shared_data: Path) -> None:
    """Every clip of the shared data folder has the frames, or the content, that are known."""
    paths = sorted((shared_data / "mocap" / "bvh").glob("*.bvh"))
    assert paths
    for path in paths:
        entry = lookup(f"cmu/{path.stem}")
        assert isinstance(entry, ClipEntry)
        assert entry.frames is not None
        motion = entry.read(path)
        assert (len(motion), motion.skeleton.n_joints) == (entry.frames, 31)
    assert {path.stem for path in paths} >= set(RELEASED)


@pytest.mark.parametrize("trial", AMC_PAIRS)
def test_both_forms_of_a_clip_agree(trial: str, shared_data: Path) -> None:
    """A clip has as many frames, and the same path of the root, as BVH and as AMC."""
    bvh, amc = load(f"cmu/{trial}"), load(f"cmu-amc/{trial}")
    assert isinstance(bvh, Motion)
    assert isinstance(amc, Motion)
    np.testing.assert_allclose(amc.root_translation, bvh.root_translation, atol=1e-3)
    assert amc.skeleton.unit_cm == pytest.approx(bvh.skeleton.unit_cm)


@pytest.mark.parametrize("trial", ["13_29", "13_31", "14_14"])
def test_amc_without_skeleton_is_a_table_of_angles(trial: str, shared_data: Path) -> None:
    """Without its skeleton a clip is a table of the 59 joint angles, unwrapped, and says so."""
    table = load(f"cmu-amc/{trial}")
    assert isinstance(table, Table)
    assert table.values.shape == (CLIPS[trial][0], 59)
    assert np.abs(np.diff(table.values, axis=0)).max() < 180
    assert "no skeleton" in table.notes[0]


def test_an_altered_clip_is_refused_whatever_its_formatting(tmp_path: Path) -> None:
    """Reformatting a released clip changes nothing, altering one digit does."""
    entry = lookup("cmu/01_01")
    assert isinstance(entry, ClipEntry)
    content = (bundled("datasets") / "mocap" / "bvh" / "01_01.bvh").read_text()
    path = tmp_path / "01_01.bvh"
    path.write_text(
        content.replace("\t", "  ").replace("\n", "\r\n", 20).replace(" 0.0000", " 0.0")
    )
    assert len(entry.read(path)) == CLIPS["01_01"][0]
    head, _, tail = content.rpartition("7")
    path.write_text(head + "8" + tail)
    with pytest.raises(DataError, match="differs from the released file"):
        entry.read(path)
    path.write_text(content.replace("OFFSET 1.36306", "OFFSET 1.36307"))
    assert path.read_text() != content
    with pytest.raises(DataError, match="differs from the released file"):
        entry.read(path)


def test_any_trial_of_the_database_has_an_entry() -> None:
    """Trials that are not listed are found by their pattern, with the right addresses."""
    bvh, amc = lookup("cmu/144_07"), lookup("cmu-amc/86_02")
    assert bvh is not None
    assert amc is not None
    assert bvh.downloads[0].sources[0].address.endswith("/data/144/144_07.bvh")
    assert [d.sources[0].address.rpartition("/subjects/")[2] for d in amc.downloads] == [
        "86/86.asf",
        "86/86_02.amc",
    ]
    first = lookup("cmu/05_10")
    assert first is not None
    assert first.downloads[0].sources[0].address.endswith("/data/005/05_10.bvh")
    assert all(lookup(name) is None for name in ("cmu/5_10", "cmu/05_1", "cmu/", "uci/none"))


def test_lists_every_data_set_once(cache: Path) -> None:
    """The list has all entries, each with a state that is true."""
    listed = list_datasets()
    names = [status.entry.name for status in listed]
    assert len(names) == len(set(names))
    assert set(names) >= set(entries())
    states = {status.entry.name: status.state for status in listed}
    assert states["uci/iris"] == "built in"
    assert states["uci/yeast"] == "available"
    assert states["uci/seeds"] == "downloadable"
    assert states["cmu/01_03-swing"] == "available"
    assert all(s.path is not None and s.path.is_file() for s in listed if s.state == "available")
