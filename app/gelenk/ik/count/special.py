"""Special geometry of an arm: neighbouring axes that are parallel or intersect, found as zeros of DH parameters.

A nearly special arm has solutions near infinity that rounding loses. The exactly special arm, which lacks them,
replaces it; a target of one arm is a target of the other up to an equally small deviation.
"""

from typing import NamedTuple

import numpy as np

from gelenk.ik.count.homotopy import ComplexArray
from gelenk.robot.arrays import Array

_QUARTER = 0.5 * np.pi
_ROUNDING = 1e-12
_BEND = 0.15
"""Largest relative bend of the loop over the motion of a solution."""


class JointLines(NamedTuple):
    """The joint lines of an arm, by Denavit-Hartenberg parameters.

    Attributes:
        links: θ, d, a and α from each line to the next, with θ = d = 0 for the first; shape (n - 1, 4).
        first, last: Frames on the first line, and on the last of the actual arm; shape (4, 4) each.
        off: Largest deviation of the last line from these parameters over all joint values: angle [rad], and distance
            at the origin.
    """

    links: Array
    first: Array
    last: Array
    off: tuple[float, float]

    def lines(self) -> tuple[Array, Array, Array]:
        """Return axes and points with exactly these parameters, shape (n, 3), and the last frame, shape (4, 4)."""
        T, frames = self.first, [self.first]
        for theta, d, a, alpha in self.links:
            T = T @ _step(theta, d, 2) @ _step(alpha, a, 0)
            frames.append(T)
        return np.array([T[:3, 2] for T in frames]), np.array([T[:3, 3] for T in frames]), T

    def kind(self) -> tuple[tuple[float, ...], ...]:
        """Classify links: angles as quarter turns or -1; lengths as 0 or signed index of the first equal one."""
        quarters = self.links[:, [0, 3]] / _QUARTER
        special = np.where(np.abs(quarters - np.rint(quarters)) < _ROUNDING, np.rint(quarters) % 4, -1.0)
        lengths = self.links[:, 1:3].ravel()
        like = 1.0 + np.argmax(np.abs(np.abs(lengths)[:, None] - np.abs(lengths)) < _ROUNDING, axis=1)
        numbers = np.column_stack((special[:, 0], (np.sign(lengths) * like).reshape(-1, 2), special[:, 1]))
        return tuple(map(tuple, numbers.tolist()))


def geometry(axes: Array, points: Array, tolerance: float) -> JointLines:
    """Compute the parameters of an arm, with lengths and sines of α up to a tolerance set to 0.

    Axes are unit vectors, points lie on them in any unit of length; shape (n, 3) each.
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
    return JointLines(np.array(links), first, before, (angle, distance))


def drawn(
    kind: tuple[tuple[float, ...], ...], slides: tuple[bool, ...], rng: np.random.Generator
) -> tuple[Array, Array]:
    """Draw axes and points of a random arm of a special kind without other special properties; shape (n, 3) each."""
    links = np.array(kind)
    lengths, angles = rng.uniform(0.2, 1.0, 1 + 2 * len(links)), rng.uniform(0.3, 1.2, (len(links), 2))
    special = links[:, [0, 3]]
    # A revolute joint has an arbitrary θ.
    special[~np.array(slides[:-1]), 0] = -1.0
    links[:, [0, 3]] = np.where(special < 0.0, angles, special * _QUARTER)
    links[:, 1:3] = np.sign(links[:, 1:3]) * lengths[np.abs(links[:, 1:3]).astype(int)]
    return JointLines(links, np.eye(4), np.eye(4), (0.0, 0.0)).lines()[:2]


def reaches(screws: ComplexArray, off: tuple[float, float], qs: ComplexArray) -> Array | None:
    """Bound each solution's motion as the target moves, (N, n) [rad]; None if solutions may meet on the way.

    Near a solution the loop is exp(J_1 x_1) ⋯ exp(J_n x_n). In the basis of the twists J_k, each in units of the
    first-order motion of x_k, the summed sizes of their brackets measure how much the loop bends. If that is small, a
    theorem on Newton's method applies: the solution persists, and is the only one within twice its motion.

    Args:
        screws: Axes, then points, of revolute joints; shape (2 n, 3).
        off: Motion of the target: angle [rad], and distance at the origin.
        qs: All solutions of the target, each isolated; shape (N, n), [rad].
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
    """Matrix of the bracket [J_k, ·] for each twist; shape (N, n, 6, 6)."""
    table = np.zeros((len(Js), Js.shape[2], 6, 6), dtype=complex)
    for part, blocks in ((Js[:, :3], ((0, 0), (3, 3))), (Js[:, 3:], ((3, 0),))):
        cross = np.cross(part.transpose(0, 2, 1)[:, :, None], np.eye(3)).transpose(0, 1, 3, 2)
        for i, j in blocks:
            table[:, :, i : i + 3, j : j + 3] = cross
    return table


def _step(angle: float, length: float, axis: int) -> Array:
    """Transform that turns about an axis of a frame and shifts along it; shape (4, 4)."""
    T, j, k = np.eye(4), (axis + 1) % 3, (axis + 2) % 3
    c, s = np.cos(angle), np.sin(angle)
    T[j, j], T[j, k], T[k, j], T[k, k], T[axis, 3] = c, -s, s, c, length
    return T


def _frame(x: Array, z: Array, p: Array) -> Array:
    """Frame at p with its z axis along a vector and its x axis as near to another as possible; shape (4, 4)."""
    T = np.eye(4)
    x = x - z * (z @ x)
    x = x / np.linalg.norm(x)
    T[:3, 0], T[:3, 1], T[:3, 2], T[:3, 3] = x, np.cross(z, x), z, p
    return T
