"""Downloads, from a real server on the loopback."""

from __future__ import annotations

import io
import os
import socket
import subprocess
import sys
import threading
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from workbench.datasets import loaders
from workbench.datasets.catalogue import lookup
from workbench.datasets.download import download
from workbench.datasets.entries import Download, Entry, Source
from workbench.errors import DataError
from workbench.resources import bundled

Served = Callable[..., Entry]
YEAST = (bundled("datasets") / "uci" / "yeast.data").read_bytes()


@pytest.fixture
def yeast() -> Entry:
    entry = lookup("uci/yeast")
    assert entry is not None
    return entry


def leftovers(folder: Path) -> list[Path]:
    return [path for path in folder.rglob("*") if path.is_file()] if folder.exists() else []


def test_downloads_into_the_cache_layout(
    server: Any, cache: Path, yeast: Entry, served: Served
) -> None:
    """A good download lies where any data folder has it, byte for byte, and nothing else."""
    server.pages["/yeast.data"] = YEAST
    path = download(served(yeast, f"{server.address}/yeast.data"), cache)
    assert path == cache / "uci" / "yeast.data"
    assert path.read_bytes() == YEAST
    assert leftovers(cache) == [path]


def test_accepts_another_formatting(server: Any, cache: Path, yeast: Entry, served: Served) -> None:
    """The same numbers with other blanks and line ends are the same data set."""
    server.pages["/yeast.data"] = b"\r\n".join(
        b"\t".join(row.split()) for row in YEAST.split(b"\n")
    )
    path = download(served(yeast, f"{server.address}/yeast.data"), cache)
    assert yeast.read(path).checksum == yeast.checksum  # type: ignore[attr-defined, union-attr]  # a table


@pytest.mark.parametrize(
    ("page", "reason"),
    [
        pytest.param(YEAST.replace(b"0.58", b"0.59", 1), "altered", id="a digit altered"),
        pytest.param(YEAST.replace(b"MIT", b"NUC", 1), "classes", id="a label altered"),
        pytest.param(YEAST[: len(YEAST) // 2 + 2], "rows|fields|number", id="half the rows"),
        pytest.param(b"<html>moved</html>", "fields|number|rows", id="a web page"),
        pytest.param(b"", "empty", id="nothing"),
        pytest.param(b"\0\1\2" * 50, "not text", id="binary"),
    ],
)
def test_refuses_what_is_not_the_data_set(
    page: bytes, reason: str, server: Any, cache: Path, yeast: Entry, served: Served
) -> None:
    """A damaged or altered file is refused, in one line, and removed."""
    server.pages["/yeast.data"] = page
    with pytest.raises(DataError, match=f"refused the download of uci/yeast.*({reason})") as error:
        download(served(yeast, f"{server.address}/yeast.data"), cache)
    assert "\n" not in str(error.value)
    assert leftovers(cache) == []


def test_cut_connection_leaves_nothing(
    server: Any, cache: Path, yeast: Entry, served: Served
) -> None:
    """A connection that ends before the announced length leaves no file behind."""
    server.pages["/yeast.data"] = YEAST
    server.cut.add("/yeast.data")
    with pytest.raises(DataError, match="connection was cut"):
        download(served(yeast, f"{server.address}/yeast.data"), cache)
    assert leftovers(cache) == []


def test_failure_keeps_the_earlier_copy(
    server: Any, cache: Path, yeast: Entry, served: Served
) -> None:
    """A download that fails does not touch a file that is already there."""
    server.pages["/yeast.data"] = YEAST
    entry = served(yeast, f"{server.address}/yeast.data")
    path = download(entry, cache)
    server.cut.add("/yeast.data")
    with pytest.raises(DataError):
        download(entry, cache)
    assert path.read_bytes() == YEAST


def test_trickling_server_is_given_up(
    server: Any, cache: Path, yeast: Entry, served: Served
) -> None:
    """A server that never stalls but never ends is left after the given time."""
    server.pages["/yeast.data"] = YEAST
    server.slow["/yeast.data"] = 0.3
    with pytest.raises(DataError, match="took too long"):
        download(served(yeast, f"{server.address}/yeast.data"), cache, seconds=0.2)
    assert leftovers(cache) == []


def test_missing_page_falls_back_to_the_next_address(
    server: Any, cache: Path, yeast: Entry, served: Served
) -> None:
    """Where the first address answers 404 the second is tried."""
    server.pages["/second"] = YEAST
    path = download(served(yeast, f"{server.address}/first", f"{server.address}/second"), cache)
    assert path.read_bytes() == YEAST
    assert server.requests == ["/first", "/second"]


def test_missing_page_says_what_to_do(
    server: Any, cache: Path, yeast: Entry, served: Served
) -> None:
    """A 404 is one line that names the address, the answer and the way without the network."""
    with pytest.raises(DataError) as error:
        download(served(yeast, f"{server.address}/gone"), cache)
    message = str(error.value)
    assert "\n" not in message
    assert f"{server.address}/gone: the server answered 404" in message
    assert "put yeast.data into a folder and name that folder in WORKBENCH_DATA" in message


def test_no_network_says_what_to_do(cache: Path, yeast: Entry, served: Served) -> None:
    """Without a server to connect to, the message is one line that says what to do."""
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))
        address = f"http://127.0.0.1:{closed.getsockname()[1]}/yeast.data"
        with pytest.raises(DataError) as error:
            download(served(yeast, address), cache)
    message = str(error.value)
    assert message.startswith("cannot download uci/yeast")
    assert "no network" in message
    assert "put yeast.data into a folder" in message
    assert "\n" not in message


@pytest.mark.parametrize("member", ["yeast.data", "other"], ids=["found", "lacking"])
def test_takes_the_file_out_of_an_archive(
    member: str, server: Any, cache: Path, yeast: Entry, served: Served
) -> None:
    """A file inside a zip archive is taken out; an archive without it is refused."""
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("yeast.data", YEAST)
    server.pages["/yeast.zip"] = archive.getvalue()
    entry = served(yeast, f"{server.address}/yeast.zip", member=member)
    if member == "yeast.data":
        assert download(entry, cache).read_bytes() == YEAST
    else:
        with pytest.raises(DataError, match="lacks other"):
            download(entry, cache)


def test_two_processes_download_at_once(server: Any, cache: Path) -> None:
    """Two processes whose downloads overlap both succeed and leave one whole file."""
    server.pages["/yeast.data"] = YEAST
    server.gathering = threading.Barrier(2)  # neither is answered before both have asked
    program = (
        "import sys\n"
        "from dataclasses import replace\n"
        "from pathlib import Path\n"
        "from workbench.datasets.catalogue import lookup\n"
        "from workbench.datasets.download import download\n"
        "from workbench.datasets.entries import Download, Source\n"
        "part = Download('uci/yeast.data', (Source(sys.argv[1]),))\n"
        "download(replace(lookup('uci/yeast'), downloads=(part,)), Path(sys.argv[2]))\n"
    )
    command = [sys.executable, "-c", program, f"{server.address}/yeast.data", str(cache)]
    source = str(Path(loaders.__file__).parents[2])
    environment = {**os.environ, "PYTHONPATH": source}
    processes = [
        subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True)
        for _ in range(2)
    ]
    outcomes = [process.communicate(timeout=120) for process in processes]
    assert [process.returncode for process in processes] == [0, 0], outcomes
    assert leftovers(cache) == [cache / "uci" / "yeast.data"]
    assert (cache / "uci" / "yeast.data").read_bytes() == YEAST


def test_unwritable_cache_names_the_variable(
    server: Any, tmp_path: Path, yeast: Entry, served: Served
) -> None:
    """A cache that cannot be written is an error that says which variable to set."""
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(DataError, match="WORKBENCH_CACHE"):
        download(served(yeast, f"{server.address}/yeast.data"), tmp_path / "file" / "cache")


class TestLoading:
    """Loading and fetching through the cache, with an entry that no folder has."""

    @pytest.fixture
    def entry(self, server: Any, cache: Path, yeast: Entry) -> Entry:
        server.pages["/yeast.data"] = YEAST
        part = Download("uci/proteins.data", (Source(f"{server.address}/yeast.data"),))
        return replace(yeast, name="uci/proteins", files=("uci/proteins.data",), downloads=(part,))

    def test_loading_downloads_once(self, entry: Entry, server: Any) -> None:
        """The first load downloads, the second reads the cache."""
        assert loaders.status(entry).state == "downloadable"
        first, second = loaders.load_entry(entry), loaders.load_entry(entry)
        assert first.checksum == second.checksum  # type: ignore[union-attr]  # tables
        assert server.requests == ["/yeast.data"]
        assert loaders.status(entry).state == "available"

    def test_damaged_cache_is_refused_and_fetched_anew(
        self, entry: Entry, server: Any, cache: Path
    ) -> None:
        """Loading refuses a damaged copy in the cache; fetching replaces it."""
        path = loaders.fetch_entry(entry).path
        assert path is not None
        path.write_bytes(YEAST.replace(b"0.58", b"0.59", 1))
        with pytest.raises(DataError, match="altered"):
            loaders.load_entry(entry)
        assert loaders.fetch_entry(entry).path == path
        assert path.read_bytes() == YEAST
        assert len(server.requests) == 2

    def test_damaged_copy_of_the_user_is_kept(
        self, entry: Entry, tmp_path: Path, server: Any, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """A damaged file in a folder of the user is refused, never replaced."""
        damaged = YEAST.replace(b"0.58", b"0.59", 1)
        own = tmp_path / "own"
        own.mkdir()
        (own / "proteins.data").write_bytes(damaged)
        monkeypatch.setenv("WORKBENCH_DATA", str(own))
        with pytest.raises(DataError, match="altered"):
            loaders.fetch_entry(entry)
        assert (own / "proteins.data").read_bytes() == damaged
        assert server.requests == []

    def test_checking_does_not_download(self, entry: Entry, server: Any) -> None:
        """A check of what is not there says how to get it and stays off the network."""
        with pytest.raises(DataError, match="workbench datasets fetch uci/proteins"):
            loaders.check_entry(entry)
        assert server.requests == []
