"""The table of kinematic pairs in space."""

from gelenk.course.mobility.pairs import KINDS, Space
from gelenk.course.steps import Step, step
from gelenk.exercises.exercise import Exercise
from gelenk.exercises.fields import VectorField
from gelenk.language import marked
from gelenk.language import translated as _


def pair_names() -> dict[str, str]:
    """Return the names of the kinds of pairs, in the current language."""
    return {
        "revolute": _("revolute"),
        "prismatic": _("prismatic"),
        "screw": _("screw"),
        "universal": _("universal"),
        "cylindrical": _("cylindrical"),
        "spherical": _("spherical"),
        "planar": _("planar"),
        "sphere_in_groove": _("sphere in a groove"),
        "point_contact": _("point contact"),
    }


def _constraints(kinds: tuple[str, ...], space: Space = "spatial") -> list[int]:
    return [KINDS[kind].constraints(space) or 0 for kind in kinds]


def _table_steps(kinds: tuple[str, ...]) -> list[Step]:
    names = pair_names()
    formulas = [rf"c_{i} = 6 - {6 - c} = {c}" for i, c in enumerate(_constraints(kinds), start=1)]
    text = _("A free body has 6 freedoms in space; the pairs are, in this order: {kinds}.")
    return [step(_("Freedoms that are left"), text.format(kinds=", ".join(names[kind] for kind in kinds)), *formulas)]


TABLE = Exercise(
    id="mobility.pairs",
    title=marked("Constraints of kinematic pairs"),
    difficulty=1,
    draw=lambda draw: tuple(
        draw.sample(("revolute", "prismatic", "screw", "universal", "cylindrical", "spherical", "planar",
                     "sphere_in_groove", "point_contact"), 5)
    ),
    is_degenerate=lambda kinds: len(set(_constraints(kinds))) < 4,
    text=lambda kinds: _(
        "How many of the 6 freedoms of a body in space does each of these pairs remove? In this order: {kinds}."
    ).format(kinds=", ".join(pair_names()[kind] for kind in kinds)),
    fields=lambda kinds: (VectorField(name="constraints", label=_("Constraints c of the pairs"), size=len(kinds)),),
    solve=lambda kinds: {"constraints": _constraints(kinds)},
    steps=_table_steps,
    wrong={
        "freedoms_for_constraints": lambda kinds: {"constraints": [6 - c for c in _constraints(kinds)]},
        "universal_as_two": lambda kinds: {"constraints": _table_with(kinds, universal=5)},
        "spherical_as_universal": lambda kinds: {"constraints": _table_with(kinds, spherical=4)},
        "plane_for_space": lambda kinds: {"constraints": [c - 3 for c in _constraints(kinds)]},
    },
)  # fmt: skip


def _table_with(kinds: tuple[str, ...], **other: int) -> list[int]:
    return [other.get(kind, c) for kind, c in zip(kinds, _constraints(kinds), strict=True)]


EXERCISES = (TABLE,)
