"""Reproductions with notebooks that work and notebooks that fail."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from html.parser import HTMLParser
from pathlib import Path

import nbformat
import pandas as pd
import psutil
import pytest
from nbformat.v4 import new_code_cell, new_notebook

from tests.browser.chromium import chromium_path
from workbench.errors import WorkbenchError
from workbench.experiments.runs.schemes import SchemeRun
from workbench.reproduction import images
from workbench.reproduction.images import write_pngs
from workbench.reproduction.items import ITEMS, Item, Notebook, item_state
from workbench.reproduction.notebooks import this_interpreter
from workbench.reproduction.outputs import read_parts
from workbench.reproduction.report import write_report
from workbench.reproduction.reproduce import ReproductionReport, reproduce, reproduce_items
from workbench.reproduction.tables import format_cell
from workbench.schemes import SpatialScheme

PARAMETERS = "profile = None\nseed = None\njobs = None\nout = None\nresults = None"
GOOD = """
import sys
import pandas as pd
import plotly.graph_objects as go
from workbench.reproduction.outputs import Outputs

outputs = Outputs(out, profile=profile, seed=seed)
print("drawing", profile, seed, file=sys.stderr)
figure = go.Figure(go.Scatter(x=[1, 2], y=[3, 5]), layout={"height": 300})
outputs.figure("test:fig1", figure, caption="A line & <two> points.", alt="Two points.")
table = pd.DataFrame({("error", "ours"): [0.5, None], ("error", "difference"): [0.25, -1.0]})
table.columns = pd.MultiIndex.from_tuples(table.columns)
outputs.table("test:fig1", table, caption="Two rows.")
outputs.not_made("test:fig2", "The data for it are missing.")
"""
BAD = """
def deeper():
    raise ZeroDivisionError("a <deliberate> failure")

deeper()
"""
FIG1 = Item("test:fig1", "A line", "Nowhere, Figure 1", "good")
FIG2 = Item("test:fig2", "No line", "Nowhere, Figure 2", "good")
FIG3 = Item("test:fig3", "A failure", "Nowhere, Figure 3", "bad")
ABSENT = Item("test:fig4", "Not there", "Nowhere, Figure 4", "absent")


def _write_notebook(path: Path, source: str) -> None:
    parameters = new_code_cell(PARAMETERS, metadata={"tags": ["parameters"]})
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    cells = [parameters, new_code_cell(source.strip())]
    nbformat.write(new_notebook(cells=cells, metadata=kernel), path)


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[ReproductionReport, list[str]]:
    """Reproduce four items of which one notebook fails first and one is not there."""
    folder = tmp_path_factory.mktemp("reproduction")
    for name, source in (("good", GOOD), ("bad", BAD)):
        _write_notebook(folder / f"{name}.ipynb", source)
    messages: list[str] = []
    report = reproduce_items(
        [FIG3, ABSENT, FIG1, FIG2],
        folder,
        profile="quick",
        jobs=1,
        out=folder / "out",
        seed=7,
        progress=messages.append,
    )
    return report, messages


class _Page(HTMLParser):
    """Collect what a page refers to, its ids and its headings."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.loads: list[str] = []
        self.ids: list[str] = []
        self.tags: list[str] = []
        self.images: list[dict[str, str | None]] = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.tags.append(tag)
        if values.get("id"):
            self.ids.append(values["id"])
        if tag == "a":
            self.links.append(values["href"])
        if tag in ("script", "img", "link", "iframe"):
            self.loads += [values[name] for name in ("src", "href") if values.get(name)]
        if tag == "img":
            self.images.append(values)


def test_a_failing_notebook_is_reported_and_the_others_run(run):
    """The failure is flagged, and the notebook after it still makes its items."""
    report, _ = run
    assert report.failed
    assert set(report.errors) == {"bad", "absent"}
    assert report.states == {
        "test:fig1": "done",
        "test:fig2": "missing",
        "test:fig3": "failed",
        "test:fig4": "failed",
    }


def test_the_report_shows_the_error(run):
    """The page has the last lines of the traceback, as text and not as markup."""
    report, _ = run
    assert "ZeroDivisionError: a <deliberate> failure" in report.errors["bad"]
    page = report.index.read_text(encoding="utf-8")
    assert "ZeroDivisionError: a &lt;deliberate&gt; failure" in page
    assert "deeper()" in page
    assert "\x1b" not in page


def test_progress_names_notebooks_lines_and_failures(run):
    """Lines on stderr are passed on, parameters have arrived, and failures are named."""
    _, messages = run
    assert "bad (1 of 3)" in messages
    assert any("bad failed after" in line and "ZeroDivision" in line for line in messages)
    assert "  good: drawing quick 7" in messages
    assert messages[-1].startswith("report: ")


def test_outputs_lie_in_the_folder(run):
    """Figures as HTML and JSON, tables as CSV, executed notebooks, one plotly.js."""
    out = run[0].out
    assert json.loads((out / "figures" / "test_fig1.json").read_text())["data"][0]["y"] == [3, 5]
    table = pd.read_csv(out / "tables" / "test_fig1.csv", index_col=0)
    assert table["error ours"].tolist()[0] == 0.5
    assert (out / "figures" / "plotly.min.js").stat().st_size > 1e6
    assert (out / "figures" / "test_fig1.html").stat().st_size < 1e5
    assert nbformat.read(out / "notebooks" / "good.ipynb", 4).cells[-1].execution_count
    assert (out / "notebooks" / "bad.ipynb").is_file()


def test_everything_the_report_loads_or_links_is_in_the_folder(run):
    """The page opens from file:// without a network; only citations lead outside."""
    report, _ = run
    page = _Page(report.index)
    for address in [*page.loads, *page.links]:
        if address.startswith("#"):
            assert address[1:] in page.ids
        elif address.startswith("http"):
            assert address in ("http://mocap.cs.cmu.edu", "https://archive.ics.uci.edu")
            assert address not in page.loads
        elif "absent" not in address:
            assert (report.out / address).is_file(), address


def test_the_report_is_well_formed(run):
    """Ids are unique, there is one main heading, and images have a text."""
    page = _Page(run[0].index)
    assert len(page.ids) == len(set(page.ids))
    assert page.tags.count("h1") == 1
    assert page.tags.count("h2") == 1 + 1
    assert page.tags.count("h3") == 4
    assert all(image["alt"] for image in page.images)


def test_the_report_shows_tables_and_reasons(run):
    """Cells are rounded and signed, captions escaped, and what is missing has its reason."""
    text = run[0].index.read_text(encoding="utf-8")
    cells = re.findall(r"<td class=\"[^\"]*\">([^<]*)</td>", text)
    assert cells == ["0.500", "+0.250", "\N{EN DASH}", "\N{MINUS SIGN}1.000"]
    assert "A line &amp; &lt;two&gt; points." in text
    assert "The data for it are missing." in text


def test_a_second_run_forgets_the_failure(run, tmp_path: Path):
    """When the notebook is mended, its item is made and the rest of the folder is kept."""
    folder = tmp_path / "out"
    shutil.copytree(run[0].out, folder)
    _write_notebook(tmp_path / "bad.ipynb", GOOD.replace("fig1", "fig3").replace("fig2", "fig9"))
    again = reproduce_items(
        [FIG3], tmp_path, profile="quick", jobs=1, out=folder, seed=0, progress=lambda _: None
    )
    assert not again.failed
    assert again.states == {"test:fig3": "done"}
    assert item_state(FIG1, folder) == "done"


def test_parts_of_another_run_say_so(run, tmp_path: Path):
    """A run of one item with another profile and seed heads the page, not the older items."""
    folder = tmp_path / "out"
    shutil.copytree(run[0].out, folder)
    _write_notebook(tmp_path / "other.ipynb", GOOD.replace("fig1", "fig5").replace("fig2", "fig6"))
    other = [Item(f"test:fig{n}", "Other", "Nowhere", "other") for n in (5, 6)]
    arguments = {"jobs": 1, "out": folder, "progress": lambda _: None}
    reproduce_items(other, tmp_path, profile="full", seed=8, **arguments)
    write_report(folder, [FIG1, *other])
    page = (folder / "index.html").read_text(encoding="utf-8")
    assert "full profile · seed 8" in page
    sections = re.findall(r"<section .*?</section>", page, re.DOTALL)
    assert ["quick profile, seed 7" in section for section in sections] == [True, False, False]


def test_a_run_of_some_items_that_fails_leaves_the_others(run, tmp_path: Path):
    """Its items have failed; those of the same notebook that were made before have not."""
    folder = tmp_path / "out"
    shutil.copytree(run[0].out, folder)
    _write_notebook(tmp_path / "good.ipynb", BAD)
    report = reproduce_items(
        [FIG2], tmp_path, profile="quick", jobs=1, out=folder, seed=7, progress=lambda _: None
    )
    assert report.states == {"test:fig2": "failed"}
    assert item_state(FIG1, folder) == "done"
    write_report(folder, [FIG1, FIG2])
    sections = re.findall(r"<section .*?</section>", report.index.read_text(), re.DOTALL)
    assert ["ended with an error" in section for section in sections] == [False, True]


PLANNED = [SchemeRun("uci/iris", SpatialScheme("pca", selector="random"), ratio=0.05, seed=7)]
READS = """
from workbench.experiments.grid import run_grid
from workbench.reproduction.outputs import Outputs
from tests.reproduction.test_reproduce import PLANNED

table = run_grid(PLANNED, results, n_jobs=jobs)
Outputs(out).values("test:NAME", {"error": float(table["error"].iloc[0]), "jobs": jobs})
"""


@dataclass(frozen=True)
class _Planning(Notebook):
    """A notebook whose runs are those of this module."""

    def planned_runs(self, profile, seed):
        return PLANNED


def test_a_run_that_two_notebooks_read_is_executed_once(tmp_path: Path, monkeypatch):
    """Runs are computed before the notebooks start, which then read them."""
    items = [Item(f"test:{name}", "Shared", "Nowhere", name) for name in ("one", "two")]
    listed = [_Planning(item.notebook, (item,), runs="here") for item in items]
    monkeypatch.setattr("workbench.reproduction.reproduce.NOTEBOOKS", listed)
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[2]))
    for item in items:
        _write_notebook(tmp_path / f"{item.notebook}.ipynb", READS.replace("NAME", item.notebook))
    messages: list[str] = []
    report = reproduce_items(
        items,
        tmp_path,
        profile="quick",
        jobs=2,
        out=tmp_path / "out",
        seed=7,
        progress=messages.append,
    )
    assert not report.failed
    assert "runs that the notebooks read: 1" in messages
    parts = [part["values"] for part in read_parts(tmp_path / "out")]
    # One process each suffices to read what is there.
    assert parts == [{"error": parts[0]["error"], "jobs": 1}] * 2
    (stored,) = (tmp_path / "out" / "results").glob("*.json")
    first_notebook = tmp_path / "out" / "notebooks" / "one.ipynb"
    assert stored.stat().st_mtime < first_notebook.stat().st_mtime


def test_results_are_read_without_what_computes_them():
    """A notebook whose runs are there does not wait for scikit-learn, which takes seconds."""
    code = (
        "import sys, workbench.experiments.grid\n"
        "from workbench.reproduction.costa2018 import keyframe_errors\n"
        "keyframe_errors.planned_runs('quick', 0)\n"
        "print([name for name in ('sklearn', 'umap') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == "[]"


def test_arguments_are_checked_before_anything_runs(tmp_path: Path):
    """A wrong id, profile, number of jobs or folder is one plain error."""
    with pytest.raises(WorkbenchError, match="profile: got 'fast', want one of quick, full"):
        reproduce(profile="fast", out=tmp_path)
    with pytest.raises(WorkbenchError, match="jobs: got 0"):
        reproduce(jobs=0, out=tmp_path)
    with pytest.raises(WorkbenchError, match="id: got 'fig1'"):
        reproduce(["fig1"], out=tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(WorkbenchError, match="out: cannot write to"):
        reproduce(out=tmp_path / "file" / "folder")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_items_of_an_empty_folder_are_missing(tmp_path: Path):
    """Before anything ran, each item is missing."""
    assert {item_state(item, tmp_path / "nowhere") for item in ITEMS} == {"missing"}


def test_the_kernel_is_this_interpreter(tmp_path: Path, monkeypatch):
    """A kernel "python3" of the user that is another program is not taken."""
    decoy = tmp_path / "kernels" / "python3"
    decoy.mkdir(parents=True)
    (decoy / "kernel.json").write_text(
        json.dumps({"argv": ["false"], "display_name": "decoy", "language": "python"})
    )
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path))
    from jupyter_client.kernelspec import KernelSpecManager

    assert KernelSpecManager().get_kernel_spec("python3").argv == ["false"]
    with this_interpreter():
        assert KernelSpecManager().get_kernel_spec("python3").argv != ["false"]
    assert os.environ["JUPYTER_PATH"] == str(tmp_path)


FIGURE = '{"data": [{"type": "scatter", "x": [1, 2], "y": [1, 2]}], "layout": {"height": 300}}'


def need_chromium() -> None:
    if chromium_path() is None:
        assert os.environ.get("CI") != "true", "no chromium in CI"
        pytest.skip("no chromium on this machine: figures cannot be rendered")


def figures_of_heights(folder: Path, *heights: int) -> list[Path]:
    """Write a figure of each height, named by it."""
    paths = [folder / f"{height}.json" for height in heights]
    for path in paths:
        path.write_text(FIGURE.replace("300", path.stem))
    return paths


def size_of_png(path: Path) -> tuple[int, ...]:
    content = path.read_bytes()
    assert content.startswith(b"\x89PNG")
    return tuple(int.from_bytes(content[at : at + 4], "big") for at in (16, 20))


def test_figures_become_images(tmp_path: Path, monkeypatch):
    """With a browser, the PNG lies beside the figure and has the figure's height."""
    need_chromium()
    monkeypatch.setattr(images, "_WORTH_A_PAGE", 1)  # so that two pages share the work
    figures = figures_of_heights(tmp_path, 300, 400, 520)
    assert write_pngs(figures, jobs=2) == ""
    for figure in figures:
        wanted = (images.SCALE * images.WIDTH, images.SCALE * int(figure.stem))
        assert size_of_png(figure.with_suffix(".png")) == wanted


def test_a_figure_that_cannot_be_rendered_is_named_and_the_others_are(tmp_path: Path):
    """What plotly.js complains about is said, and what comes after it is rendered."""
    need_chromium()
    first, last = figures_of_heights(tmp_path, 300, 400)
    broken = tmp_path / "broken.json"
    broken.write_text("null")
    notice = write_pngs([first, broken, last])
    assert notice.startswith("1 of 3 PNG images are missing: broken: TypeError: ")
    assert not broken.with_suffix(".png").exists()
    assert size_of_png(last.with_suffix(".png")) == (2000, 800)


def test_a_browser_that_ends_on_the_way_is_told(tmp_path: Path):
    """What it rendered is kept, and the notice says in words why the rest is missing."""
    need_chromium()
    figures = figures_of_heights(tmp_path, *range(300, 500))
    with ThreadPoolExecutor(1) as pool:
        notice = pool.submit(write_pngs, figures)
        while not figures[0].with_suffix(".png").exists():
            assert not notice.done()
            time.sleep(0.01)
        browsers = psutil.Process().children(recursive=True)
        for process in browsers:
            if "chromium" in process.name():
                process.kill()
    told = notice.result()
    n_made = sum(figure.with_suffix(".png").exists() for figure in figures)
    assert 0 < n_made < 200
    words = f"{200 - n_made} of 200 PNG images are missing: the browser ended by itself"
    assert told == words


def test_without_a_browser_there_is_a_notice(tmp_path: Path, monkeypatch):
    """No browser is one sentence, not an error, and no image of an earlier figure is left."""
    (tmp_path / "figure.json").write_text(FIGURE)
    (tmp_path / "figure.png").write_bytes(b"of an earlier figure")
    monkeypatch.setenv("PATH", str(Path(sys.executable).parent))
    monkeypatch.setenv("BROWSER_PATH", str(tmp_path / "no-browser"))
    notice = write_pngs([tmp_path / "figure.json"])
    assert re.fullmatch(r"No PNG images: .*(hrom|browser).*", notice)
    assert not (tmp_path / "figure.png").exists()


def test_rendering_has_a_time_limit(tmp_path: Path, monkeypatch):
    """A renderer that hangs is ended with its children, and the notice says so."""
    started: list[subprocess.Popen] = []
    popen = subprocess.Popen

    def hang(_, **options):
        process = popen([sys.executable, "-c", "import time; time.sleep(600)"], **options)
        started.append(process)
        return process

    monkeypatch.setattr(images.subprocess, "Popen", hang)
    notice = write_pngs([tmp_path / "figure.json"], seconds=0.5)
    assert notice == "No PNG images: the browser did not finish within 0.5 s."
    assert started[0].returncode is not None


@pytest.mark.parametrize(
    ("value", "signed", "text"),
    [
        (0.12345, False, "0.123"),
        (0.12345, True, "+0.123"),
        (-2.0, False, "\N{MINUS SIGN}2.000"),
        (3, True, "+3"),
        (1234567.0, False, "1.23e+06"),
        (None, False, "\N{EN DASH}"),
        ("3 of 10", False, "3 of 10"),
        (True, False, "True"),
    ],
)
def test_cells_are_written_for_readers(value, signed, text):
    """Three decimals, a true minus sign, a dash for what is not there."""
    assert format_cell(value, signed=signed) == text
