"""How good the solutions are: the near branch where there is one, and none missing where all are asked for."""

import numpy as np

from gelenk.ik.verdict.branches import all_branches
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from tests.benchmarks.arms import ARMS, poses
from tests.benchmarks.table import Row
from tests.ik.arms import IRB, PUMA, UR5, problem, search, table_arm
from tests.oracles.dh_columns import Table
from tests.oracles.many_starts import solutions

TRACKED = 1_000
STEP = 0.05
"""Length of a step in the joints, [rad or m]."""
JUMP = 0.5
"""A joint that moves further than this has left the branch, [rad or m]."""
LISTED = 200
STARTS = 1024


def measure() -> list[Row]:
    """Track and list."""
    return [tracking(), *(completeness(name, table) for name, table in (("UR5", UR5), ("Puma", PUMA), ("IRB", IRB)))]


def tracking() -> Row:
    """Targets a small step from the seed's pose, on all arms: the worst share that stays near."""
    shares = {}
    for arm in ARMS:
        random = np.random.default_rng(4)
        lower, upper = np.maximum(arm.chain.lower, -np.pi), np.minimum(arm.chain.upper, np.pi)
        seeds = random.uniform(lower, upper, (TRACKED, len(arm.chain)))
        steps = random.normal(size=seeds.shape)
        steps *= STEP / np.linalg.norm(steps, axis=1)[:, None]
        Ts = poses(arm, np.clip(seeds + steps, lower, upper))
        targets = Poses(np.ascontiguousarray(Ts[:, :3, 3]), np.ascontiguousarray(Ts[:, :3, :3]))
        found = search(arm.chain, targets, seeds)
        near = found.solved & (np.abs(found.qs - seeds).max(axis=1) < JUMP)
        shares[arm.robot] = float(near.mean())
    worst = min(shares, key=lambda name: shares[name])
    mean = float(np.mean(list(shares.values())))
    what = f"IK near the seed, {len(ARMS)} arms × {TRACKED:,} steps of {STEP} rad"
    return Row(what, f"{mean:.2%}", f"worst arm ({worst}) {shares[worst]:.2%}", wanted="≥ 99.5 %")


def completeness(name: str, parameters: list[tuple[float, float, float, float]]) -> Row:
    """All solutions of an arm, against a search that shares no code with ours."""
    _, chain = table_arm(parameters)
    table = Table(True, parameters, [False] * 6)
    qs = np.random.default_rng(6).uniform(-np.pi, np.pi, (LISTED, 6))
    found = expected = missing = 0
    for i, q in enumerate(qs):
        T = table.pose(q)
        target = Poses(T[None, :3, 3].copy(), T[None, :3, :3].copy())
        ours = all_branches(problem(chain, target, np.zeros((1, 6))), 0).qs
        theirs = solutions(table, T, None, STARTS, seed=i)
        found, expected = found + len(ours), expected + len(theirs)
        missing += sum(not contains(ours, other) for other in theirs)
    what = f"all IK solutions of {LISTED} targets, {name}"
    return Row(what, f"{found}, {missing} missing", f"{STARTS:,} starts in NumPy, {expected}", wanted="none missing")


def contains(qs: Array, q: Array) -> bool:
    """Whether a configuration is among others, up to full turns."""
    differences = qs - q
    differences -= 2 * np.pi * np.rint(differences / (2 * np.pi))
    return bool((np.abs(differences).max(axis=1, initial=0.0) < 1e-3).any())
