"""The catalogue: the data sets that the workbench knows by name."""

from __future__ import annotations

import re
from functools import cache

from workbench.datasets import formats
from workbench.datasets.clips import CLIPS, EXCERPTS, RELEASED
from workbench.datasets.entries import (
    AcclaimEntry,
    ClipEntry,
    Download,
    Entry,
    ExcerptEntry,
    Source,
    TableEntry,
)
from workbench.datasets.formats import Rows

_UCI = "https://archive.ics.uci.edu"
_UCI_FILES = f"{_UCI}/ml/machine-learning-databases"
_UCI_LICENCE = "CC BY 4.0"
_CMU = "http://mocap.cs.cmu.edu"
_CMU_MIRROR = "https://raw.githubusercontent.com/una-dinosauria/cmu-mocap/master/data"
_CMU_LICENCE = (
    "free for research and commercial projects, not to be resold as data; "
    "BVH conversion by B. Hahne (cgspeed) without further restrictions"
)
_CMU_CITATION = (
    "The data used in this project was obtained from mocap.cs.cmu.edu. "
    "The database was created with funding from NSF EIA-0196217."
)
_CLIP = re.compile(r"(cmu|cmu-amc)/((\d{2,3})_\d{2})")


def _iris() -> Rows:
    from sklearn.datasets import load_iris

    data = load_iris()
    return Rows(data.data, tuple(str(code) for code in data.target))


def _wine() -> Rows:
    from sklearn.datasets import load_wine

    data = load_wine()
    return Rows(data.data, tuple(str(code) for code in data.target))


TABLES: tuple[TableEntry, ...] = (
    # This is Fisher's table as scikit-learn and R have it. UCI's own copy differs in two rows,
    # the 35th (petal width 0.1 instead of 0.2) and the 38th (sepal width 3.1 instead of 3.6,
    # petal length 1.5 instead of 1.4).
    TableEntry(
        name="uci/iris",
        title="Flowers of three species of iris, Fisher's measurements",
        files=("uci/iris.csv",),
        page=f"{_UCI}/dataset/53/iris",
        licence=_UCI_LICENCE,
        citation="Fisher, R. (1936). Iris. UCI Machine Learning Repository. doi:10.24432/C56C76",
        reader=formats.read_counted,
        columns=("sepal length (cm)", "sepal width (cm)", "petal length (cm)", "petal width (cm)"),
        classes={"0": "setosa", "1": "versicolor", "2": "virginica"},
        shape=(150, 4),
        class_counts={"setosa": 50, "versicolor": 50, "virginica": 50},
        checksum="2856c2d9e18ed51c8e5001ede7973ff8726c66bdd92fc3a68947fbd815be15d9",
        built_in=_iris,
    ),
    TableEntry(
        name="uci/wine",
        title="Chemical analysis of wines from three cultivars",
        files=("uci/wine_data.csv",),
        page=f"{_UCI}/dataset/109/wine",
        licence=_UCI_LICENCE,
        citation="Aeberhard, S. & Forina, M. (1992). Wine. UCI Machine Learning Repository. "
        "doi:10.24432/C5PC7J",
        reader=formats.read_counted,
        columns=(
            "alcohol",
            "malic acid",
            "ash",
            "alcalinity of ash",
            "magnesium",
            "total phenols",
            "flavanoids",
            "nonflavanoid phenols",
            "proanthocyanins",
            "color intensity",
            "hue",
            "OD280/OD315 of diluted wines",
            "proline",
        ),
        classes={"0": "cultivar 1", "1": "cultivar 2", "2": "cultivar 3"},
        shape=(178, 13),
        class_counts={"cultivar 1": 59, "cultivar 2": 71, "cultivar 3": 48},
        checksum="e882c7a70f5f76dad180659d02232ff36a7d318be30969aad72c90ba9c94c42c",
        built_in=_wine,
    ),
    TableEntry(
        name="uci/seeds",
        title="Geometry of wheat kernels of three varieties",
        files=("uci/seeds.data", "uci/seeds_dataset.txt"),
        page=f"{_UCI}/dataset/236/seeds",
        licence=_UCI_LICENCE,
        citation="Charytanowicz, M., Niewczas, J., Kulczycki, P., Kowalski, P. & Lukasik, S. "
        "(2010). Seeds. UCI Machine Learning Repository. doi:10.24432/C5H30K",
        downloads=(
            Download(
                "uci/seeds.data",
                (
                    Source(f"{_UCI_FILES}/00236/seeds_dataset.txt"),
                    Source(f"{_UCI}/static/public/236/seeds.zip", "seeds_dataset.txt"),
                ),
            ),
        ),
        reader=formats.read_labelled,
        columns=(
            "area",
            "perimeter",
            "compactness",
            "kernel length",
            "kernel width",
            "asymmetry coefficient",
            "kernel groove length",
        ),
        classes={"1": "Kama", "2": "Rosa", "3": "Canadian"},
        shape=(210, 7),
        class_counts={"Canadian": 70, "Kama": 70, "Rosa": 70},
        checksum="ef8b907aa5c3685700f131b94897c8ae2ab9f8e454f645baa5dde6af99f6638f",
    ),
    TableEntry(
        name="uci/yeast",
        title="Localisation sites of yeast proteins",
        files=("uci/yeast.data",),
        page=f"{_UCI}/dataset/110/yeast",
        licence=_UCI_LICENCE,
        citation="Nakai, K. (1991). Yeast. UCI Machine Learning Repository. doi:10.24432/C5KG68",
        downloads=(Download("uci/yeast.data", (Source(f"{_UCI_FILES}/yeast/yeast.data"),)),),
        reader=formats.read_named,
        columns=("mcg", "gvh", "alm", "mit", "erl", "pox", "vac", "nuc"),
        shape=(1484, 8),
        class_counts={
            "CYT": 463,
            "ERL": 5,
            "EXC": 35,
            "ME1": 44,
            "ME2": 51,
            "ME3": 163,
            "MIT": 244,
            "NUC": 429,
            "POX": 20,
            "VAC": 30,
        },
        checksum="0488cfcf432832f4e8646253509b03d4c1d8166b9f8323303a32e4878b9d952d",
    ),
    TableEntry(
        name="uci/ionosphere",
        title="Radar returns from the ionosphere, good and bad",
        files=("uci/ionosphere_weka.arff", "uci/ionosphere.arff"),
        page=f"{_UCI}/dataset/52/ionosphere",
        licence=_UCI_LICENCE,
        citation="Sigillito, V., Wing, S., Hutton, L. & Baker, K. (1989). Ionosphere. "
        "UCI Machine Learning Repository. doi:10.24432/C5W01B",
        reader=formats.read_arff_rows,
        columns=tuple(
            f"pulse {pulse} {part}" for pulse in range(1, 18) for part in ("real", "imaginary")
        ),
        classes={"g": "good", "b": "bad"},
        shape=(351, 34),
        class_counts={"bad": 126, "good": 225},
        checksum="fc1ed7ca193ab694990b62e35706989d177bbec3c07e724061f7b31d0ba66631",
    ),
    # The repository's description contradicts itself on classes 3 and 5: its text calls them
    # picture and graphic, its counts the other way round. The text gives the codes.
    TableEntry(
        name="uci/page-blocks",
        title="Blocks of the layout of scanned pages",
        files=("uci/page-blocks.csv", "uci/page-blocks.data"),
        page=f"{_UCI}/dataset/78/page+blocks+classification",
        licence=_UCI_LICENCE,
        citation="Malerba, D. (1995). Page Blocks Classification. "
        "UCI Machine Learning Repository. doi:10.24432/C5J590",
        downloads=(
            Download(
                "uci/page-blocks.data",
                (
                    Source(f"{_UCI_FILES}/page-blocks/page-blocks.data.Z"),
                    Source(
                        f"{_UCI}/static/public/78/page+blocks+classification.zip",
                        "page-blocks.data.Z",
                    ),
                ),
            ),
        ),
        reader=formats.read_labelled,
        columns=(
            "height",
            "length",
            "area",
            "eccentricity",
            "black",
            "black after smoothing",
            "mean transitions",
            "black pixels",
            "black pixels after smoothing",
            "transitions",
        ),
        classes={
            "1": "text",
            "2": "horizontal line",
            "3": "picture",
            "4": "vertical line",
            "5": "graphic",
        },
        shape=(5473, 10),
        class_counts={
            "graphic": 115,
            "horizontal line": 329,
            "picture": 28,
            "text": 4913,
            "vertical line": 88,
        },
        checksum="d7dc474509179271d838d269b25c907dce39c933d641a046d6d8d9d967f9dc58",
    ),
    TableEntry(
        name="uci/cloud",
        title="Clouds in visible and infrared satellite images",
        files=("uci/cloud.data",),
        page=f"{_UCI}/dataset/155/cloud",
        licence=_UCI_LICENCE,
        citation="Collard, P. (1989). Cloud. UCI Machine Learning Repository.",
        downloads=(
            Download("uci/cloud.data", (Source(f"{_UCI_FILES}/undocumented/taylor/cloud.data"),)),
        ),
        reader=formats.read_cloud,
        columns=(
            "visible mean",
            "visible maximum",
            "visible minimum",
            "visible mean distribution",
            "visible contrast",
            "visible entropy",
            "visible second angular momentum",
            "infrared mean",
            "infrared maximum",
            "infrared minimum",
        ),
        shape=(1024, 10),
        checksum="1afb33999087bf200b09a7ad076f9a7da5314a982cf1cfca1fbd2fb59f70224e",
    ),
)


def clip_entry(trial: str) -> ClipEntry:
    """Make the entry of a CMU clip as BVH.

    Parameters
    ----------
    trial : str
        Subject and trial, such as ``"05_10"``; any of the database.

    Returns
    -------
    ClipEntry
    """
    frames, action = CLIPS.get(trial, (None, "motion capture clip"))
    subject = trial.partition("_")[0]
    place = f"mocap/bvh/{trial}.bvh"
    return ClipEntry(
        name=f"cmu/{trial}",
        title=action,
        files=(place,),
        page=_CMU,
        licence=_CMU_LICENCE,
        citation=_CMU_CITATION,
        downloads=(Download(place, (Source(f"{_CMU_MIRROR}/{subject:0>3}/{trial}.bvh"),)),),
        frames=frames,
        checksum=RELEASED.get(trial, ""),
    )


def acclaim_entry(trial: str) -> AcclaimEntry:
    """Make the entry of a CMU clip in the original ASF/AMC form.

    Parameters
    ----------
    trial : str
        Subject and trial, such as ``"13_29"``; any of the database.

    Returns
    -------
    AcclaimEntry
    """
    frames, action = CLIPS.get(trial, (None, "motion capture clip"))
    subject = trial.partition("_")[0]
    folder, address = "mocap/asf_amc", f"{_CMU}/subjects/{subject}"
    return AcclaimEntry(
        name=f"cmu-amc/{trial}",
        title=action,
        files=(f"{folder}/{trial}.amc",),
        page=_CMU,
        licence=_CMU_LICENCE,
        citation=_CMU_CITATION,
        downloads=(
            Download(f"{folder}/{subject}.asf", (Source(f"{address}/{subject}.asf"),)),
            Download(f"{folder}/{trial}.amc", (Source(f"{address}/{trial}.amc"),)),
        ),
        skeleton=f"{folder}/{subject}.asf",
        frames=frames,
    )


def _excerpt(name: str, start: int, stop: int, action: str) -> ExcerptEntry:
    clip = clip_entry(name.partition("-")[0])
    return ExcerptEntry(
        name=f"cmu/{name}",
        title=action,
        files=clip.files,
        page=clip.page,
        licence=clip.licence,
        citation=clip.citation,
        downloads=clip.downloads,
        clip=clip,
        start=start,
        stop=stop,
    )


@cache
def entries() -> dict[str, Entry]:
    """List the data sets that are described one by one, by name."""
    listed: list[Entry] = [
        *TABLES,
        *(clip_entry(trial) for trial in CLIPS),
        *(_excerpt(*excerpt) for excerpt in EXCERPTS),
    ]
    return {entry.name: entry for entry in listed}


def lookup(name: str) -> Entry | None:
    """Find the entry of that name; any trial of the CMU database has one.

    Parameters
    ----------
    name : str
        Such as ``"uci/iris"``, ``"cmu/05_10"``, ``"cmu-amc/13_29"``, ``"cmu/01_03-swing"``.

    Returns
    -------
    Entry or None
    """
    if name in entries():
        return entries()[name]
    match = _CLIP.fullmatch(name)
    if match is None:
        return None
    return clip_entry(match[2]) if match[1] == "cmu" else acclaim_entry(match[2])
