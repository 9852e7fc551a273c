"""Alignment of a table's axes with a chain's: starting values for base, zeros and senses of the joints.

The alignment goes joint by joint from the base. If the zero of joint i is free, everything after it can still rotate
about its axis, and if the base is free, everything can rotate about the first axis. The next axis that is not parallel
fixes this slack, else the displacement to the next parallel axis. Only rotations are needed: positions then follow by
linear least squares. If senses are free both are tried for each joint, and every alignment that fits is kept.
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from gelenk.dh.compare.screws import ChainScrews
from gelenk.robot.arrays import Array
from gelenk.robot.notations import rotations_from_vectors

_PARALLEL = 1e-3
"""Sine of the angle below which two axes do not determine a rotation; least squares does the rest."""
_COLLINEAR = 1e-6
"""Distance below which two parallel axes do not determine a rotation, [m]."""
_MISFIT = 0.02
"""Angle between axes at which a sense is rejected, [rad]."""
_MOST_BRANCHES = 256
_MOST_STEPS = 4096
"""Limit of joints times branches: chains with more than 16 joints get fewer branches."""
_BASE = -1


class Freedom(NamedTuple):
    """The quantities to find; others are as in the table, with offsets of 0 and signs of 1."""

    base: bool
    tool: bool
    offsets: bool
    signs: bool


class Alignment(NamedTuple):
    """Starting values for least squares; `base` (3, 3) is a rotation that premultiplies the table's base.

    `offsets` (n,) [rad] are in the table's sense, zero if prismatic; `signs` (n,), 1 or -1, are the joints' senses.
    """

    base: Array
    offsets: Array
    signs: Array


class _Slack(NamedTuple):
    """An undetermined rotation: about an axis (any if None), due to joint or base `owner`, through points `anchor`."""

    axis: Array | None
    owner: int
    anchor: tuple[Array, Array] | None


@dataclass(frozen=True, slots=True)
class _Branch:
    """A partial alignment. After the joints so far, `R` maps directions in the table, at zero, to the chain's."""

    R: Array
    base: Array
    offsets: Array
    signs: Array
    slack: _Slack | None
    misfit: float


def alignments(
    target: ChainScrews, table: ChainScrews, freedom: Freedom, signs: Array | None = None, strict: bool = False
) -> list[Alignment]:
    """Align the axes of a table with those of a chain; return at most 256 alignments, the fewest reversed senses first.

    The joints match in number and type, and a free base must be the identity. Senses that are not to be found are
    `signs`, all 1 if None. If `strict`, nothing is returned if an axis does not fit, instead of the best alignment.
    """
    n = len(target)
    most = min(_MOST_BRANCHES, _MOST_STEPS // n)
    held = np.ones(n) if signs is None else signs
    slack = _Slack(None, _BASE, None) if freedom.base else None
    branches = [_Branch(np.eye(3), np.eye(3), np.zeros(n), held, slack, 0.0)]
    for i in range(n):
        senses = (1.0, -1.0) if freedom.signs else (float(held[i]),)
        followers = [
            _beyond(branch, i, sense, target, table, freedom.offsets) for branch in branches for sense in senses
        ]
        fitting = [branch for branch in followers if branch.misfit < _MISFIT]
        if strict and not fitting:
            return []
        branches = fitting or sorted(followers, key=lambda branch: branch.misfit)[:1]
        branches = sorted(branches, key=lambda branch: -branch.signs[: i + 1].sum())[:most]
    if not freedom.tool:
        branches = [_closed(branch, target.tip, table.tip) for branch in branches]
    return [Alignment(branch.base, branch.offsets, branch.signs) for branch in branches]


def _beyond(
    branch: _Branch, i: int, sense: float, target: ChainScrews, table: ChainScrews, free_zeros: bool
) -> _Branch:
    signs = branch.signs.copy()
    signs[i] = sense
    branch = _taken_up(replace(branch, signs=signs), i, target, table)
    w, w_target = sense * (branch.R @ table.directions[i]), target.directions[i]
    # From sine and cosine, as the cosine alone cannot resolve small angles.
    misfit = math.atan2(_length(_cross(w, w_target)), float(w @ w_target))
    slack = branch.slack
    turns = not target.slides[i]
    if turns and slack is not None and slack.anchor is None:
        slack = slack._replace(anchor=(table.points[i], target.points[i]))
    if turns and slack is None and free_zeros:
        slack = _Slack(w_target, i, (table.points[i], target.points[i]))
    return replace(branch, slack=slack, misfit=max(branch.misfit, misfit))


def _taken_up(branch: _Branch, i: int, target: ChainScrews, table: ChainScrews) -> _Branch:
    """Let joint i fix the slack of a branch, as far as it can."""
    slack = branch.slack
    if slack is None:
        return branch
    w, w_target = branch.signs[i] * (branch.R @ table.directions[i]), target.directions[i]
    if slack.axis is None:
        return replace(_turned(branch, _shortest(w, w_target)), slack=slack._replace(axis=w_target))
    axis = slack.axis
    here, there = _across(w, axis), _across(w_target, axis)
    least = _PARALLEL
    if _length(there) < _PARALLEL and not target.slides[i] and slack.anchor is not None:
        here = _across(branch.R @ (table.points[i] - slack.anchor[0]), axis)
        there = _across(target.points[i] - slack.anchor[1], axis)
        least = _COLLINEAR
    if min(_length(here), _length(there)) < least:
        return branch
    angle = math.atan2(float(axis @ _cross(here, there)), float(here @ there))
    return _taken(branch, axis, angle)


def _taken(branch: _Branch, axis: Array, angle: float) -> _Branch:
    """Fix the slack of a branch by a rotation."""
    owner = branch.slack.owner if branch.slack else _BASE
    turn = _rotation(angle * axis)
    if owner == _BASE:
        return replace(_turned(branch, turn), slack=None)
    offsets = branch.offsets.copy()
    offsets[owner] = branch.signs[owner] * angle
    return replace(branch, R=turn @ branch.R, offsets=offsets, slack=None)


def _turned(branch: _Branch, turn: Array) -> _Branch:
    return replace(branch, R=turn @ branch.R, base=turn @ branch.base)


def _closed(branch: _Branch, target: Array, table: Array) -> _Branch:
    """Fix the last slack of a branch by the orientation of the tip."""
    if branch.slack is None or branch.slack.axis is None:
        return branch
    axis = branch.slack.axis
    M = target[:3, :3] @ (branch.R @ table[:3, :3]).T
    sine = axis @ np.array([M[2, 1] - M[1, 2], M[0, 2] - M[2, 0], M[1, 0] - M[0, 1]])
    return _taken(branch, axis, math.atan2(float(sine), float(np.trace(M) - axis @ M @ axis)))


def _cross(a: Array, b: Array) -> Array:
    """Cross product; NumPy's spends more time checking its arguments than multiplying them."""
    (ax, ay, az), (bx, by, bz) = a.tolist(), b.tolist()
    return np.array((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx))


def _length(vector: Array) -> float:
    return math.hypot(*vector.tolist())


def _across(vector: Array, axis: Array) -> Array:
    across: Array = vector - (vector @ axis) * axis
    return across


def _shortest(a: Array, b: Array) -> Array:
    """Smallest rotation from one unit vector to another; if opposite, about an axis near x, or near y if along x."""
    normal = _cross(a, b)
    sine = _length(normal)
    if sine < 1e-12:
        if a @ b > 0.0:
            return np.eye(3)
        across = _across(np.eye(3)[0 if abs(a[0]) < 0.9 else 1], a)
        return _rotation(math.pi * across / np.linalg.norm(across))
    return _rotation(math.atan2(sine, float(a @ b)) * normal / sine)


def _rotation(vector: Array) -> Array:
    rotation: Array = rotations_from_vectors(np.ascontiguousarray(vector[None]))[0]
    return rotation
