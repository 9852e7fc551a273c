"""LaTeX formulas of motions for worked solutions."""

from collections.abc import Sequence
from dataclasses import replace

from gelenk.course.steps import Step, tex
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

SHOWN_JOINTS = 4
"""Largest number of joints that a worked solution shows; others are computed in the same manner."""
_SHOWN_NUMBERS = 12


def tex_polynomial(coefficients: Sequence[float]) -> str:
    """Format a polynomial in t, highest power first in formula and list; 0 if all coefficients are."""
    text = ""
    for power, value in zip(range(len(coefficients) - 1, -1, -1), coefficients, strict=True):
        if value != 0.0:
            symbol = {0: "", 1: r"\,t"}.get(power, rf"\,t^{{{power}}}")
            sign = "-" if value < 0.0 else "+" if text else ""
            text += f" {sign} " if text else sign
            text += tex(abs(value)) + symbol
    return text or "0"


def tex_row(values: Array) -> str:
    """Format numbers in a row, at most twelve of them."""
    shown = ", ".join(map(tex, values[:_SHOWN_NUMBERS].tolist()))
    return shown if len(values) <= _SHOWN_NUMBERS else shown + r", \dots"


def of_joint(step: Step, joint: int, joints: int) -> Step:
    """Return the step with its joint in the title, if there are several joints."""
    if joints == 1:
        return step
    return replace(step, title=_("Joint {number}: {title}").format(number=joint + 1, title=step.title))
