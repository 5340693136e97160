"""Random skeletons and motions for property tests."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from workbench.mocap import EndSite, Motion, Skeleton, rotations_from_channels
from workbench.mocap.skeleton import POSITION_CHANNELS, ROTATION_CHANNELS

_NAMES = st.text(st.characters(codec="utf-8", exclude_categories=["C", "Z"]), min_size=1).filter(
    lambda name: not set(name) & set("{}")
)
_LENGTHS = st.floats(-100, 100).map(lambda x: round(x, 6))


@st.composite
def skeletons(draw: st.DrawFn) -> Skeleton:
    """Draw a skeleton of up to six joints, nested as a file nests them."""
    n = draw(st.integers(1, 6))
    parents, chain = [-1], [0]
    for joint in range(1, n):
        chain = chain[: draw(st.integers(1, len(chain)))]
        parents.append(chain[-1])
        chain.append(joint)
    channels = [draw(_channels(with_positions=True))]
    channels += [draw(_channels(with_positions=draw(st.booleans()))) for _ in range(n - 1)]
    if not any(channels):
        channels[0] = ("Xrotation",)
    sites = [joint for joint in range(n) if draw(st.booleans())]
    vectors = st.tuples(_LENGTHS, _LENGTHS, _LENGTHS).map(np.array)
    return Skeleton(
        names=tuple(draw(_NAMES) for _ in range(n)),
        parents=np.array(parents),
        offsets=np.array([draw(vectors) for _ in range(n)]),
        end_sites=tuple(EndSite(joint, draw(vectors)) for joint in sites),
        channels=tuple(channels),
    )


@st.composite
def _channels(draw: st.DrawFn, with_positions: bool) -> tuple[str, ...]:
    turns = draw(st.permutations(ROTATION_CHANNELS))[: draw(st.integers(0, 3))]
    moves = list(POSITION_CHANNELS) if with_positions else []
    return (*moves, *turns) if draw(st.booleans()) else (*turns, *moves)


@st.composite
def motions(draw: st.DrawFn, min_frames: int = 1, max_frames: int = 4) -> Motion:
    """Draw a motion that its skeleton's channels can express, gimbal lock included."""
    skeleton = draw(skeletons())
    n_frames = draw(st.integers(min_frames, max_frames))
    seed = draw(st.integers(0, 2**32 - 1))
    rng = np.random.default_rng(seed)
    n_angles = sum(len(skeleton.rotation_order(j)) for j in range(skeleton.n_joints))
    degrees = rng.uniform(-400, 400, (n_frames, n_angles))
    locked = rng.random(degrees.shape) < 0.2
    degrees[locked] = rng.choice([-180.0, -90.0, 0.0, 90.0, 180.0], locked.sum())
    moved = {
        joint: rng.normal(0, 50, (n_frames, 3))
        for joint, channels in enumerate(skeleton.channels)
        if "Xposition" in channels
    }
    still = np.tile(skeleton.offsets[0], (n_frames, 1))
    return Motion(
        skeleton=skeleton,
        rotations=rotations_from_channels(skeleton, degrees),
        root_translation=moved.pop(0, still),
        frame_time=draw(st.floats(1e-6, 1e3)),
        joint_translations=moved,
    )
