"""The worked solution of a triangle."""

from collections.abc import Mapping
from typing import Final

from gelenk.course.steps import Step, step, tex
from gelenk.course.triangle.triangle import ANGLES, SIDES, SolvedTriangle, Triangle
from gelenk.language import translated as _

_ANGLE: Final = tuple(rf"\{name}" for name in ANGLES)


def triangle_steps(found: SolvedTriangle, parts: Mapping[str, float]) -> list[Step]:
    """Return the solution: what is given, the third side or angle, the other angles, and the check by coordinates."""
    steps = [_given(found, parts)]
    if found.case == "SAS":
        steps.append(_third_side(found))
    if found.case == "SSA":
        steps.append(_two_thirds(found))
    steps.append(_by_sines(found) if found.case in {"ASA", "AAS"} else _by_cosines(found))
    return [*steps, _check(found)]


def triangle_warnings(found: SolvedTriangle) -> list[str]:
    """Return warnings about flat triangles."""
    flat = any(triangle.is_flat for triangle in found.triangles)
    return [_("The triangle is flat: its corners are on one line.")] if flat else []


def _given(found: SolvedTriangle, parts: Mapping[str, float]) -> Step:
    texts = {
        "SSS": _("Three sides: each angle follows from the law of cosines."),
        "SAS": _("Two sides and the angle between them: the law of cosines gives the third side."),
        "SSA": _("Two sides and an angle that is not between them: there may be two triangles, one or none."),
        "ASA": _("A side and both angles at its ends: the third angle completes π, the law of sines gives the rest."),
        "AAS": _("A side, its angle and another: the third angle completes π, the law of sines gives the rest."),
    }
    names = dict(zip((*SIDES, *ANGLES), (*SIDES, *_ANGLE), strict=True))
    lines = [f"{names[name]} = {tex(value, 'm' if name in SIDES else 'rad')}" for name, value in parts.items()]
    return step(_("What is given"), texts[found.case], *lines)


def _cosines(i: int, j: int, k: int) -> str:
    return rf"{SIDES[k]}^2 = {SIDES[i]}^2 + {SIDES[j]}^2 - 2 {SIDES[i]} {SIDES[j]} \cos {_ANGLE[k]}"


def _third_side(found: SolvedTriangle) -> Step:
    i, j, k = found.roles
    (triangle,) = found.triangles
    text = _("Pythagoras with a correction for the angle, which is 0 at a right angle.")
    return step(_("Law of cosines"), text, _cosines(i, j, k), f"{SIDES[k]} = {tex(triangle.sides[k], 'm')}")


def _two_thirds(found: SolvedTriangle) -> Step:
    """Solve the law of cosines for the side that is not given: a quadratic equation."""
    k, j, m = found.roles
    triangle = found.triangles[0]
    a, b, c, alpha = SIDES[k], SIDES[j], SIDES[m], _ANGLE[k]
    root = rf"\sqrt{{{a}^2 - {b}^2 \sin^2 {alpha}}}"
    square = triangle.sides[k] ** 2 - (triangle.sides[j] * _sine(triangle, k)) ** 2
    lines = [
        _cosines(j, m, k),
        rf"{c} = {b} \cos {alpha} \pm {root}",
        rf"{a}^2 - {b}^2 \sin^2 {alpha} = {tex(max(0.0, square))}",
        *(f"{c}_{n} = {tex(each.sides[m], 'm')}" for n, each in enumerate(found.triangles, start=1)),
    ]
    one = _("Only one root is a positive length: one triangle.")
    two = _("Both roots are positive lengths: two triangles.")
    text = two if len(found.triangles) == 2 else one
    return step(_("Law of cosines"), text, *lines)


def _sine(triangle: Triangle, k: int) -> float:
    """Return the sine of an angle from the height: twice the area over the two sides beside it."""
    i, j = (n for n in range(3) if n != k)
    return 2.0 * triangle.area / (triangle.sides[i] * triangle.sides[j])


def _by_cosines(found: SolvedTriangle) -> Step:
    lines = []
    for number, triangle in enumerate(found.triangles, start=1):
        for k in range(3):
            i, j = (n for n in range(3) if n != k)
            a, b, c = (triangle.sides[n] for n in (i, j, k))
            name = _ANGLE[k] if len(found.triangles) == 1 else f"{_ANGLE[k]}_{number}"
            fraction = rf"\frac{{{SIDES[i]}^2 + {SIDES[j]}^2 - {SIDES[k]}^2}}{{2 {SIDES[i]} {SIDES[j]}}}"
            cosine = max(-1.0, min(1.0, (a * a + b * b - c * c) / (2.0 * a * b)))
            lines.append(
                rf"\cos {name} = {fraction} = {tex(cosine)} \;\Rightarrow\; {name} = {tex(triangle.angles[k], 'rad')}"
            )
    text = _("Solved for each angle. The cosine tells acute from obtuse angles, which the sine does not.")
    return step(_("Angles"), text, *lines)


def _by_sines(found: SolvedTriangle) -> Step:
    (triangle,) = found.triangles
    i, j, k = found.roles
    (free,) = (n for n, name in enumerate(ANGLES) if name not in found.given)
    total = " - ".join([r"\pi", *(_ANGLE[n] for n in range(3) if n != free)])
    lines = [f"{_ANGLE[free]} = {total} = {tex(triangle.angles[free], 'rad')}"]
    lines += [
        rf"{SIDES[n]} = {SIDES[i]} \frac{{\sin {_ANGLE[n]}}}{{\sin {_ANGLE[i]}}} = {tex(triangle.sides[n], 'm')}"
        for n in (j, k)
    ]
    return step(_("Law of sines"), _("Each side is as long as the sine of the angle opposite to it is large."), *lines)


def _check(found: SolvedTriangle) -> Step:
    lines = [
        rf"A = (0,\; 0), \quad B = ({tex(triangle.sides[2])},\; 0), \quad "
        rf"C = (b \cos \alpha,\; b \sin \alpha) = ({tex(float(x))},\; {tex(float(y))})"
        for triangle in found.triangles
        for x, y in (triangle.corners[2],)
    ]
    lines += [rf"\lVert C - B \rVert = {tex(triangle.sides[0], 'm')} = a" for triangle in found.triangles]
    return step(_("Check"), _("Corners put into the plane have the same distances and angles."), *lines)
