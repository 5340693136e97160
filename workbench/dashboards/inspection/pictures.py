"""Pictures of keyframes: what the inspector shows of them, and the files that it writes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.files import write_atomically
from workbench.mocap.motion import Motion

if TYPE_CHECKING:
    import plotly.graph_objects as go

#: Kinds of pictures, and endings of files.
FILMSTRIP, THUMBNAIL = "filmstrip", "thumbnail"
_ENDINGS = (".svg", ".png")

#: Poses that fit into one picture, and into a row of it.
_MOST_POSES, _IN_A_ROW = 40, 10

_THUMBNAIL_TALL = 220


def fitting_keyframes(keyframes: NDArray[np.intp]) -> NDArray[np.intp]:
    """Choose keyframes for a picture, evenly if there are too many, the ends among them."""
    places = np.linspace(0, len(keyframes) - 1, min(len(keyframes), _MOST_POSES))
    return keyframes[places.round().astype(np.intp)]


def keyframe_svg(kind: str, motion: Motion, keyframes: NDArray[np.intp], name: str) -> str:
    """Draw keyframes as the text of an SVG file.

    Parameters
    ----------
    kind : {"filmstrip", "thumbnail"}
        Side by side, or in one picture.
    motion : Motion
        The clip.
    keyframes : ndarray of shape (n_keyframes,)
        Sorted.
    name : str
        What to call the clip.

    Returns
    -------
    str
    """
    # Imported here: who loads a clip need not wait for plotly.
    from workbench.figures.line_svg import line_svg
    from workbench.figures.thumbnails import thumbnail_svg

    shown = fitting_keyframes(keyframes)
    if kind == THUMBNAIL:
        return thumbnail_svg(motion, shown, height=_THUMBNAIL_TALL)
    return line_svg(
        _figure(FILMSTRIP, motion, shown),
        title=f"Keyframes of {name}",
        description=f"Poses of frames {', '.join(map(str, shown))}, side by side. Left limbs are "
        "blue, right limbs orange and open, or dashed where they are thin.",
    )


def check_picture_path(path: str | Path) -> Path:
    """Refuse the name of a file that is not a picture of a kind that can be written.

    Raises
    ------
    WorkbenchError
        If its ending is another.
    """
    target = Path(path)
    if target.suffix.lower() not in _ENDINGS:
        raise WorkbenchError(f"path: got {str(path)!r}, want a name that ends in .svg or .png")
    return target


def write_keyframes(
    path: Path, kind: str, motion: Motion, keyframes: NDArray[np.intp], name: str
) -> None:
    """Write a picture of keyframes, as SVG or PNG by the name's ending.

    Parameters
    ----------
    path : Path
        The file; one that exists is replaced.
    kind, motion, keyframes, name
        As for :func:`keyframe_svg`.

    Raises
    ------
    WorkbenchError
        If there is no browser that could make a PNG.
    """
    if path.suffix.lower() == ".svg":
        write_atomically(path, keyframe_svg(kind, motion, keyframes, name).encode())
        return
    from workbench.reproduction.figure_png import figure_png

    figure = _figure(kind, motion, fitting_keyframes(keyframes))
    write_atomically(path, figure_png(figure))


def _figure(kind: str, motion: Motion, shown: NDArray[np.intp]) -> go.Figure:
    from workbench.figures.filmstrips import filmstrip
    from workbench.figures.thumbnails import thumbnail

    if kind == THUMBNAIL:
        return thumbnail(motion, shown)
    return filmstrip(motion, shown, n_columns=_IN_A_ROW)
