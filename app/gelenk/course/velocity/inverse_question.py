"""The equation of an inverse velocity at one configuration: its numbers, before they become a worked solution."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from gelenk.course.velocity.inverses import Derivation, LectureInverse
from gelenk.course.velocity.null_space_steps import NullSpaceWish
from gelenk.robot.arrays import Array


@dataclass(frozen=True, slots=True)
class InverseQuestion:
    """The equation J x = b at one configuration, and how it is to be solved.

    Attributes:
        inverse: J with its rank, its weights and λ; angular rows are multiplied by `length`.
        kind: The requested inverse.
        target: v, r̈ or r⃛ as requested, in the rows of J; shape (m,).
        known: What the given rates alone make of it, shape (m,), and its formulas; empty for a velocity.
        order: 1 for a velocity, 2 for an acceleration, 3 for a jerk.
        length: Characteristic length, [m]; None where it changes nothing.
        threshold: σ₀ of the adaptive damping; None where λ was given.
        mixes_units: Whether rows or columns are partly metres, partly radians.
        wish: What the null space is used for; None if for nothing.
    """

    inverse: LectureInverse
    kind: Literal["exact", "pseudo_inverse", "damped"]
    target: Array
    known: tuple[Array, list[str]]
    order: int = 1
    length: float | None = None
    threshold: float | None = None
    mixes_units: bool = False
    wish: NullSpaceWish | None = None

    @property
    def symbols(self) -> tuple[str, str]:
        """LaTeX of x and of the right-hand side."""
        return (r"\dot q", r"\ddot q", "q^{(3)}")[self.order - 1], "b" if self.order > 1 else "v"

    @property
    def b(self) -> Array:
        """The right-hand side."""
        return self.target - self.known[0]

    @property
    def without_solution(self) -> bool:
        """Whether J⁻¹ was requested of a matrix that has none."""
        return self.kind == "exact" and self.inverse.case != "square"

    @property
    def is_damped(self) -> bool:
        """Whether damping acts."""
        return self.inverse.damping > 0.0

    def solution(self) -> Array:
        """Return x; shape (n,)."""
        inverse = self.inverse
        x = (inverse.damped_inverse if self.is_damped else inverse.pseudo_inverse) @ self.b
        return x if self.wish is None else x + self.wish.share * (inverse.projector @ self.wish.xi)

    def cost(self, x: Array) -> float:
        """Return λ xᵀWx + ‖Jx - b‖²."""
        inverse = self.inverse
        return float(inverse.damping * (inverse.weights * x) @ x + np.square(self.b - inverse.J @ x).sum())


def derivation(question: InverseQuestion) -> Derivation:
    """Return the matrices of the solution as numbers."""
    inverse, wish = question.inverse, question.wish
    damped = question.is_damped
    x = inverse.damped_inverse @ question.b if damped else np.zeros(0)
    gradient = None if wish is None or wish.objective is None else wish.gradient.tolist()
    return Derivation(
        inverse.case,
        inverse.J.tolist(),
        inverse.pseudo_inverse.tolist(),
        inverse.moore_penrose,
        inverse.projector.tolist(),
        inverse.gains.tolist(),
        inverse.damped_inverse.tolist() if damped else None,
        question.cost(x) if damped else None,
        (question.b - inverse.J @ x).tolist() if damped else None,
        None if wish is None else wish.value(inverse.J),
        gradient,
        None if wish is None else (wish.share * (inverse.projector @ wish.xi)).tolist(),
    )
