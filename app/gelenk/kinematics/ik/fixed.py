"""Joints that are held: the chain that remains without them, and its answers as configurations of the whole chain."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import cast

import numpy as np

from gelenk.kinematics.ik.result import InverseKinematics
from gelenk.kinematics.kernels import chain_poses
from gelenk.model.arrays import Array, Indices
from gelenk.model.chain import Chain, FlatChain


@dataclass(frozen=True, eq=False)
class HeldChain(Chain):
    """A chain some of whose joints are held: each of them is part of a constant placement.

    Attributes:
        whole: The chain with all its joints.
        held: A configuration of it that has the held values; shape (n,), [rad or m].
        free: Which of its variables are left, base to tip.
    """

    whole: Chain
    held: Array
    free: Indices


def held_chain(chain: Chain, fixed: Mapping[str, float]) -> Chain:
    """The chain that remains where some joints are held; the same object for the same values, while it is kept."""
    return _held_chain(chain, tuple(sorted(fixed.items()))) if fixed else chain


@lru_cache(maxsize=64)
def _held_chain(chain: Chain, fixed: tuple[tuple[str, float], ...]) -> HeldChain:
    values = dict(fixed)
    held = np.array([values.get(name, 0.0) for name in chain.joint_names])
    free = np.array([j for j, name in enumerate(chain.joint_names) if name not in values], dtype=np.int64)
    flat = chain.flat
    moving = np.isin(flat.joints[:, 1], free)
    placements, first = [], 0
    # A held joint's motion and the placements on either side of it make one.
    for last in [*np.flatnonzero(moving).tolist(), len(moving)]:
        stretch = slice(first, last)
        part = FlatChain(flat.placements[first : last + 1], flat.joints[stretch], flat.drives[stretch])
        positions, rotations = chain_poses(part, held[None])
        placements.append(np.concatenate((rotations[0].ravel(), positions[0])))
        first = last + 1
    joints = flat.joints[moving].copy()
    joints[:, 1] = np.searchsorted(free, joints[:, 1])
    return HeldChain(
        chain.base_frame,
        chain.tip_frame,
        tuple(chain.joint_names[j] for j in free),
        chain.robot_joints,
        chain.lower[free],
        chain.upper[free],
        FlatChain(np.array(placements), joints, flat.drives[moving].copy()),
        chain,
        held,
        free,
    )


def narrowed(chain: Chain, qs: Array) -> Array:
    """Configurations of the whole chain → those of what remains of it; shape (N, n)."""
    return np.ascontiguousarray(qs[:, chain.free]) if isinstance(chain, HeldChain) else qs


def widened(chain: Chain, qs: Array) -> tuple[Chain, Array]:
    """The whole chain, and its configurations: those of what remains with the held values between; shape (N, n)."""
    if not isinstance(chain, HeldChain):
        return chain, qs
    full = np.tile(chain.held, (len(qs), 1))
    full[:, chain.free] = qs
    return chain.whole, full


def widened_answer(chain: Chain, answer: InverseKinematics) -> InverseKinematics:
    """The answer for what remains of a chain as one for the whole chain."""
    if not isinstance(chain, HeldChain):
        return answer

    def wide(q: Array) -> Array:
        return cast(Array, widened(chain, q[None])[1][0])

    paths = answer.paths and [
        replace(path, trace=path.trace and [replace(at, joint_positions=wide(at.joint_positions)) for at in path.trace])
        for path in answer.paths
    ]
    failures = {i: replace(failure, nearest=wide(failure.nearest)) for i, failure in answer.failures.items()}
    return replace(answer, qs=widened(chain, answer.qs)[1], failures=failures, paths=paths)
