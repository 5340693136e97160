"""Download data sets from their public addresses into the cache.

A download is checked by reading it before it gets its place, so that the cache never holds
a file that is cut short, altered, or an error page; and it gets its place by a rename, so
that two processes that download the same file at once do not disturb each other.
"""

from __future__ import annotations

import os
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from workbench.datasets.entries import Download, Entry, Source
from workbench.datasets.search import absent_folders
from workbench.datasets.unpacking import unpack
from workbench.errors import DataError, WorkbenchError

CONNECT_SECONDS = 10.0
READ_SECONDS = 30.0
TOTAL_SECONDS = 300.0


def download(entry: Entry, folder: Path, *, seconds: float = TOTAL_SECONDS) -> Path:
    """Download a data set and check it.

    Parameters
    ----------
    entry : Entry
        The data set.
    folder : Path
        The data folder that receives it, usually the cache.
    seconds : float
        The longest time that one file may take.

    Returns
    -------
    Path
        The main file.

    Raises
    ------
    DataError
        If it cannot be had, or what came is not the data set; the folder is unchanged then.
    """
    if not entry.downloads:
        raise DataError(f"{entry.name} has no address to download it from; {_by_hand(entry)}")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(prefix=".download-", dir=folder) as scratch:
            received = [_receive(entry, part, Path(scratch), seconds) for part in entry.downloads]
            _check(entry, received[-1])
            for part, file in zip(entry.downloads, received, strict=True):
                target = folder / part.target
                target.parent.mkdir(parents=True, exist_ok=True)
                os.replace(file, target)
    except OSError as error:
        raise DataError(
            f"cannot keep {entry.name} in {folder} ({error.strerror}); name a folder that can be "
            "written in WORKBENCH_CACHE"
        ) from None
    return folder / entry.downloads[-1].target


def _receive(entry: Entry, part: Download, scratch: Path, seconds: float) -> Path:
    """Get one file from the first address that has it."""
    failures = []
    for source in part.sources:
        target = scratch / Path(part.target).name
        try:
            _transfer(source, target, seconds)
            target.write_bytes(unpack(target.read_bytes(), source.member))
        except DataError as error:
            failures.append(f"{source.address}: {error}")
        else:
            return target
    raise DataError(f"cannot download {entry.name} ({'; '.join(failures)}); {_by_hand(entry)}")


def _transfer(source: Source, target: Path, seconds: float) -> None:
    # Imported here because listing data sets should not wait for it.
    import pooch
    import requests
    from urllib3.exceptions import ReadTimeoutError

    transfer = pooch.HTTPDownloader(
        progressbar=_Deadline(seconds),
        timeout=(min(CONNECT_SECONDS, seconds), min(READ_SECONDS, seconds)),
    )
    try:
        transfer(source.address, str(target), None)
    except requests.HTTPError as error:
        answer = "" if error.response is None else f" {error.response.status_code}"
        raise DataError(f"the server answered{answer}") from None
    except (requests.Timeout, TimeoutError):
        raise DataError("the server took too long") from None
    except requests.exceptions.ChunkedEncodingError:
        raise DataError("the connection was cut") from None
    except requests.ConnectionError as error:
        if isinstance(error.args[0] if error.args else None, ReadTimeoutError):
            raise DataError("the server took too long") from None
        raise DataError("no network or no such server") from None
    except requests.RequestException as error:
        raise DataError(f"the transfer failed ({type(error).__name__})") from None


class _Deadline:
    """End a transfer that trickles, through pooch's interface for progress bars."""

    def __init__(self, seconds: float) -> None:
        self.total = 0
        self._end = time.monotonic() + seconds

    def update(self, _size: int) -> None:
        if time.monotonic() > self._end:
            raise TimeoutError

    def reset(self) -> None:
        pass

    def close(self) -> None:
        pass


def _check(entry: Entry, path: Path) -> None:
    try:
        entry.read(path)
    except WorkbenchError as error:
        reason = str(error).replace(f"{path}", "it")
        raise DataError(f"refused the download of {entry.name}: {reason}") from None


def _by_hand(entry: Entry) -> str:
    name = Path(entry.downloads[-1].target if entry.downloads else entry.files[0]).name
    return f"put {name} into a folder and name that folder in WORKBENCH_DATA{absent_folders()}"
