"""The table of kinematic pairs in space, and an exam: a platform on legs."""

from collections.abc import Mapping
from functools import lru_cache
from typing import Annotated, NamedTuple

from gelenk.course.mobility.mechanism import GivenPair, Mechanism, mechanism
from gelenk.course.mobility.mobility import tally
from gelenk.course.mobility.pairs import FREEDOMS, KINDS, Space
from gelenk.course.mobility.steps import steps as mobility_steps
from gelenk.course.steps import Step, step
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import VectorField, whole
from gelenk.language import marked, translated as _


def _constraints(kinds: tuple[str, ...], space: Space = "spatial") -> list[int]:
    return [KINDS[kind].constraints(space) or 0 for kind in kinds]


def _table_steps(kinds: tuple[str, ...]) -> list[Step]:
    formulas = [rf"c_{i} = 6 - {6 - c} = {c}" for i, c in enumerate(_constraints(kinds), start=1)]
    text = _("A free body has 6 freedoms in space; the pairs are, in this order: {kinds}.")
    return [
        step(_("Freedoms that are left"), text.format(kinds=", ".join(KINDS[kind].name for kind in kinds)), *formulas)
    ]


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
    ).format(kinds=", ".join(KINDS[kind].name for kind in kinds)),
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


_KINDS = {"P": "prismatic", "R": "revolute", "U": "universal", "S": "spherical", "C": "cylindrical"}
_LEGS = tuple(
    tuple(_KINDS[letter] for letter in leg) for leg in ["UPS", "SPS", "RPS", "RRS", "PSS", "RSS", "PUS", "CPS"]
)


class Platform(NamedTuple):
    """A platform on equal legs; `leg` has the pairs of each from the ground up."""

    legs: Annotated[int, Draw.integer, 3, 6]
    leg: Annotated[tuple[str, ...], Draw.choice, _LEGS]

    @property
    def mechanism(self) -> Mechanism:
        """All links and pairs."""
        links, given = ["ground", "platform"], []
        for i in range(self.legs):
            inner = [f"leg {i} link {k}" for k in range(len(self.leg) - 1)]
            ends = ["ground", *inner, "platform"]
            links += inner
            given += [GivenPair(f"{i}.{k}", ends[k], ends[k + 1], kind) for k, kind in enumerate(self.leg)]
        return mechanism("spatial", links, 0, given)


def _platform_text(numbers: Platform) -> str:
    return _(
        "A platform rests on {legs} equal legs of type {letters}: from the ground to the platform each has these "
        "pairs: {pairs}. Ground, platform and the links between the pairs of the legs are the links.\n\n"
        "Count the links n and the pairs j, the constraints Σc, and the mobility M by the formula of Grübler and "
        "Kutzbach. How many freedoms are idle, because a part spins between two spherical joints and moves nothing "
        "else? What mobility remains without them?"
    ).format(
        legs=numbers.legs,
        letters="".join(kind[0].upper() for kind in numbers.leg),
        pairs=", ".join(KINDS[kind].name for kind in numbers.leg),
    )


@lru_cache(maxsize=64)
def _platform_answers(numbers: Platform) -> Answers:
    counted, idle = tally(numbers.mechanism), len(numbers.mechanism.idle_spins())
    return {
        "links": counted.links,
        "pairs": counted.pairs,
        "constraints": counted.constraints,
        "mobility": counted.mobility,
        "idle": idle,
        "remaining": counted.mobility - idle,
    }


def _platform_with(numbers: Platform, change: Mapping[str, int]) -> Answers:
    right = {**_platform_answers(numbers), **change}
    mobility = FREEDOMS["spatial"] * (right["links"] - 1) - right["constraints"]
    return {**change, "mobility": mobility, "remaining": mobility - right["idle"]}


def _one_leg(numbers: Platform) -> Answers:
    right = _platform_answers(numbers)
    change = {name: right[name] // numbers.legs for name in ("pairs", "constraints")}
    return _platform_with(numbers, change | {"links": 1 + len(numbers.leg)})


def _kind_as(numbers: Platform, kind: str, constraints: int) -> Answers:
    count, right = numbers.legs * numbers.leg.count(kind), _platform_answers(numbers)
    change = count * (constraints - (KINDS[kind].constraints("spatial") or 0))
    return _platform_with(numbers, {"constraints": right["constraints"] + change})


PLATFORM = Exercise(
    id="mobility.platform",
    title=marked("Exam: a platform on legs"),
    difficulty=5,
    draw=drawn(Platform),
    text=_platform_text,
    fields=lambda _numbers: (
        whole("links", _("Links n")),
        whole("pairs", _("Pairs j")),
        whole("constraints", _("Constraints Σc")),
        whole("mobility", _("Mobility M"), 2.0),
        whole("idle", _("Idle freedoms")),
        whole("remaining", _("Mobility without idle freedoms")),
    ),
    solve=_platform_answers,
    steps=lambda one: mobility_steps(tally(one.mechanism), one.mechanism),
    wrong={
        "platform_forgotten": lambda one: _platform_with(one, {"links": _platform_answers(one)["links"] - 1}),
        "leg_counted_once": _one_leg,
        "freedoms_for_constraints": lambda one: _platform_with(
            one, {"constraints": 6 * _platform_answers(one)["pairs"] - _platform_answers(one)["constraints"]}
        ),
        "spherical_as_universal": lambda one: _kind_as(one, "spherical", 4),
        "idle_forgotten": lambda one: {"remaining": _platform_answers(one)["mobility"]},
        "idle_as_mobility": lambda one: {"remaining": _platform_answers(one)["idle"]},
        "ground_moves": lambda one: {"mobility": _platform_answers(one)["mobility"] + 6},
    },
)
