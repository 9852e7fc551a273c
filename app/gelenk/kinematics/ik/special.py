"""What is special about an arm: which neighbouring axes are parallel or meet, found as zeros of DH parameters.

An arm that is special up to a small deviation has solutions near infinity that rounding loses. It is replaced by the
exactly special arm, which lacks them; a target of one is a target of the other up to as small a deviation.
"""

from typing import NamedTuple

import numpy as np

from gelenk.kinematics.ik.homotopy import ComplexArray
from gelenk.model.arrays import Array

_QUARTER = 0.5 * np.pi
_ROUNDING = 1e-12
_BEND = 0.15
"""How much the loop may bend where a solution goes."""


class Geometry(NamedTuple):
    """The lines of joints, by Denavit and Hartenberg's numbers.

    Attributes:
        links: θ, d, a and α from each line to the next, θ and d 0 of the first; shape (n - 1, 4).
        first: Frame on the first line; shape (4, 4).
        last: Frame on the last one, as the arm has it; shape (4, 4).
        off: How far at most the last line is from where these numbers have it, wherever the joints are: angle [rad],
            and distance at the origin.
    """

    links: Array
    first: Array
    last: Array
    off: tuple[float, float]

    def lines(self) -> tuple[Array, Array, Array]:
        """Axes and points that have exactly these numbers, shape (n, 3), and the last line's frame, shape (4, 4)."""
        T, frames = self.first, [self.first]
        for theta, d, a, alpha in self.links:
            T = T @ _step(theta, d, 2) @ _step(alpha, a, 0)
            frames.append(T)
        return np.array([T[:3, 2] for T in frames]), np.array([T[:3, 3] for T in frames]), T

    def kind(self) -> tuple[tuple[float, ...], ...]:
        """Which angles are quarter turns, -1 where they are none; which lengths are 0, which others they equal."""
        quarters = self.links[:, [0, 3]] / _QUARTER
        special = np.where(np.abs(quarters - np.rint(quarters)) < _ROUNDING, np.rint(quarters) % 4, -1.0)
        lengths = self.links[:, 1:3].ravel()
        like = 1.0 + np.argmax(np.abs(np.abs(lengths)[:, None] - np.abs(lengths)) < _ROUNDING, axis=1)
        numbers = np.column_stack((special[:, 0], (np.sign(lengths) * like).reshape(-1, 2), special[:, 1]))
        return tuple(map(tuple, numbers.tolist()))


def geometry(axes: Array, points: Array, tolerance: float) -> Geometry:
    """The numbers of an arm, lengths and sines of α up to a tolerance taken as 0.

    Args:
        axes: Unit vectors; shape (n, 3).
        points: A point on each; shape (n, 3).
        tolerance: Sine of an angle, or length in the unit of the points.
    """
    links, angle, distance, reach = [], 0.0, 0.0, 0.0
    at, first, before = points[0], np.eye(4), np.eye(4)
    for i, (h, k, q) in enumerate(zip(axes[:-1], axes[1:], points[1:], strict=True)):
        normal = np.cross(h, k)
        square = float(normal @ normal)
        if square > tolerance**2:
            foot = at + h * (np.cross(q - at, k) @ normal / square)
            following, x = q + k * (np.cross(q - at, h) @ normal / square), normal
        else:
            foot, following = at, q + k * (k @ (at - q))
            x = following - foot - h * (h @ (following - foot))
            if np.linalg.norm(x) <= tolerance:
                x = before[:3, 0] if i else np.eye(3)[int(np.argmin(np.abs(h)))]
        start = _frame(x, h, foot)
        if i == 0:
            first, before, at, reach = start, start, foot, float(np.linalg.norm(foot))
        x, y = start[:3, 0], start[:3, 1]
        d, a = (length if abs(length) > tolerance else 0.0 for length in (h @ (foot - at), x @ (following - foot)))
        alpha = np.arctan2(-(k @ y), k @ h) if abs(k @ y) > tolerance else (0.0 if k @ h > 0.0 else np.pi)
        links.append((np.arctan2(h @ np.cross(before[:3, 0], x), before[:3, 0] @ x), d, a, alpha))
        before = _frame(x, k, following)
        ideal = start @ _step(alpha, a, 0)
        reach += abs(d) + abs(a)
        turned = float(np.linalg.norm(ideal[:3, :3] - before[:3, :3]))
        angle += turned
        distance += float(np.linalg.norm(ideal[:3, 3] - following)) + abs(float(h @ (foot - at)) - d) + turned * reach
        at = following
    return Geometry(np.array(links), first, before, (angle, distance))


def drawn(
    kind: tuple[tuple[float, ...], ...], slides: tuple[bool, ...], rng: np.random.Generator
) -> tuple[Array, Array]:
    """Axes and points of some arm that is special in the same way and in no other; shape (n, 3)."""
    links = np.array(kind)
    lengths, angles = rng.uniform(0.2, 1.0, 1 + 2 * len(links)), rng.uniform(0.3, 1.2, (len(links), 2))
    special = links[:, [0, 3]]
    # Where a joint turns, θ is its own.
    special[~np.array(slides[:-1]), 0] = -1.0
    links[:, [0, 3]] = np.where(special < 0.0, angles, special * _QUARTER)
    links[:, 1:3] = np.sign(links[:, 1:3]) * lengths[np.abs(links[:, 1:3]).astype(int)]
    return Geometry(links, np.eye(4), np.eye(4), (0.0, 0.0)).lines()[:2]


def reaches(screws: ComplexArray, off: tuple[float, float], qs: ComplexArray) -> Array | None:
    """How far each solution goes at most as the target moves by so much; None if some may meet on the way.

    Beside a solution the loop is exp(J_1 x_1) ⋯ exp(J_n x_n). In the basis of the twists J_k, each in units of how far
    x_k goes to first order, the sum of their brackets' sizes tells how much the loop bends. While it bends but little,
    Newton's theorem holds: the solution stays, alone up to twice as far as it goes.

    Args:
        screws: Axes, then points, of turning joints; shape (2 n, 3).
        off: Angle [rad] and distance that the target moves, at the origin.
        qs: All solutions of the target, which stand alone; shape (N, n), [rad].

    Returns:
        Shape (N, n), [rad].
    """
    Js = _twists(screws, qs)
    inverses = np.linalg.inv(Js)
    far = np.abs(inverses) @ np.repeat(off, 3)
    brackets = np.abs(inverses[:, None] @ _brackets(Js) @ Js[:, None])
    bends = np.einsum("nk,nkij,nj->ni", far, brackets, far) / far
    apart = qs[:, None] - qs
    apart -= 2.0 * np.pi * np.rint(apart.real / (2.0 * np.pi))
    together = (np.abs(apart) <= 2.0 * (far[:, None] + far)).all(axis=2)
    return 2.0 * far if bends.max() <= _BEND and together.sum() == len(qs) else None


def _twists(screws: ComplexArray, qs: ComplexArray) -> ComplexArray:
    """Twists of revolute joints as columns, rotation before velocity of the origin; shape (N, 6, n)."""
    n = qs.shape[1]
    Js = np.empty((len(qs), 6, n), dtype=complex)
    R, p = np.tile(np.eye(3, dtype=complex), (len(qs), 1, 1)), np.zeros((len(qs), 3), dtype=complex)
    for k in range(n):
        h, o, q = screws[k], screws[n + k], qs[:, k, None, None]
        Js[:, :3, k], around = R @ h, p + R @ o
        Js[:, 3:, k] = np.cross(around, Js[:, :3, k])
        cross = np.cross(h, np.eye(3)).T
        R = R @ (np.eye(3) + np.sin(q) * cross + (1.0 - np.cos(q)) * cross @ cross)
        p = around - R @ o
    return Js


def _brackets(Js: ComplexArray) -> ComplexArray:
    """The matrix of [J_k, ·] for each twist; shape (N, n, 6, 6)."""
    table = np.zeros((len(Js), Js.shape[2], 6, 6), dtype=complex)
    for part, blocks in ((Js[:, :3], ((0, 0), (3, 3))), (Js[:, 3:], ((3, 0),))):
        cross = np.cross(part.transpose(0, 2, 1)[:, :, None], np.eye(3)).transpose(0, 1, 3, 2)
        for i, j in blocks:
            table[:, :, i : i + 3, j : j + 3] = cross
    return table


def _step(angle: float, length: float, axis: int) -> Array:
    """A turn about one of a frame's axes and a shift along it; shape (4, 4)."""
    T, j, k = np.eye(4), (axis + 1) % 3, (axis + 2) % 3
    c, s = np.cos(angle), np.sin(angle)
    T[j, j], T[j, k], T[k, j], T[k, k], T[axis, 3] = c, -s, s, c, length
    return T


def _frame(x: Array, z: Array, p: Array) -> Array:
    """The frame at p with its z axis along one vector and x as near to the other as possible; shape (4, 4)."""
    T = np.eye(4)
    x = x - z * (z @ x)
    x = x / np.linalg.norm(x)
    T[:3, 0], T[:3, 1], T[:3, 2], T[:3, 3] = x, np.cross(z, x), z, p
    return T
