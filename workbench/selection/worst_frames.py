"""Find the worst frame between two keys without computing the errors of all.

D_q obeys the triangle inequality. Frames are put in groups; with c the frame in the middle of
a group, g what slerp gives, and f any frame of the group,

    D_q(f, g(f)) ≤ D_q(f, c) + D_q(c, g(c)) + D_q(g(c), g(f)).

The first term is at most the radius of the group, known once for all keys. The second is the
error of c. The third is |f − c| frames of slerp, which moves at constant speed,
D_q(first, last) / (last − first). A group for which the right side is below an error that was
found elsewhere need not be looked at.
"""

from __future__ import annotations

import numpy as np
from numba import prange

from workbench.kernels import compiled, compiled_parallel
from workbench.selection.splitting import worst_of
from workbench.selection.track_errors import (
    BLOCK,
    add_slerp_errors,
    errors_between,
    frame_errors,
    quaternion_angle,
)
from workbench.selection.tracks import SLERP, Track

#: Frames of a group.
GROUP = 16

# What rounding may add to an error, relatively.
_ROUNDING = 1e-9


class WorstFrames:
    """The worst frames of a track between any two keys.

    Parameters
    ----------
    track : Track
        The frames. Only slerp moves at constant speed; for other interpolators, and between
        near keys, all errors are computed.
    """

    def __init__(self, track: Track) -> None:
        self.track = track
        n_groups = track.n_frames // GROUP if track.kind == SLERP else 0
        centers = np.arange(n_groups) * GROUP + GROUP // 2
        self._centers = np.ascontiguousarray(track.goals[:, :, centers])
        self._radii = np.empty(n_groups)
        _measure_radii(track.goals, track.weights, self._radii)

    def between(self, first: int, last: int) -> tuple[float, int]:
        """Find the largest error between two neighbouring keys.

        Parameters
        ----------
        first, last : int
            The keys, at least one frame between them.

        Returns
        -------
        error : float
        frame : int
            The first frame that has it.
        """
        begin, end = -(-(first + 1) // GROUP), min(last // GROUP, len(self._radii))
        if end - begin < 4:
            return worst_of(errors_between(self.track, first, last), first + 1)
        of_centers = np.empty(end - begin)
        _center_errors(self.track, self._centers, first, last, begin, of_centers)
        speed = _distance(self.track, first, last) / (last - first)
        at_most = of_centers + self._radii[begin:end] + GROUP / 2 * speed
        before, after = np.empty(begin * GROUP - first - 1), np.empty(last - end * GROUP)
        frame_errors(self.track, first, last, first + 1, before)
        frame_errors(self.track, first, last, end * GROUP, after)
        known = max(part.max(initial=0.0) for part in (of_centers, before, after))
        groups = begin + np.flatnonzero(at_most * (1.0 + _ROUNDING) >= known)
        inside = np.empty((len(groups), GROUP))
        _group_errors(self.track, first, last, groups, inside)
        found = [worst_of(before, first + 1)] if len(before) else []
        if len(groups):
            row = int(np.argmax(inside.max(axis=1)))
            found.append(worst_of(inside[row], int(groups[row]) * GROUP))
        if len(after):
            found.append(worst_of(after, end * GROUP))
        return max(found, key=lambda worst: (worst[0], -worst[1]))


@compiled
def _distance(track, a, b):  # type: ignore[no-untyped-def]  # compiled
    """Compute the weighted sum of angles between two frames."""
    total = 0.0
    for joint in range(track.weights.shape[0]):
        p, q = track.goals[joint, :, a], track.goals[joint, :, b]
        angle = quaternion_angle(p[0], p[1], p[2], p[3], q[0], q[1], q[2], q[3])
        total += track.weights[joint] * angle
    return total


@compiled_parallel
def _measure_radii(goals, weights, radii):  # type: ignore[no-untyped-def]  # compiled
    """Write the largest distance of a frame of each group from the one in the middle."""
    for group in prange(radii.shape[0]):
        start = np.int64(group) * GROUP
        distances = np.zeros(GROUP)
        for joint in range(weights.shape[0]):
            center = goals[joint, :, start + GROUP // 2]
            q = goals[joint, :, start : start + GROUP]
            for i in range(GROUP):
                distances[i] += weights[joint] * quaternion_angle(
                    q[0, i], q[1, i], q[2, i], q[3, i], center[0], center[1], center[2], center[3]
                )
        radii[group] = distances.max()


@compiled_parallel
def _center_errors(track, centers, first, last, begin, errors):  # type: ignore[no-untyped-def]  # compiled
    """Write the errors of the frames in the middle of successive groups."""
    n_blocks = (errors.shape[0] + BLOCK - 1) // BLOCK
    for block in prange(n_blocks):
        offset = np.int64(block) * BLOCK
        part = errors[offset : min(offset + BLOCK, errors.shape[0])]
        part[:] = 0.0
        start = (begin + offset, (begin + offset) * GROUP + GROUP // 2 - first)
        for joint in range(centers.shape[0]):
            goals, weight = track.goals[joint], track.weights[joint]
            p, q = goals[:, first], goals[:, last]
            add_slerp_errors(p, q, last - first, centers[joint], start, GROUP, weight, part)


@compiled_parallel
def _group_errors(track, first, last, groups, errors):  # type: ignore[no-untyped-def]  # compiled
    """Write the errors of all frames of some groups."""
    for i in prange(groups.shape[0]):
        frame_errors(track, first, last, groups[i] * GROUP, errors[np.int64(i)])
