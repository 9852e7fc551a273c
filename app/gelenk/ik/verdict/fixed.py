"""Held joints: the chain that remains without them, and its answers converted to the whole chain."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from gelenk.ik.verdict.result import InverseKinematics
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain, FlatChain


@dataclass(frozen=True, eq=False)
class HeldChain(Chain):
    """A chain with some joints held: each held joint becomes part of a constant placement.

    Attributes:
        held: Configuration of the whole chain with the held values, else zeros; shape (n,), [rad or m].
        free: Indices of the remaining variables in the whole chain, base to tip.
    """

    whole: Chain
    held: Array
    free: Indices


def held_chain(chain: Chain, fixed: Mapping[str, float]) -> Chain:
    """Return the chain that remains with some joints held; equal values give the same object while cached."""
    return _held_chain(chain, tuple(sorted(fixed.items()))) if fixed else chain


@lru_cache(maxsize=64)
def _held_chain(chain: Chain, fixed: tuple[tuple[str, float], ...]) -> HeldChain:
    values = dict(fixed)
    held = np.array([values.get(name, 0.0) for name in chain.joint_names])
    free = np.array([j for j, name in enumerate(chain.joint_names) if name not in values], dtype=np.int64)
    flat = chain.flat
    moving = np.isin(flat.joints[:, 1], free)
    placements, first = [], 0
    # Merge a held joint's motion with the placements on either side of it.
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
    """Reduce configurations of the whole chain to the free variables; shape (N, n), [rad or m]."""
    return np.ascontiguousarray(qs[:, chain.free]) if isinstance(chain, HeldChain) else qs


def widened(chain: Chain, qs: Array) -> tuple[Chain, Array]:
    """Return the whole chain, and the configurations with the held values inserted; shape (N, n), [rad or m]."""
    if not isinstance(chain, HeldChain):
        return chain, qs
    full = np.tile(chain.held, (len(qs), 1))
    full[:, chain.free] = qs
    return chain.whole, full


def widened_answer(chain: Chain, answer: InverseKinematics) -> InverseKinematics:
    """Convert the answer for a held chain to one for the whole chain."""
    if not isinstance(chain, HeldChain):
        return answer

    def wide(q: Array | list[float]) -> Array:
        return np.asarray(widened(chain, np.array([q]))[1][0])

    paths = answer.paths and [
        replace(path, trace=[replace(at, joint_positions=wide(at.joint_positions).tolist()) for at in path.trace])
        if path.trace
        else path
        for path in answer.paths
    ]
    failures = {i: replace(failure, nearest=wide(failure.nearest)) for i, failure in answer.failures.items()}
    return replace(answer, qs=widened(chain, answer.qs)[1], failures=failures, paths=paths)
