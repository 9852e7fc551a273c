"""What the service did for an arm that nobody solves by hand."""

from collections.abc import Mapping, Sequence

from gelenk.course.steps import Step, step
from gelenk.course.writing import vector
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

_SHOWN = 8


def solver_step(
    closed_form: str | None, method: str, solutions: Array, branches: Sequence[Mapping[str, str | int]]
) -> Step:
    """Return the step that says how solutions were found.

    Args:
        closed_form: Name of the geometry or the method that solved the arm; None after a search.
        method: Name of the iteration otherwise.
        solutions: What is sent, shape (k, n), [rad or m].
        branches: The names of their branches; none after a search.
    """
    text, equation = _geometry(closed_form, method)
    lines = [equation] if equation else []
    for q, branch in zip(solutions[:_SHOWN].tolist(), branches[:_SHOWN], strict=False):
        names = ", ".join(f"{choice} {value}" for choice, value in branch.items()).replace("_", " ")
        lines.append(f"q = {vector(q)}" + (rf"\quad \text{{{names}}}" if names else ""))
    return step(_("How it was solved"), text, *lines)


def _geometry(closed_form: str | None, method: str) -> tuple[str, str]:
    """Return why there is a solution in closed form, or that there is none, and the equation that fixes a joint."""
    if closed_form in {"spherical wrist", "spherical shoulder"}:
        text = _("Three axes meet in a point that their angles do not move: the other three joints must bring it here.")
        return text, r"p_w(q) = p - R\, w"
    if closed_form == "spherical shoulder and wrist":
        text = _("Shoulder and wrist are points, whose distance fixes the elbow; its turn about their line is free.")
        return text, r"\lVert p_w - p_s \rVert^2 = l_1^2 + l_2^2 + 2 l_1 l_2 \cos \psi_4"
    if closed_form is None:
        text = _("An iteration from a first guess found these numbers ({method}); `trace` shows all of it.")
        return text.format(method=method), ""
    if closed_form.startswith("six"):
        return _("This arm has no solution by hand: all joints but one are eliminated, or solutions are followed."), ""
    return _("The geometry of the axes gives the angles one by one, but not by the lecture's formulas."), ""
