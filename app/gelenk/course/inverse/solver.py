"""What the service did for an arm that nobody solves by hand."""

from gelenk.course.steps import Step, step
from gelenk.language import translated as _


def solver_step(closed_form: str | None, methods: set[str]) -> Step:
    """Return the step that says how solutions were found, by the name of the closed form and of the methods."""
    title = _("How it was solved")
    if closed_form is None:
        text = _("No formula by hand was used for this arm. The numbers come from an iteration: {methods}.")
        return step(title, text.format(methods=", ".join(sorted(methods)) or "auto"))
    return step(title, _("The geometry of this arm allows a closed form: {name}.").format(name=closed_form))
