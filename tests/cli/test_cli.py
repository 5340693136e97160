"""Tests of the command line, as a person or a script uses it."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import nbformat
import pandas as pd
import pytest

from tests.browser.chromium import chromium_path
from tests.conftest import find_clip
from workbench.datasets import load_space
from workbench.experiments import cluster
from workbench.optimization import VISUALIZATION_OPTIMIZER
from workbench.selection.saliency import Saliency

PROJECT_REPORT = {
    "stress",
    "scale_normalized_stress",
    "trustworthiness",
    "continuity",
    "neighborhood_preservation",
    "k",
    "reconstruction_error",
    "relative_reconstruction_error",
    "evaluations",
    "seconds",
}


@pytest.fixture
def table(tmp_path):
    """Give a small CSV file of a user's own."""
    path = tmp_path / "own.csv"
    rows = [f"{i},{i * i % 17},{i % 5},{'ab'[i % 2]}" for i in range(40)]
    path.write_text("first,second,third,kind\n" + "\n".join(rows))
    return path


def test_help_names_what_exists_and_nothing_else(run):
    """Every command has a line; each option lists the methods that there are."""
    status, out, _ = run("--help")
    assert status == 0
    for command in [
        "datasets",
        "project",
        "keyframes",
        "compact",
        "expand",
        "reproduce",
        "lab",
        "app",
    ]:
        assert f"\n  {command} " in out
    _, out, _ = run("project", "--help")
    words = " ".join(out.split())
    for names in ("pca, mds, isomap, lle, tsne, umap, force", "rbfp, lamp", "alg12, local, global"):
        assert names in words
    assert "uniform, random, scs, pb, chord, rols, optimal, saliency" in words
    assert max(map(len, out.splitlines())) <= 80


def test_project_reports_the_documented_values(run):
    """--json prints one object with exactly these names."""
    status, out, err = run("project", "uci/iris", "--projector", "pca", "--json")
    values = json.loads(out)
    assert status == 0
    assert set(values) == PROJECT_REPORT
    assert values["k"] == 10
    assert 0.97 < values["trustworthiness"] < 0.99
    assert 0 < values["relative_reconstruction_error"] < 1
    assert err == ""


def test_optimizing_lowers_the_reported_error(run):
    """--optimize means --optimizer with the default's name, and both help."""
    errors = [
        json.loads(run("project", "uci/wine", "--standardize", "--json", *more)[1])[
            "reconstruction_error"
        ]
        for more in ([], ["--optimize"], ["--optimizer", VISUALIZATION_OPTIMIZER])
    ]
    assert errors[1] < 0.95 * errors[0]
    assert errors[1] == errors[2]


def test_own_tables_work_and_treatments_are_said(run, table, tmp_path):
    """A user's CSV is projected and written with its labels; notes are lines on stderr."""
    out_file = tmp_path / "plane.csv"
    status, out, err = run(
        "project", table, "--label", "kind", "--projector", "tsne", "--out", out_file
    )
    assert status == 0
    assert "trustworthiness" in out
    assert "perplexity=50.0 lowered to 13" in err
    assert all(line.startswith("workbench: note: ") for line in err.splitlines())
    written = pd.read_csv(out_file)
    assert list(written) == ["x", "y", "control_point", "error", "label"]
    assert len(written) == 40
    assert written["control_point"].sum() == 3
    assert set(written["label"]) == {"a", "b"}


def test_treatments_of_own_tables_are_said(run, tmp_path):
    """Rows with missing values are left out, and a line on standard error says how many."""
    path = tmp_path / "gaps.csv"
    path.write_text("a,b\n" + "\n".join(f"{i},{i * i % 7 if i % 6 else ''}" for i in range(30)))
    status, _, err = run("project", path, "--count", 5)
    assert status == 0
    assert err.startswith("workbench: note: ")
    assert "5 of 30 rows" in err


def test_keyframes_and_compact_on_a_bundled_clip(run):
    """Selection and temporal reconstruction of a clip that every installation has."""
    status, out, _ = run("keyframes", "cmu/01_01", "--count", 5, "--json")
    frames = json.loads(out)["frames"]
    assert status == 0
    assert (len(frames), frames[0], frames[-1]) == (5, 0, 2750)
    status, out, _ = run("compact", "cmu/01_01", "--interpolator", "slerp", "--json")
    values = json.loads(out)
    assert status == 0
    assert set(values) == {
        "keyframes",
        "error_per_frame_per_joint",
        "expanded_error_per_frame_per_joint",
        "position_error",
        "position_error_cm",
        "compression_ratio",
        "bytes",
        "bvh_bytes",
        "gzip_bytes",
        "float32_bytes",
        "ratio_to_bvh",
        "ratio_to_gzip",
        "ratio_to_float32",
        "evaluations",
        "seconds",
    }
    assert len(values["keyframes"]) == 82
    assert values["position_error_cm"] == pytest.approx(values["position_error"] * 2.54 / 0.45)
    assert values["compression_ratio"] == pytest.approx(100 / 6.04, rel=0.01)
    assert values["evaluations"] == 0


def test_keyframes_are_drawn_as_one_picture(run, tmp_path):
    """The SVG has a body for each of the frames that are printed, and the PNG is a picture."""
    words = ["keyframes", "cmu/01_01-jump", "--count", 4, "--json", "--thumbnail"]
    status, out, _ = run(*words, tmp_path / "jump.svg")
    frames = json.loads(out)["frames"]
    assert status == 0
    svg = (tmp_path / "jump.svg").read_text()
    assert re.findall(r"<title>frame (\d+)</title>", svg) == [str(frame) for frame in frames]
    if chromium_path() is None:
        assert os.environ.get("CI") != "true", "no chromium in CI"
        pytest.skip("no chromium on this machine: the PNG cannot be drawn")
    assert run(*words, tmp_path / "jump.png")[0] == 0
    assert (tmp_path / "jump.png").read_bytes().startswith(b"\x89PNG")


def test_a_picture_without_a_browser_is_refused_in_one_line(run, tmp_path, monkeypatch):
    """Without a browser the line says which kind of file needs none, and no file is left."""
    monkeypatch.setenv("PATH", str(Path(sys.executable).parent))
    monkeypatch.setenv("BROWSER_PATH", "no-browser")
    words = ["keyframes", "cmu/01_01-jump", "--count", 4, "--thumbnail", tmp_path / "jump.png"]
    status, out, err = run(*words)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert "An .svg file needs no browser" in err
    assert list(tmp_path.iterdir()) == []


def test_saliency_counts_by_its_own_rule(run):
    """Without count and ratio it gives what its clusters give; with one of them, that many."""
    words = ["keyframes", "cmu/01_01-jump", "--selector", "saliency", "--json"]
    own, counted, kept = (
        json.loads(run(*words, *more)[1])["frames"]
        for more in ([], ["--count", 5], ["--keep", 33, "--keep", 34])
    )
    expected = Saliency().select(load_space("cmu/01_01-jump")).tolist()
    assert own == expected
    assert len(own) != int(0.03 * 300)
    assert len(counted) == 5
    assert kept == sorted({*own, 33, 34})


def test_the_second_step_and_dimensions_change_the_map(run, tmp_path):
    """--two-step means rbfp, lamp is another, and with --dimensions 3 there is a z."""
    tables = []
    for words in (
        [],
        ["--two-step"],
        ["--control-point-projector", "rbfp"],
        ["--control-point-projector", "lamp"],
        ["--dimensions", 3],
    ):
        out = tmp_path / "map.csv"
        status, _, err = run("project", "uci/iris", "--count", 20, *words, "--out", out)
        assert status == 0, err
        tables.append(pd.read_csv(out))
    one_step, two_step, rbfp, lamp, space = tables
    assert two_step.equals(rbfp)
    assert not two_step.equals(lamp)
    assert not two_step.equals(one_step)
    assert list(space)[:3] == ["x", "y", "z"]


def test_the_main_result_of_the_thesis(run):
    """On 05_10 at 3 % optimized t-SNE reaches 0.34 ± 0.02 where slerp reaches 0.41 ± 0.01."""
    find_clip("05_10")
    common = ["compact", "cmu/05_10", "--selector", "uniform", "--ratio", 0.03, "--json"]
    spatial = json.loads(run(*common, "--projector", "tsne", "--optimize")[1])
    temporal = json.loads(run(*common, "--interpolator", "slerp")[1])
    assert spatial["error_per_frame_per_joint"] == pytest.approx(0.34, abs=0.02)
    assert temporal["error_per_frame_per_joint"] == pytest.approx(0.41, abs=0.01)
    assert spatial["evaluations"] > 817


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["project"], "Missing argument"),
        (["nonsense"], "No such command 'nonsense'"),
        (["project", "uci/iriss"], "did you mean uci/iris"),
        (["project", "nowhere.csv"], "nowhere.csv"),
        (["project", "uci/iris", "--projector", "foo"], "projector: got 'foo', want one of pca"),
        (["project", "uci/iris", "--optimizer", "foo"], "optimizer: got 'foo'"),
        (["project", "uci/iris", "--control-points", "foo"], "selector: got 'foo'"),
        (["project", "uci/iris", "--back-projector", "foo"], "back-projector: got 'foo'"),
        (
            ["project", "uci/iris", "--back-projector", "spatial-keyframes"],
            "which rebuilds poses",
        ),
        (["project", "uci/iris", "--ratio", "2"], "ratio: got 2.0"),
        (["project", "uci/iris", "--count", "150"], "want from 2 to 149"),
        (["project", "uci/iris", "--count", "5", "--ratio", "0.1"], "got both"),
        (["project", "uci/iris", "--seed", "x"], "--seed"),
        (["project", "uci/iris", "--seed", "-1"], "--seed"),
        (["project", "uci/iris", "--out", "plane.txt"], ".csv or .parquet"),
        (["project", "uci/iris", "--out", "/no/such/folder/plane.csv"], "there is no folder"),
        (["compact", "uci/iris", "--projector", "pca"], "got a table, want a motion"),
        (["compact", "cmu/01_01"], "exactly one of --interpolator and --projector"),
        (
            ["compact", "cmu/01_01", "--interpolator", "slerp", "--optimize"],
            "want it with --projector",
        ),
        (
            ["compact", "cmu/01_01", "--interpolator", "slerp", "--two-step"],
            "--two-step: got it with --interpolator",
        ),
        (
            ["compact", "cmu/01_01", "--interpolator", "slerp", "--dimensions", "3"],
            "--dimensions: got it with --interpolator",
        ),
        (["compact", "cmu/01_01", "--projector", "pca", "--tolerance", "nan"], "--tolerance"),
        (["project", "uci/iris", "--dimensions", "4"], "--dimensions: got 4, want 2 or 3"),
        (["project", "uci/iris", "--control-point-projector", "x"], "want one of rbfp, lamp"),
        (["project", "uci/iris", "--control-points", "scs"], "rows of a table have no order"),
        (["project", "uci/iris", "--control-points", "saliency"], "want a motion"),
        (["project", "uci/iris", "--two-step", "--back-projector", "inverse"], "in two steps"),
        (
            ["project", "uci/iris", "--projector", "mds", "--back-projector", "inverse"],
            "pca or umap",
        ),
        (["project", "uci/iris", "--keep", "150"], "--keep: got 150…150, want indices from 0"),
        (["project", "uci/iris", "--markers", "x"], "want one of move, exchange"),
        (["project", "uci/iris", "--markers", "exchange", "--keep", "1"], "--markers exchange"),
        (["keyframes", "cmu/01_01", "--keep", "1", "--keep", "1"], "--keep: got 1, 1, want"),
        (["keyframes", "cmu/01_01", "--keep", "-1"], "--keep: got -1, want numbers from 0"),
        (
            ["keyframes", "cmu/01_01", "--count", "2", "--keep", "1", "--keep", "2", "--keep", "3"],
            "--keep: got 3 that must stay, want at most the 2",
        ),
        (["keyframes", "cmu/01_01", "--count", "1"], "--count: got 1, want at least 2"),
        (["keyframes", "uci/iris"], "want a motion"),
        (["keyframes", "cmu/01_01", "--thumbnail", "x.gif"], "want a name ending in .svg or .png"),
        (
            ["keyframes", "cmu/01_01", "--thumbnail", "none/x.svg"],
            "--thumbnail: there is no folder",
        ),
        (["datasets", "check", "uci/none"], "uci/none"),
        (["reproduce", "costa2018:fig9.9"], "costa2018:fig9.9"),
        (["reproduce", "--profile", "huge"], "huge"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_wrong_input_is_one_line_and_status_2(run, words, message):
    """The line on standard error says what is wrong; standard output stays empty."""
    status, out, err = run(*words)
    assert status == 2
    assert out == ""
    assert err.startswith("workbench: error: ")
    assert err.count("\n") == 1
    assert message in err


def test_damaged_motion_files_are_located(run, tmp_path):
    """A broken BVH file gives file, line, what was found and what was expected."""
    broken = tmp_path / "broken.bvh"
    broken.write_text("HIERARCHY\nROOT hips\n{\n OFFSET 0 0 zero\n")
    status, _, err = run("keyframes", broken)
    assert status == 2
    assert "broken.bvh, line 4: found" in err
    assert "expected" in err


def test_data_sets_are_listed_and_checked(run):
    """The catalogue lists every bundled set, and their content is what it should be."""
    status, out, _ = run("datasets", "list", "--json")
    names = [entry["name"] for entry in json.loads(out)["datasets"]]
    assert status == 0
    bundled = ["uci/iris", "uci/wine", "uci/yeast", "uci/ionosphere", "cmu/01_01", "cmu/01_03"]
    assert set(bundled) <= set(names)
    status, out, _ = run("datasets", "check", *bundled)
    assert status == 0
    assert out.splitlines() == [f"{name}: good" for name in bundled]


def test_figures_are_listed(run, tmp_path):
    """Listing by reproduce --list --json gives an id, a notebook and a state for each."""
    status, out, _ = run("reproduce", "--list", "--json", "--out", tmp_path)
    items = json.loads(out)["items"]
    assert status == 0
    assert {"costa2018:fig5.3", "costa2018:tab5.1"} <= {item["id"] for item in items}
    assert all(set(item) == {"id", "notebook", "state"} for item in items)


def test_a_failing_notebook_fails_the_command(run, tmp_path, monkeypatch):
    """The report is written, --json stays one object, and the status is 2."""
    notebooks = tmp_path / "notebooks"
    notebooks.mkdir()
    cell = nbformat.v4.new_code_cell("raise RuntimeError('out of luck')")
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    notebook = nbformat.v4.new_notebook(cells=[cell], metadata=kernel)
    nbformat.write(notebook, notebooks / "costa2018_table_5_1.ipynb")
    monkeypatch.setattr("workbench.reproduction.reproduce.bundled", lambda _: notebooks)
    out_folder = tmp_path / "report"
    status, out, err = run("reproduce", "costa2018:tab5.1", "--json", "--out", out_folder)
    assert status == 2
    assert [item["state"] for item in json.loads(out)["items"]] == ["failed"]
    assert err.splitlines()[-1].startswith("workbench: error: failed: costa2018_table_5_1")
    assert "out of luck" in (out_folder / "index.html").read_text()


@pytest.mark.parametrize("item", ["costa2018:fig5.2", "costa2018:fig5.3"])
def test_a_scheduler_that_does_not_answer_fails_the_command(run, tmp_path, monkeypatch, item):
    """Asked for a whole notebook or for one of its items, the runs go to the scheduler."""
    monkeypatch.setattr(cluster, "_PATIENCE", 1.0)
    out = tmp_path / "report"
    status, _, err = run("reproduce", item, "--scheduler", "tcp://127.0.0.1:9", "--out", out)
    assert status == 2
    page = out / "index.html"
    said = err + (page.read_text(encoding="utf-8") if page.exists() else "")
    assert re.search("no Dask scheduler answers at .*tcp://127.0.0.1:9", said)
    assert not list((out / "results").glob("*.json"))


def test_heavy_packages_are_not_imported_for_help():
    """umap, plotly, numba, scipy and jupyter are imported when they are used."""
    code = (
        "import sys, workbench.cli\n"
        "heavy = 'umap plotly numba scipy sklearn pandas pyarrow IPython papermill rich'.split()\n"
        "print([name for name in heavy if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == "[]"


def test_wrong_names_are_refused_before_anything_heavy_is_loaded():
    """Every option that takes a name checks it first."""
    code = (
        "import sys, workbench.cli\n"
        "clip = ['cmu/01_01', '--projector', 'pca']\n"
        "wrong = [['project', 'uci/iris', option, 'x'] for option in\n"
        "    ('--projector', '--control-points', '--control-point-projector', '--optimizer',\n"
        "     '--back-projector')]\n"
        "wrong += [['compact', *clip, option, 'x'] for option in\n"
        "    ('--selector', '--control-point-projector', '--optimizer')]\n"
        "wrong += [['compact', 'cmu/01_01', '--interpolator', 'x'],\n"
        "    ['keyframes', 'cmu/01_01', '--selector', 'x']]\n"
        "for words in wrong:\n"
        "    sys.argv = ['workbench', *words]\n"
        "    try:\n"
        "        workbench.cli.main()\n"
        "    except SystemExit as ending:\n"
        "        print(ending.code, end=' ')\n"
        "heavy = 'umap numba scipy sklearn pandas'.split()\n"
        "print([name for name in heavy if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == "2 " * 10 + "[]"
    assert done.stderr.count("want one of") == 10


def test_compiling_is_said_once_and_only_when_it_happens(tmp_path):
    """A first call with an empty kernel cache says so on stderr; the next one is silent."""
    words = [sys.executable, "-m", "workbench", "datasets", "check", "cmu/01_01", "--json"]
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    first, second = (
        subprocess.run(words, check=True, capture_output=True, text=True, env=environment)
        for _ in range(2)
    )
    assert first.stderr.count("compiling") == 1
    assert second.stderr == ""
    assert json.loads(first.stdout) == json.loads(second.stdout)


def test_unread_output_ends_quietly():
    """Piping into a reader that stops early gives no traceback."""
    reading, writing = os.pipe()
    os.close(reading)
    words = [sys.executable, "-m", "workbench", "datasets", "list"]
    done = subprocess.run(words, stdout=writing, stderr=subprocess.PIPE, text=True)
    os.close(writing)
    assert done.returncode == 1
    assert done.stderr == ""
