"""Three axes that meet in a point: R = Rz(ϑ) Ry(ϑ') Rz(ϑ''), inverted like ZYZ angles."""

import math

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.writing import ROUNDING, atan2, matrix, number, theta, vector, wrapped
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

DEGENERATE = 1e-9
"""Sine of the middle angle below which only a sum or difference of the outer angles is determined."""


def zyz_angles(M: Array) -> tuple[list[tuple[float, float, float]], int]:
    """Return both branches of the three angles, and 0; or (sum or difference, middle, 0), and the sign ±1 of it."""
    sine = math.hypot(M[0, 2], M[1, 2])
    if sine > DEGENERATE:
        branches = []
        for s in (1.0, -1.0):
            middle = math.atan2(s * sine, M[2, 2])
            branches.append((math.atan2(s * M[1, 2], s * M[0, 2]), middle, math.atan2(s * M[2, 1], -s * M[2, 0])))
        return branches, 0
    if M[2, 2] > 0.0:
        return [(math.atan2(M[1, 0], M[0, 0]), 0.0, 0.0)], 1
    return [(math.atan2(-M[1, 0], -M[0, 0]), math.pi, 0.0)], -1


def wrist_formulas(first: int, name: str) -> list[str]:
    """Return the product of the three rotations, and how its angles follow from the entries m of a rotation."""
    one, two, three = (theta(first + k) for k in range(3))
    c4, s4, c5, s5, c6, s6 = (rf"{f}_{{{first + k}}}" for k in (1, 2, 3) for f in "cs")
    product = (
        rf"\begin{{bmatrix}} {c4} {c5} {c6} - {s4} {s6} & -{c4} {c5} {s6} - {s4} {c6} & {c4} {s5} \\ "
        rf"{s4} {c5} {c6} + {c4} {s6} & -{s4} {c5} {s6} + {c4} {c6} & {s4} {s5} \\ "
        rf"-{s5} {c6} & {s5} {s6} & {c5} \end{{bmatrix}}"
    )
    return [
        rf"{name} = R_z({one})\, R_y({two})\, R_z({three}) = {product}",
        *zyz_formulas(one, two, three),
    ]


def zyz_formulas(one: str, two: str, three: str) -> list[str]:
    """Return how three ZYZ angles follow from the entries m of a rotation."""
    outer = atan2(r"\pm m_{23}", r"\pm m_{13}"), atan2(r"\pm m_{32}", r"\mp m_{31}")
    return [
        f"{two} = " + atan2(r"\pm\sqrt{m_{13}^2 + m_{23}^2}", "m_{33}"),
        rf"{one} = {outer[0]}, \quad {three} = {outer[1]}",
    ]


def wrist_numbers(first: int, name: str, M: Array, branches: list[tuple[float, float, float]], sign: int) -> list[str]:
    """Return the numbers of the rotation, and the angles of its branches."""
    one, two, three = (theta(first + k) for k in range(3))
    lines = [rf"{name} = {matrix(M)}"]
    if sign:
        total, middle, _zero = branches[0]
        both = rf"{one} {'+' if sign > 0 else '-'} {three}"
        return [*lines, rf"{two} = {number(middle)}, \quad {both} = {number(wrapped(total))}"]
    return lines + [rf"({one}, {two}, {three}) = ({', '.join(map(number, angles))})" for angles in branches]


def wrist_text(is_degenerate: bool) -> str:
    """Say that there are two branches, or that only a sum or difference is determined."""
    text = _("The last three joints are ZYZ angles of what is left of the rotation: two branches, one flipped.")
    if not is_degenerate:
        return text
    line = _("Where the middle angle is 0 or π the outer two axes are in line: only their sum or difference is known.")
    return f"{text} {line}"


def centre_step(pose: Array, tail: Array, centre: Array, text: str) -> Step:
    """Return the step from the target, shape (4, 4), back to the centre of the wrist, [m]."""
    if np.abs(tail[:2, 3]).max() < ROUNDING and abs(tail[2, 2] - 1.0) < ROUNDING:
        back = rf"{vector(pose[:3, 3])} - {number(float(tail[2, 3]))} \cdot {vector(pose[:3, 2])}"
        return step(_("Wrist centre"), text, rf"p_w = p - d_6\, R\, e_z = {back} = {vector(centre)}")
    place = vector(-tail[:3, :3].T @ tail[:3, 3])
    return step(_("Wrist centre"), text, rf"p_w = p + R\, w = {vector(centre)}, \quad w = {place}")
