"""An exam: a platform on legs."""

from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

from gelenk.course.mobility.mechanism import GivenPair, Mechanism, mechanism
from gelenk.course.mobility.mobility import tally
from gelenk.course.mobility.pairs import FREEDOMS, KINDS
from gelenk.course.mobility.steps import steps as mobility_steps
from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import whole
from gelenk.exercises.lectures.mobility.pairs import pair_names
from gelenk.language import marked
from gelenk.language import translated as _


class Platform(NamedTuple):
    """A platform on equal legs; `leg` has the pairs of each from the ground up."""

    legs: int
    leg: tuple[str, ...]

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


_LETTERS = {"prismatic": "P", "revolute": "R", "universal": "U", "spherical": "S", "cylindrical": "C"}
_LEGS: tuple[tuple[str, ...], ...] = (
    ("universal", "prismatic", "spherical"),
    ("spherical", "prismatic", "spherical"),
    ("revolute", "prismatic", "spherical"),
    ("revolute", "revolute", "spherical"),
    ("prismatic", "spherical", "spherical"),
    ("revolute", "spherical", "spherical"),
    ("prismatic", "universal", "spherical"),
    ("cylindrical", "prismatic", "spherical"),
)


def _platform_text(numbers: Platform) -> str:
    names = pair_names()
    return _(
        "A platform rests on {legs} equal legs of type {letters}: from the ground to the platform each has these "
        "pairs: {pairs}. Ground, platform and the links between the pairs of the legs are the links.\n\n"
        "Count the links n and the pairs j, the constraints Σc, and the mobility M by the formula of Grübler and "
        "Kutzbach. How many freedoms are idle, because a part spins between two spherical joints and moves nothing "
        "else? What mobility remains without them?"
    ).format(
        legs=numbers.legs,
        letters="".join(_LETTERS[kind] for kind in numbers.leg),
        pairs=", ".join(names[kind] for kind in numbers.leg),
    )


def _platform_fields(_numbers: Platform) -> tuple[AnswerField, ...]:
    return (
        whole("links", _("Links n")),
        whole("pairs", _("Pairs j")),
        whole("constraints", _("Constraints Σc")),
        whole("mobility", _("Mobility M"), 2.0),
        whole("idle", _("Idle freedoms")),
        whole("remaining", _("Mobility without idle freedoms")),
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
    draw=lambda draw: Platform(draw.integer(3, 6), draw.choice(_LEGS)),
    text=_platform_text,
    fields=_platform_fields,
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

EXERCISES = (PLATFORM,)
