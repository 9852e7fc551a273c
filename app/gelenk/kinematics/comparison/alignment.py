"""Where to lay a table's axes so that they cover a chain's: a base, zeros and senses of the joints, to start from.

One joint after the other, from the base on. What stands behind joint i can still turn about its axis where the joint's
zero is free, and everything can turn about the first axis where the base is: such a slack is taken up by the next axis
that is not parallel, else by the way to the next parallel one. Only rotations are looked for: once they are known
positions follow by linear least squares. Where senses are free each is tried in both, and every way that fits is kept.
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from gelenk.kinematics.comparison.screws import Screws
from gelenk.model.arrays import Array
from gelenk.model.notations import rotations_from_vectors

_PARALLEL = 1e-3
"""Angle below which two axes give no direction to turn by, [rad]; least squares does the rest."""
_COLLINEAR = 1e-6
"""Distance below which two parallel axes give none, [m]."""
_MISFIT = 0.02
"""Angle between axes beyond which a sense is given up, [rad]."""
_MOST_BRANCHES = 256
_MOST_STEPS = 4096
"""Of joints, all branches together: with more than 16 joints there are fewer branches."""
_BASE = -1


class Freedom(NamedTuple):
    """What is to be found; the rest is as the table has it, zeros at 0 and senses at 1."""

    base: bool
    tool: bool
    offsets: bool
    signs: bool


class Alignment(NamedTuple):
    """A start.

    Attributes:
        base: Rotation to be laid before the table's base; shape (3, 3).
        offsets: Of the joints, along their motion in the table; zero where they slide; shape (n,), [rad].
        signs: 1 or -1 each; shape (n,).
    """

    base: Array
    offsets: Array
    signs: Array


class _Axes(NamedTuple):
    """A chain's axes: directions and points, shape (n, 3) each, and which of them slide."""

    directions: Array
    points: Array
    slides: list[bool]

    @classmethod
    def of(cls, screws: Screws) -> "_Axes":
        return cls(screws.directions, screws.points, screws.slides.tolist())


class _Slack(NamedTuple):
    """A rotation that is still open: about an axis of the chain, any where None; whose it is, and a point on it."""

    axis: Array | None
    owner: int
    anchor: tuple[Array, Array] | None


@dataclass(frozen=True, slots=True)
class _Branch:
    """Senses chosen so far. `R` maps directions of the table, at zero, to the chain's, behind the joints so far."""

    R: Array
    base: Array
    offsets: Array
    signs: Array
    slack: _Slack | None
    misfit: float


def alignments(
    target: Screws, table: Screws, freedom: Freedom, signs: Array | None = None, strict: bool = False
) -> list[Alignment]:
    """Ways to lay the axes of a table along those of a chain, the fewest reversed senses first.

    Of more than 256 ways those with the fewest reversed senses are kept.

    Args:
        target: The chain.
        table: The table with a base that is the identity where it is free; its joints are the chain's in number and
            type.
        freedom: What may be found.
        signs: Senses to hold where they are not to be found; all 1 if left out.
        strict: Give none where an axis does not fit, instead of the ways that fit best.
    """
    n = len(target)
    most = min(_MOST_BRANCHES, _MOST_STEPS // n)
    chain, axes = _Axes.of(target), _Axes.of(table)
    held = np.ones(n) if signs is None else signs
    slack = _Slack(None, _BASE, None) if freedom.base else None
    branches = [_Branch(np.eye(3), np.eye(3), np.zeros(n), held, slack, 0.0)]
    for i in range(n):
        senses = (1.0, -1.0) if freedom.signs else (float(held[i]),)
        followers = [_beyond(branch, i, sense, chain, axes, freedom.offsets) for branch in branches for sense in senses]
        fitting = [branch for branch in followers if branch.misfit < _MISFIT]
        if strict and not fitting:
            return []
        branches = fitting or sorted(followers, key=lambda branch: branch.misfit)[:1]
        branches = sorted(branches, key=lambda branch: -branch.signs[: i + 1].sum())[:most]
    if not freedom.tool:
        branches = [_closed(branch, target.tip, table.tip) for branch in branches]
    return [Alignment(branch.base, branch.offsets, branch.signs) for branch in branches]


def _beyond(branch: _Branch, i: int, sense: float, target: _Axes, table: _Axes, free_zeros: bool) -> _Branch:
    """A branch past joint i."""
    signs = branch.signs.copy()
    signs[i] = sense
    branch = _taken_up(replace(branch, signs=signs), i, target, table)
    w, w_target = sense * (branch.R @ table.directions[i]), target.directions[i]
    # From sine and cosine, as the cosine alone is blind near zero.
    misfit = math.atan2(_length(_cross(w, w_target)), float(w @ w_target))
    slack = branch.slack
    turns = not target.slides[i]
    if turns and slack is not None and slack.anchor is None:
        slack = slack._replace(anchor=(table.points[i], target.points[i]))
    if turns and slack is None and free_zeros:
        slack = _Slack(w_target, i, (table.points[i], target.points[i]))
    return replace(branch, slack=slack, misfit=max(branch.misfit, misfit))


def _taken_up(branch: _Branch, i: int, target: _Axes, table: _Axes) -> _Branch:
    """A branch whose slack joint i has taken up, as far as it can."""
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
    """A branch whose slack is taken up by a turn."""
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
    """A branch whose last slack the orientation of the tip takes up."""
    if branch.slack is None or branch.slack.axis is None:
        return branch
    axis = branch.slack.axis
    M = target[:3, :3] @ (branch.R @ table[:3, :3]).T
    sine = axis @ np.array([M[2, 1] - M[1, 2], M[0, 2] - M[2, 0], M[1, 0] - M[0, 1]])
    return _taken(branch, axis, math.atan2(float(sine), float(np.trace(M) - axis @ M @ axis)))


def _cross(a: Array, b: Array) -> Array:
    """The cross product; NumPy's takes longer to look at its arguments than to multiply them."""
    (ax, ay, az), (bx, by, bz) = a.tolist(), b.tolist()
    return np.array((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx))


def _length(vector: Array) -> float:
    return math.hypot(*vector.tolist())


def _across(vector: Array, axis: Array) -> Array:
    """The part of a vector across an axis."""
    across: Array = vector - (vector @ axis) * axis
    return across


def _shortest(a: Array, b: Array) -> Array:
    """The smallest rotation from one unit vector to another; of opposite ones about x, or about y along x."""
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
