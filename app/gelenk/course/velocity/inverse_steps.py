"""The worked solution of an inverse velocity: the equation, its inverse by cases, damping, null space, residual."""

from gelenk.course.steps import Step, step
from gelenk.course.velocity.damping_steps import damping_steps
from gelenk.course.velocity.inverse_question import InverseQuestion
from gelenk.course.velocity.null_space_steps import wish_steps
from gelenk.course.velocity.pseudo_inverse_steps import pseudo_inverse_steps
from gelenk.course.velocity.writing import largest, matrix, row
from gelenk.language import localised, translated as _

_B = ("v", r"\ddot r - \dot J \dot q", r"r^{(3)} - 2 \dot J \ddot q - \ddot J \dot q")
_V = ("v", r"\ddot r", "r^{(3)}")


def inverse_steps(question: InverseQuestion) -> list[Step]:
    """Return the worked solution."""
    steps = [_equation(question), _case(question)]
    if question.without_solution:
        return steps
    if not question.is_damped or question.wish is not None:
        steps += pseudo_inverse_steps(question.inverse)
        if question.inverse.J.shape[1] > question.inverse.rank:
            steps.append(_null_space(question))
    if question.is_damped:
        steps += damping_steps(question)
    if question.wish is not None:
        steps += wish_steps(question.wish, question.inverse.projector, question.inverse.J)
    return [*steps, _result(question)]


def _equation(question: InverseQuestion) -> Step:
    k, (x, v) = question.order - 1, question.symbols
    lines = [f"J = {matrix(question.inverse.J)}", f"{_V[k]} = {row(question.target)}", *question.known[1]]
    if k:
        lines.append(f"b = {_B[k]} = {row(question.b)}")
    lines.append(f"J {x} = {v}")
    text = (
        _("The tip's velocity is linear in the joint velocities.")
        if k == 0
        else _("What the known rates already make of it goes to the other side; the matrix is the same.")
    )
    if question.length is not None:
        scaled = _("Angular rows are multiplied by the length L = {length} m, so that all rows are in metres.")
        text += " " + scaled.format(length=localised(f"{question.length:.6g}"))
    elif question.mixes_units:
        text += " " + _(
            "Metres and radians are mixed: the lengths that are made least, and so the pseudo-inverse, depend on the "
            "unit of length."
        )
    return step(_("The equation"), text, *lines)


def _case(question: InverseQuestion) -> Step:
    inverse = question.inverse
    m, n = inverse.J.shape
    text = {
        "square": _("J is square and regular: there is exactly one solution."),
        "wide": _(
            "Fewer directions than joints, and full rank: there are infinitely many solutions, and the pseudo-inverse "
            "gives the shortest."
        ),
        "tall": _(
            "More directions than joints, and full rank: in general there is no solution, and the pseudo-inverse gives "
            "the least residual."
        ),
        "rank_deficient": _(
            "The rank is less than both numbers: a singular configuration. Of the least residual the pseudo-inverse "
            "gives the shortest solution, by the singular values that count."
        ),
    }[inverse.case]
    if question.without_solution:
        text = _("J⁻¹ does not exist: the matrix is singular here. The pseudo-inverse and damping give an answer.")
    matrix_name = r"J W^{-\frac{1}{2}}" if inverse.is_weighted else "J"
    shape = rf"m = {m},\quad n = {n},\quad \rho = \mathrm{{rank}}\, J = {inverse.rank}"
    return step(_("Which case"), text, shape, rf"\sigma({matrix_name}) = {row(inverse.factors[1])}")


def _null_space(question: InverseQuestion) -> Step:
    inverse, (x, v) = question.inverse, question.symbols
    n = inverse.J.shape[1]
    lines = [
        rf"\dim \ker J = n - \rho = {n - inverse.rank}",
        rf"P = I - J^{{\#}} J = {matrix(inverse.projector)}",
        rf"J P = 0,\quad {x} = J^{{\#}} {v} + P\, \xi",
    ]
    text = _("The projector onto the kernel of J: it lets through the joint motions that leave the tip as it is.")
    return step(_("Null space"), text, *lines)


def _result(question: InverseQuestion) -> Step:
    x, v = question.symbols
    found = question.solution()
    size = max(largest(question.target), largest(question.inverse.J) * largest(found))
    if question.wish is not None:
        text = _("The sum of both motions; the second one does not move the tip.")
    elif question.is_damped:
        text = _("The damped solution, and what the tip does not do of the wish.")
    else:
        text = _("The solution, and what the tip does not do of the wish.")
    name = r"J^{\#}" if not question.is_damped else r"J^{\#}_\lambda"
    first = (question.inverse.damped_inverse if question.is_damped else question.inverse.pseudo_inverse) @ question.b
    if question.wish is None:
        lines = [f"{x} = {name} {v} = {matrix(found)}"]
    else:
        added = question.wish.share * (question.inverse.projector @ question.wish.xi)
        lines = [rf"{x} = {name} {v} + P\, \xi = {matrix(first)} + {matrix(added, largest(first))} = {matrix(found)}"]
    lines.append(f"{v} - J {x} = {row(question.b - question.inverse.J @ found, size)}")
    return step(_("Result"), text, *lines)
