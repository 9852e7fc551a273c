"""What the clearances of solutions say about them."""

from collections.abc import Sequence

from gelenk.course.steps import Step, step
from gelenk.course.writing import number
from gelenk.language import translated as _

_SHOWN = 8


def contact_step(clearances: Sequence[float], nearest: tuple[str, str], demanded: float, free: int) -> Step:
    """Return the step that tells solutions with contact from others.

    Args:
        clearances: Of each solution, the free ones first, or of the best that is known where none is sent, [m].
        nearest: The two nearest bodies at the first.
        demanded: Up to this clearance bodies count as in contact, [m].
        free: How many solutions are free.
    """
    text = _("The clearance d of a solution is that of its two nearest bodies; where it is negative, they overlap.")
    text += " " + _("At the first these are {a} and {b}.").format(a=nearest[0], b=nearest[1])
    if demanded > 0.0:
        text += " " + _("A solution must have more than the {d:g} m that are demanded.").format(d=demanded)
    if not free:
        text += " " + _("None of the solutions found is free of contact: they are no answer.")
    elif free < len(clearances):
        text += " " + _("Only those that are free of contact are answers; they come first.")
    lines = [rf"d_{{{i}}} = {number(d)}\,\mathrm{{m}}" for i, d in enumerate(clearances[:_SHOWN], 1)]
    return step(_("Contact"), text, *lines)
