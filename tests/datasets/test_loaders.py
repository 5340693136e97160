"""Loading by name and by path, and one's own data by name."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from workbench.datasets import load, load_space, loaders, register_dataset
from workbench.datasets.search import cache_folder, find, search_folders
from workbench.datasets.tables import Table
from workbench.errors import DataError, MotionFormatError, WorkbenchError
from workbench.mocap.motion import Motion
from workbench.resources import bundled
from workbench.spaces import PoseSpace, VectorSpace

BVH = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
  End Site
  {
    OFFSET 0 1 0
  }
}
MOTION
Frames: 4
Frame Time: 0.1
0 0 0 0 0 0
0 0 0 90 0 0
0 0 0 91 0 0
0 0 0 92 0 0
"""

ASF = """:version 1.10
:units
  length 0.45
  angle deg
:root
  order TX TY TZ RX RY RZ
  axis XYZ
  position 0 0 0
  orientation 0 0 0
:bonedata
  begin
    id 1
    name leg
    direction 0 -1 0
    length 3
    axis 0 0 0 XYZ
  end
:hierarchy
  begin
    root leg
  end
"""
AMC = ":DEGREES\n1\nroot 1 2 3 10 20 30\n2\nroot 1 2 4 11 21 31\n3\nroot 1 2 5 12 22 33\n"


@pytest.fixture
def _own_names(monkeypatch: pytest.MonkeyPatch) -> None:
    """Forget the data sets that a test registers."""
    monkeypatch.setattr(loaders._registered, "_entries", {})


class TestSearch:
    """The order of the data folders."""

    def test_folders_of_the_user_come_first(
        self, tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """Earlier folders of WORKBENCH_DATA win, then the bundled data, then the cache."""
        first, second = tmp_path / "first", tmp_path / "second"
        monkeypatch.setenv("WORKBENCH_DATA", os.pathsep.join([str(first), str(second)]))
        assert list(search_folders()) == [first, second, bundled("datasets"), cache]
        for folder in (cache, bundled("datasets"), second, first):
            if folder != bundled("datasets"):
                (folder / "uci").mkdir(parents=True)
                (folder / "uci" / "yeast.data").write_text("x")
            expected = bundled("datasets") if folder == cache else folder
            assert find(["uci/yeast.data"]) == expected / "uci" / "yeast.data"

    def test_a_file_may_lie_in_the_folder_itself(
        self, tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """A file put straight into a named folder is found, after one in its proper place."""
        monkeypatch.setenv("WORKBENCH_DATA", str(tmp_path))
        (tmp_path / "seeds.data").write_text("x")
        assert find(["uci/seeds.data"]) == tmp_path / "seeds.data"
        (tmp_path / "uci").mkdir()
        (tmp_path / "uci" / "seeds.data").write_text("x")
        assert find(["uci/seeds.data"]) == tmp_path / "uci" / "seeds.data"

    def test_the_cache_has_a_place_without_the_variable(
        self, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """Without WORKBENCH_CACHE the system's cache folder is used."""
        monkeypatch.delenv("WORKBENCH_CACHE", raising=False)
        assert cache_folder().name == "workbench"

    def test_a_folder_that_does_not_exist_is_named(
        self, cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """A misspelt folder in WORKBENCH_DATA shows in the message about missing data."""
        monkeypatch.setenv("WORKBENCH_DATA", str(tmp_path / "misspelt"))
        with pytest.raises(DataError, match="misspelt, which does not exist"):
            loaders.check("uci/seeds")


class TestPaths:
    """A user's own files."""

    def test_table(self, tmp_path: Path) -> None:
        """A path to a table works as text and as a path, with a label column."""
        path = tmp_path / "mine.csv"
        path.write_text("a,b,kind\n1,2,x\n3,4,y\n5,7,x\n")
        for source in (path, str(path)):
            table = load(source, label="kind")
            assert isinstance(table, Table)
            assert table.class_counts == {"x": 2, "y": 1}

    def test_motion_is_left_as_it_is(self, tmp_path: Path) -> None:
        """A user's BVH keeps its first frame and has no known scale."""
        path = tmp_path / "wave.BVH"
        path.write_text(BVH)
        motion = load(path)
        assert isinstance(motion, Motion)
        assert (len(motion), motion.name, motion.skeleton.unit_cm) == (4, "wave", None)

    def test_broken_motion_names_its_line(self, tmp_path: Path) -> None:
        """A broken BVH is refused by the reader, with the line."""
        path = tmp_path / "wave.bvh"
        path.write_text(BVH.replace("90", "nan"))
        with pytest.raises(MotionFormatError, match="line 15"):
            load(path)

    @pytest.mark.parametrize(
        ("skeletons", "clip", "kind"),
        [
            pytest.param([], "13_29", Table, id="none"),
            pytest.param(["05"], "13_29", Table, id="another subject's alone"),
            pytest.param(["13"], "13_29", Motion, id="the subject's"),
            pytest.param(["05", "13_29"], "13_29", Motion, id="the trial's among others"),
            pytest.param(["05"], "walk", Motion, id="the only one of a clip that is no trial"),
            pytest.param(["05", "13"], "walk", Table, id="two for a clip that is no trial"),
        ],
    )
    def test_amc_with_a_fitting_skeleton_is_a_motion(
        self, skeletons: list[str], clip: str, kind: type, tmp_path: Path
    ) -> None:
        """Beside the skeletons of other subjects an AMC is the table of its joint angles."""
        for name in skeletons:
            (tmp_path / f"{name}.asf").write_text(ASF)
        (tmp_path / f"{clip}.amc").write_text(AMC)
        data = load(tmp_path / f"{clip}.amc")
        assert type(data) is kind
        if isinstance(data, Table):
            np.testing.assert_array_equal(data.values, [[10, 20, 30], [11, 21, 31], [12, 22, 33]])
            assert "no skeleton" in data.notes[0]
        else:
            assert (data.name, len(data)) == (clip, 3)

    def test_amc_takes_the_skeleton_beside_it(self, shared_data: Path) -> None:
        """An AMC with its ASF beside it is a motion, one without a table of angles."""
        folder = shared_data / "mocap" / "asf_amc"
        assert isinstance(load(folder / "05_10.amc"), Motion)
        assert isinstance(load(folder / "13_29.amc"), Table)

    @pytest.mark.parametrize(
        ("name", "message"),
        [
            pytest.param("absent.csv", "there is no such file", id="table"),
            pytest.param("absent.bvh", "there is no such file", id="motion"),
            pytest.param("absent.amc", "there is no such file", id="AMC"),
            pytest.param("only.asf", "skeleton without", id="skeleton"),
            pytest.param("folder", "is a folder", id="folder"),
            pytest.param("folder.bvh", "is a folder", id="folder like a motion"),
        ],
    )
    def test_what_is_no_data_file_is_refused(self, name: str, message: str, tmp_path: Path) -> None:
        """A path that cannot be loaded is refused in words."""
        (tmp_path / "folder").mkdir()
        (tmp_path / "folder.bvh").mkdir()
        (tmp_path / "only.asf").write_text(":version 1.10\n")
        with pytest.raises(DataError, match=message):
            load(str(tmp_path / name))

    @pytest.mark.parametrize("source", [3, None, 2.5, ["uci/iris"]], ids=repr)
    def test_what_is_no_path_is_refused(self, source: object) -> None:
        """Neither a name nor a path is a DataError, not a TypeError."""
        with pytest.raises(DataError, match="want a name or a path"):
            load(source)  # type: ignore[arg-type]  # on purpose


class TestNames:
    """Names that do not exist."""

    @pytest.mark.parametrize(
        ("name", "guess"),
        [
            ("uci/irs", "uci/iris"),
            ("iris", "uci/iris"),
            ("UCI/Wine", "uci/wine"),
            ("05_10", "cmu/05_10"),
            ("cmu/01_01-jmp", "cmu/01_01-jump"),
        ],
    )
    def test_close_names_are_offered(self, name: str, guess: str) -> None:
        """A misspelt name is refused with the one that was meant."""
        with pytest.raises(DataError, match=f"did you mean.*{guess}"):
            load(name)

    @pytest.mark.parametrize("name", ["", "zzzzzz", "x" * 5000, "~nobody-here/x", "a\0b"])
    def test_strange_names_are_refused_in_one_line(self, name: str) -> None:
        """Whatever the text, it is refused in one line that says how to see all names."""
        with pytest.raises(DataError, match="workbench datasets list") as error:
            load(name)
        assert "\n" not in str(error.value)

    def test_a_label_is_for_own_tables(self) -> None:
        """A data set of the catalogue has its own labels."""
        with pytest.raises(DataError, match="table of your own only"):
            load("uci/iris", label="class")

    @pytest.mark.usefixtures("_own_names")
    @pytest.mark.parametrize("action", [loaders.check, loaders.fetch], ids=["check", "fetch"])
    def test_check_and_fetch_want_a_name_of_the_catalogue(
        self, action: Callable[[str], loaders.Status], tmp_path: Path
    ) -> None:
        """Only the catalogue knows what to check or where to fetch: a file or own name is none."""
        assert action("uci/yeast").entry.name == "uci/yeast"
        with pytest.raises(DataError, match="did you mean uci/seeds"):
            action("uci/seed")
        (tmp_path / "mine").write_text("a,b\n1,2\n3,4\n5,6\n")
        register_dataset("mine/cube", lambda: np.eye(3))
        for source in (str(tmp_path / "mine"), "mine/cube"):
            assert len(load_space(source)) == 3
            with pytest.raises(DataError, match="no data set or file is called"):
                action(source)


@pytest.mark.usefixtures("_own_names")
class TestRegistered:
    """One's own data by name."""

    @pytest.mark.parametrize(
        "data",
        [
            pytest.param([[1, 2], [3, 4], [5, 7]], id="lists"),
            pytest.param(np.array([[1, 2], [3, 4], [5, 7]]), id="array"),
            pytest.param(pd.DataFrame({"a": [1, 3, 5], "b": [2, 4, 7]}), id="data frame"),
            pytest.param(Table("", np.array([[1, 2], [3, 4], [5, 7.0]]), ("a", "b")), id="table"),
        ],
    )
    def test_loader_may_give_any_table(self, data: object) -> None:
        """Arrays, data frames and tables become a table of the registered name."""
        register_dataset("mine", lambda: data)
        table = load("mine")
        assert isinstance(table, Table)
        assert table.name == "mine"
        np.testing.assert_array_equal(table.values, [[1, 2], [3, 4], [5, 7]])

    def test_loader_may_give_a_motion(self, waving: Motion) -> None:
        """A motion becomes a space of poses."""
        register_dataset("mine/wave", lambda: waving)
        assert isinstance(load_space("mine/wave"), PoseSpace)

    def test_own_names_win_and_are_offered(self) -> None:
        """A registered name hides the catalogue's, and is offered for misspelt ones."""
        register_dataset("uci/iris", lambda: np.eye(3))
        assert len(load_space("uci/iris")) == 3
        register_dataset("lab/fish", lambda: np.eye(3))
        with pytest.raises(DataError, match="did you mean lab/fish"):
            load("lab/fsh")

    @pytest.mark.parametrize("data", [None, 3, object()], ids=["None", "number", "object"])
    def test_other_results_are_refused(self, data: object) -> None:
        """What a loader gives is checked."""
        register_dataset("mine", lambda: data)
        with pytest.raises(DataError, match="mine"):
            load("mine")

    def test_what_cannot_be_called_is_refused(self) -> None:
        """A table instead of a loader is refused at once."""
        with pytest.raises(WorkbenchError, match="want a class or function"):
            register_dataset("mine", np.eye(3))  # type: ignore[arg-type]  # on purpose


def test_spaces_of_tables_and_motions() -> None:
    """Tables give a VectorSpace, standardised on request; motions a PoseSpace, never."""
    raw, standardized = load_space("uci/iris"), load_space("uci/iris", standardize=True)
    assert isinstance(raw, VectorSpace)
    assert isinstance(standardized, VectorSpace)
    assert raw.labels is not None
    assert raw.samples.std(axis=0).min() < 0.5
    np.testing.assert_allclose(standardized.samples.std(axis=0), 1)
    with pytest.raises(DataError, match="only tables can be standardised"):
        load_space("cmu/01_01-jump", standardize=True)


def test_import_is_light() -> None:
    """Importing the package loads none of the heavy libraries, nor numba's kernels."""
    program = (
        "import sys, workbench.datasets\n"
        "heavy = {'pandas', 'sklearn', 'pooch', 'scipy', 'numba', 'requests', 'pyarrow'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    environment = {**os.environ, "PYTHONPATH": str(Path(loaders.__file__).parents[2])}
    result = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, env=environment, check=True
    )
    assert result.stdout.strip() == "[]"
