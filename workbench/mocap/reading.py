"""Read a motion whatever its file format."""

from __future__ import annotations

import re
from pathlib import Path

from workbench.errors import DataError
from workbench.mocap.amc import read_asf_amc
from workbench.mocap.bvh import read_bvh
from workbench.mocap.motion import Motion

_TRIAL = re.compile(r"\d+_\d+")


def read_motion(path: str | Path) -> Motion:
    """Read a motion file, telling its format by its ending.

    An AMC file needs its skeleton beside it: ``05_09.asf`` or ``05.asf`` for ``05_09.amc``,
    or the only ASF file in the folder. The name of a trial such as ``05_09`` tells the
    subject; another subject's skeleton, with equal names and other lengths, is not taken.

    Parameters
    ----------
    path : path-like
        A ``.bvh`` or an ``.amc`` file.

    Returns
    -------
    Motion

    Raises
    ------
    DataError
        If the file is missing, of another kind, or an AMC file without a skeleton.
    MotionFormatError
        If it breaks its format.

    Examples
    --------
    >>> motion = read_motion("05_09.amc")  # doctest: +SKIP
    """
    path = Path(path)
    kind = path.suffix.lower()
    if kind == ".bvh":
        return read_bvh(path)
    if kind == ".amc":
        skeleton = find_skeleton(path)
        if skeleton is None:
            subject = path.stem.rpartition("_")[0] or path.stem
            raise DataError(
                f"{path}: has no skeleton beside it, want {path.stem}.asf or {subject}.asf "
                "in its folder"
            )
        return read_asf_amc(skeleton, path)
    if kind == ".asf":
        raise DataError(f"{path}: holds a skeleton without motion, want its .amc file")
    raise DataError(f"{path}: is of kind {kind or 'none'}, want a .bvh or an .amc file")


def find_skeleton(path: str | Path) -> Path | None:
    """Find the skeleton that lies beside an AMC file.

    Whoever asks whether a motion can be read must ask by the rule of :func:`read_motion`.

    Parameters
    ----------
    path : path-like
        An ``.amc`` file.

    Returns
    -------
    Path or None
        The ASF file of the same name, else of the same subject, else the only one in the
        folder if the clip's name tells no subject; None where there is no such file.

    Raises
    ------
    DataError
        If there is no AMC file.
    """
    path = Path(path)
    if not path.is_file():
        raise DataError(f"{path}: there is no such file")
    skeletons = {p.stem: p for p in path.parent.iterdir() if p.suffix.lower() == ".asf"}
    for stem in (path.stem, path.stem.rpartition("_")[0]):
        if stem in skeletons:
            return skeletons[stem]
    if len(skeletons) == 1 and not _TRIAL.fullmatch(path.stem):
        return next(iter(skeletons.values()))
    return None
