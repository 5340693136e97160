"""A study is found by its name from every page, wherever the page's kernel runs."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from workbench.dashboards.study.files import known_studies, study_of_address, study_path
from workbench.errors import WorkbenchError


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Give a folder for studies, while another one is the working folder."""
    folder, elsewhere = tmp_path / "studies", tmp_path / "elsewhere"
    for path in (folder, elsewhere):
        path.mkdir()
    monkeypatch.setenv("WORKBENCH_STUDIES", str(folder))
    monkeypatch.chdir(elsewhere)
    return folder


@pytest.mark.parametrize("name", ["mine", "mine.sqlite", " mine "], ids=repr)
def test_a_name_alone_lies_in_the_folder_of_studies(folder: Path, name: str) -> None:
    """With or without its ending."""
    assert study_path(name) == folder / "mine.sqlite"


@pytest.mark.parametrize(
    ("name", "file"),
    [("study 1.5", "study 1.5.sqlite"), ("old.db", "old.db"), ("ANSWERS.CSV", "ANSWERS.CSV")],
    ids=["a number", "a database", "a table"],
)
def test_only_known_endings_are_no_part_of_a_name(folder: Path, name: str, file: str) -> None:
    """A study that is called after a version is listed with the others."""
    assert study_path(name) == folder / file


def test_a_file_in_the_folder_is_found_by_its_whole_name(folder: Path) -> None:
    """Whatever its ending is."""
    (folder / "answers.data").touch()
    assert study_path("answers.data") == folder / "answers.data"


def test_a_path_is_taken_as_it_is(folder: Path, tmp_path: Path) -> None:
    """A whole one, and a file that is there."""
    assert study_path(tmp_path / "other") == tmp_path / "other.sqlite"
    Path("answers.csv").touch()
    assert study_path("answers.csv") == tmp_path / "elsewhere" / "answers.csv"


def test_no_name_is_refused(folder: Path) -> None:
    """Rather than taken for the folder."""
    with pytest.raises(WorkbenchError, match="study: got no name"):
        study_path("  ")


def test_studies_are_listed_with_the_latest_first(folder: Path) -> None:
    """Other files are not, and a folder that is missing is empty."""
    for age, name in enumerate(("new.sqlite", "old.sqlite", "notes.txt")):
        (folder / name).touch()
        os.utime(folder / name, (1e9 - age, 1e9 - age))
    assert known_studies() == ["new.sqlite", "old.sqlite"]
    for file in folder.iterdir():
        file.unlink()
    folder.rmdir()
    assert known_studies() == []


@pytest.mark.parametrize(
    ("query", "name"),
    [("study=my%20study&theme=dark", "my study"), ("theme=dark", ""), ("", "")],
    ids=["asked for", "another query", "none"],
)
def test_a_page_is_asked_for_a_study_by_its_address(
    query: str, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As Voila hands the address to the kernel."""
    monkeypatch.setenv("QUERY_STRING", query)
    assert study_of_address() == name
