"""Fixtures of the data set tests: an empty data world and a real server on the loopback."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from workbench.datasets.entries import Download, Entry, Source
from workbench.datasets.search import user_folders


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Give an empty download cache, without any folder of the user."""
    folder = tmp_path / "cache"
    monkeypatch.setenv("WORKBENCH_CACHE", str(folder))
    monkeypatch.delenv("WORKBENCH_DATA", raising=False)
    return folder


@dataclass
class Server:
    """A server whose pages a test chooses."""

    address: str
    pages: dict[str, bytes] = field(default_factory=dict)
    cut: set[str] = field(default_factory=set)
    slow: dict[str, float] = field(default_factory=dict)
    requests: list[str] = field(default_factory=list)
    gathering: threading.Barrier | None = None


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    """Run a server on the loopback for one test."""
    # A proxy of the machine must not see requests to the loopback.
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    monkeypatch.setenv("no_proxy", "127.0.0.1")

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            state.requests.append(self.path)
            page = state.pages.get(self.path)
            if state.gathering is not None:
                state.gathering.wait(timeout=60)
            if page is None:
                self.send_error(404)
                return
            self.send_response(200)
            self.send_header("Content-Length", str(len(page)))
            self.end_headers()
            if self.path in state.cut:
                self.wfile.write(page[: len(page) // 2])
            elif self.path in state.slow:
                for i in range(0, len(page), 1024):
                    try:
                        self.wfile.write(page[i : i + 1024])
                        self.wfile.flush()
                    except OSError:  # the client has given up, as it should
                        return
                    stop.wait(state.slow[self.path])
            else:
                self.wfile.write(page)

        def log_message(self, *args: object) -> None:
            pass

    stop = threading.Event()
    httpd = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    state = Server(f"http://127.0.0.1:{httpd.server_port}")
    thread = threading.Thread(target=httpd.serve_forever, daemon=True)
    thread.start()
    yield state
    stop.set()
    httpd.shutdown()
    httpd.server_close()
    thread.join(timeout=10)


Served = Callable[..., Entry]


@pytest.fixture
def served() -> Served:
    """Give a function that copies an entry so that its one file comes from other addresses."""

    def copy(entry: Entry, *addresses: str, member: str = "") -> Entry:
        target = entry.downloads[-1].target
        sources = tuple(Source(address, member) for address in addresses)
        return replace(entry, downloads=(Download(target, sources),))

    return copy


@pytest.fixture
def shared_data() -> Path:
    """Give the folder of data that are not bundled, or skip the test and say why."""
    folders = [folder for folder in user_folders() if (folder / "uci" / "seeds.data").is_file()]
    if not folders:
        pytest.skip("needs a folder with uci/seeds.data and the rest named by WORKBENCH_DATA")
    return folders[0]
