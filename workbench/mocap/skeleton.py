"""The skeleton: a tree of joints with bones between them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError

POSITION_CHANNELS = ("Xposition", "Yposition", "Zposition")
ROTATION_CHANNELS = ("Xrotation", "Yrotation", "Zrotation")


@dataclass(frozen=True)
class EndSite:
    """The far end of a bone that carries no further joint.

    Attributes
    ----------
    joint : int
        Index of the joint that the end site hangs on.
    offset : ndarray of shape (3,)
        Position in that joint's frame, in file units.
    name : str
        The name that the file gives it, or an empty string.
    """

    joint: int
    offset: NDArray[np.float64]
    name: str = ""


@dataclass(frozen=True, eq=False)
class Skeleton:
    """A tree of joints, each placed relative to its parent.

    Joints are identified by index because files exist that use a name twice.

    Parameters
    ----------
    names : tuple of str
        Joint names, in file order; parents come before their children.
    parents : ndarray of shape (n_joints,)
        Index of each joint's parent, -1 for the root, which is joint 0.
    offsets : ndarray of shape (n_joints, 3)
        Rest position of each joint relative to its parent, in file units; of a joint that a
        file moves as well as turns, its mean position.
    end_sites : tuple of EndSite
        Ends of the outermost bones.
    channels : tuple of tuple of str
        BVH channel names of each joint in file order. The rotation channels among them
        give the joint's Euler order: R = R_first · R_second · R_third.
    unit_cm : float or None
        Length of one file unit in centimetres, None where the scale is not known.

    Raises
    ------
    WorkbenchError
        If the arrays do not fit each other, a parent does not precede its child, an end
        site hangs on no joint, or a joint has an unknown channel or one channel twice.
    """

    names: tuple[str, ...]
    parents: NDArray[np.intp]
    offsets: NDArray[np.float64]
    end_sites: tuple[EndSite, ...]
    channels: tuple[tuple[str, ...], ...]
    unit_cm: float | None = None

    def __post_init__(self) -> None:
        parents = np.asarray(self.parents, dtype=np.intp)
        offsets = np.asarray(self.offsets, dtype=np.float64)
        n = len(self.names)
        if n == 0:
            raise WorkbenchError("names: got none, want at least one joint")
        if parents.shape != (n,) or offsets.shape != (n, 3) or len(self.channels) != n:
            raise WorkbenchError(
                f"skeleton of {n} joints: got parents of shape {parents.shape}, offsets of shape "
                f"{offsets.shape} and {len(self.channels)} channel lists, "
                f"want ({n},), ({n}, 3) and {n}"
            )
        if parents[0] != -1 or np.any(parents[1:] < 0) or np.any(parents >= np.arange(n)):
            raise WorkbenchError(
                f"parents: got {parents.tolist()}, want -1 for joint 0 and an earlier joint "
                "for every other"
            )
        for site in self.end_sites:
            if not 0 <= site.joint < n or np.shape(site.offset) != (3,):
                raise WorkbenchError(
                    f"end_sites: got joint {site.joint} and an offset of shape "
                    f"{np.shape(site.offset)}, want a joint below {n} and (3,)"
                )
        known = POSITION_CHANNELS + ROTATION_CHANNELS
        for name, channels in zip(self.names, self.channels, strict=True):
            if len(set(channels)) < len(channels) or not set(channels) <= set(known):
                raise WorkbenchError(
                    f"channels of joint {name!r}: got {channels}, want each at most once of {known}"
                )
        object.__setattr__(self, "parents", parents)
        object.__setattr__(self, "offsets", offsets)

    @property
    def n_joints(self) -> int:
        """Number of joints, the root included."""
        return len(self.names)

    def rotation_order(self, joint: int) -> str:
        """Read a joint's Euler order off its channels, for instance ``"ZYX"``."""
        return "".join(c[0] for c in self.channels[joint] if c in ROTATION_CHANNELS)

    @cached_property
    def path_weights(self) -> NDArray[np.float64]:
        """Weights of D_q: each joint's longest path to an end effector.

        A joint high in the tree moves all that hangs on it, so its rotation error counts
        more. Path length is the sum of bone lengths in file units (Costa 2018, Eq. 3.2;
        read so because the errors then have the size of the published ones).

        Returns
        -------
        ndarray of shape (n_joints,)
        """
        reach = np.zeros(self.n_joints)
        for site in self.end_sites:
            reach[site.joint] = max(reach[site.joint], float(np.linalg.norm(site.offset)))
        for joint in range(self.n_joints - 1, 0, -1):
            parent = self.parents[joint]
            length = float(np.linalg.norm(self.offsets[joint]))
            reach[parent] = max(reach[parent], reach[joint] + length)
        return reach

    def same_structure(self, other: Skeleton) -> bool:
        """Tell whether two skeletons have equal joints, bones and weights."""
        return (
            self.names == other.names
            and np.array_equal(self.parents, other.parents)
            and np.allclose(self.offsets, other.offsets)
            and np.allclose(self.path_weights, other.path_weights)
        )
