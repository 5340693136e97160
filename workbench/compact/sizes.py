"""How small a compact file is, beside other forms of the same motion."""

from __future__ import annotations

import gzip
import tempfile
from dataclasses import dataclass
from pathlib import Path

from workbench.errors import WorkbenchError
from workbench.mocap.bvh_writer import write_bvh
from workbench.mocap.motion import Motion


@dataclass(frozen=True)
class Sizes:
    """Bytes of a compact file and of other forms of the same motion.

    Attributes
    ----------
    bytes : int
        Of the compact file.
    bvh_bytes : int
        Of the BVH file.
    gzip_bytes : int
        Of that file, compressed by gzip at level 9.
    float32_bytes : int
        4 · (3·J + 3) · f, for f frames of J joints: a rotation vector for each joint and the
        root's position, as float32, without skeleton or header.
    """

    bytes: int
    bvh_bytes: int
    gzip_bytes: int
    float32_bytes: int

    @property
    def ratio_to_bvh(self) -> float:
        """How many times smaller than the BVH file the compact file is."""
        return self.bvh_bytes / self.bytes

    @property
    def ratio_to_gzip(self) -> float:
        """How many times smaller than the compressed BVH file."""
        return self.gzip_bytes / self.bytes

    @property
    def ratio_to_float32(self) -> float:
        """How many times smaller than plain float32 numbers."""
        return self.float32_bytes / self.bytes

    def as_dict(self) -> dict[str, float]:
        """List all sizes and ratios by name."""
        names = ("bytes", "bvh_bytes", "gzip_bytes", "float32_bytes")
        ratios = ("ratio_to_bvh", "ratio_to_gzip", "ratio_to_float32")
        return {name: getattr(self, name) for name in (*names, *ratios)}


def compare_sizes(n_bytes: int, motion: Motion, bvh_file: Path | None = None) -> Sizes:
    """Compare a compact file with other forms of the same motion.

    Parameters
    ----------
    n_bytes : int
        Size of the compact file.
    motion : Motion
        The whole motion.
    bvh_file : Path, optional
        The BVH file that the motion was read from; by default the one that
        :func:`~workbench.mocap.bvh_writer.write_bvh` would write.

    Returns
    -------
    Sizes

    Raises
    ------
    WorkbenchError
        If there is no BVH file and none can be written.

    Examples
    --------
    >>> from workbench.datasets import load
    >>> sizes = compare_sizes(2000, load("cmu/01_01-jump"))
    >>> sizes.float32_bytes == 4 * 96 * len(load("cmu/01_01-jump"))
    True
    """
    if n_bytes < 1:
        raise WorkbenchError(f"n_bytes: got {n_bytes}, want at least 1")
    if bvh_file is None:
        with tempfile.TemporaryDirectory() as folder:
            write_bvh(motion, Path(folder) / "motion.bvh")
            content = (Path(folder) / "motion.bvh").read_bytes()
    else:
        content = bvh_file.read_bytes()
    return Sizes(
        n_bytes,
        len(content),
        len(gzip.compress(content, 9, mtime=0)),
        4 * (3 * motion.skeleton.n_joints + 3) * len(motion),
    )
