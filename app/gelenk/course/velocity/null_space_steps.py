"""The worked solution of a redundant arm's second wish: objectives, gradients, what J lets through."""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.writing import largest, number, row
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

ObjectiveName: TypeAlias = Literal["posture", "mid_range", "limits", "manipulability", "clearance"]

_H = {
    "posture": r"\frac{1}{2} \lVert q - q_0 \rVert^2",
    "mid_range": r"\frac{1}{2} \sum_i \left( \frac{q_i - \bar q_i}{q_{iM} - q_{im}} \right)^2",
    "limits": r"\frac{1}{4} \sum_i \frac{(q_{iM} - q_{im})^2}{(q_{iM} - q_i)(q_i - q_{im})}",
    "manipulability": r"-\ln \sqrt{\det(J J^{\mathsf T})}",
    "clearance": "-(d - d_0)",
}
_GRADIENT = {
    "posture": "q_i - q_{0i}",
    "mid_range": r"\frac{q_i - \bar q_i}{(q_{iM} - q_{im})^2}",
    "limits": r"\frac{(q_{iM} - q_{im})^2 (2 q_i - q_{iM} - q_{im})}{4 (q_{iM} - q_i)^2 (q_i - q_{im})^2}",
    "manipulability": r"-\mathrm{tr}\left( \frac{\partial J}{\partial q_i} J^{\#} \right)",
    "clearance": r"n^{\mathsf T} \left( \frac{\partial p_a}{\partial q_i} - \frac{\partial p_b}{\partial q_i} \right)",
}


@dataclass(frozen=True, slots=True)
class NearestPair:
    """The two bodies that are nearest to each other.

    Attributes:
        a, b: Their names.
        distance: Negative the depth, [m].
        clearance: The distance less what counts as contact, [m].
        point_a, point_b: Their nearest or deepest points in the root; shape (3,), [m].
    """

    a: str
    b: str
    distance: float
    clearance: float
    point_a: Array
    point_b: Array


@dataclass(frozen=True, slots=True)
class NullSpaceWish:
    """A motion ξ of the joints that is to be made as far as the tip stays as it is.

    Attributes:
        xi: ξ; shape (n,), [rad/s or m/s], or per s more.
        share: The part of its projection that the velocity limits allow, from 0 to 1.
        objective: Name of the objective that ξ follows, None if it was given.
        gain: Factor of the objective's gradient, [1/s].
        q: Where the objective is taken; shape (n,), [rad or m].
        lower, upper: Limits of the joints, infinite where there are none; shape (n,).
        posture: q₀ of the objective `posture`; shape (n,).
        nearest: The nearest pair, of the objective `clearance`.
    """

    xi: Array
    share: float = 1.0
    objective: ObjectiveName | None = None
    gain: float = 1.0
    q: Array | None = None
    lower: Array | None = None
    upper: Array | None = None
    posture: Array | None = None
    nearest: NearestPair | None = None

    def value(self, J: Array) -> float | None:
        """Return H, the objective that is to fall; J has the rows that count, for `manipulability`."""
        if self.objective is None or self.q is None or self.lower is None or self.upper is None:
            return None
        if self.objective == "posture" and self.posture is not None:
            return 0.5 * float(np.square(self.q - self.posture).sum())
        if self.objective == "clearance":
            return None if self.nearest is None else -self.nearest.clearance
        if self.objective == "manipulability":
            sigmas = np.linalg.svd(J, compute_uv=False)
            return -float(np.log(sigmas).sum()) if len(sigmas) and sigmas[-1] > 0.0 else None
        spans = self.upper - self.lower
        limited = np.isfinite(spans) & (spans > 0.0)
        q, lower, upper = self.q[limited], self.lower[limited], self.upper[limited]
        if self.objective == "mid_range":
            return 0.5 * float(np.square((q - 0.5 * (lower + upper)) / (upper - lower)).sum())
        value = 0.25 * float((np.square(upper - lower) / np.maximum((upper - q) * (q - lower), 1e-300)).sum())
        return value if math.isfinite(value) else None

    @property
    def gradient(self) -> Array:
        """∇H, against which ξ goes; shape (n,)."""
        return -self.xi / self.gain + 0.0


def wish_steps(wish: NullSpaceWish, projector: Array, J: Array) -> list[Step]:
    """Return the steps from the objective, if there is one, to the motion that is added."""
    steps = [] if wish.objective is None else [_objective(wish, wish.objective, J)]
    added, size = projector @ wish.xi, largest(wish.xi)
    share = rf"s\, (I - J^{{\#}} J)\, \xi = {number(wish.share)} \cdot {row(added, size)}"
    lines = [rf"\xi = {row(wish.xi)}", rf"(I - J^{{\#}} J)\, \xi = {row(added, size)}"]
    if wish.share < 1.0:
        lines.append(f"{share} = {row(wish.share * added, size)}")
    text = _("The projector leaves of this motion the part that does not move the tip.")
    if wish.share < 1.0:
        text += " " + _("Only a share s of it fits within the velocity limits.")
    return [*steps, step(_("Motion in the null space"), text, *lines)]


def _objective(wish: NullSpaceWish, name: ObjectiveName, J: Array) -> Step:
    value = wish.value(J)
    text = {
        "posture": _("H is half the squared distance from the posture q_0."),
        "mid_range": _("H is half the sum of the squared distances from mid-range, each as a share of its range."),
        "limits": _(
            "H grows without bound towards the limits. Within a twentieth of a range from a limit the gradient is kept "
            "as it is at that distance."
        ),
        "manipulability": _("H is the negative logarithm of Yoshikawa's measure, so that it falls where that rises."),
        "clearance": _(
            "H is the negative clearance: the distance d of the two nearest bodies, less the distance d_0 that an "
            "object demands. That their nearest points slide along the surfaces changes d only in second order, so "
            "that its derivative is that of two points fixed to the bodies, along the unit vector n from p_a to p_b."
        ),
    }[name]
    if name == "clearance" and wish.nearest is not None:
        text += " " + _("Here the nearest bodies are {a} and {b}.").format(a=wish.nearest.a, b=wish.nearest.b)
    text += " " + _("The joints are to follow the negative gradient.")
    return step(
        _("Objective"),
        text,
        *_pair(wish.nearest if name == "clearance" else None),
        rf"H(q) = {_H[name]}" + ("" if value is None else f" = {number(value)}"),
        rf"\frac{{\partial H}}{{\partial q_i}} = {_GRADIENT[name]},\quad \nabla H = {row(wish.gradient)}",
        rf"\xi = -k\, \nabla H = -{number(wish.gain)} \cdot {row(wish.gradient)}",
    )


def _pair(nearest: NearestPair | None) -> list[str]:
    if nearest is None:
        return []
    apart = nearest.point_b - nearest.point_a
    return [
        rf"p_a = {row(nearest.point_a)},\quad p_b = {row(nearest.point_b)}",
        rf"d = {number(nearest.distance)},\quad d_0 = {number(nearest.distance - nearest.clearance)}",
        rf"n = \frac{{p_b - p_a}}{{d}} = {row(apart / nearest.distance)}" if nearest.distance else "d = 0",
    ]
