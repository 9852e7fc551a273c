"""Bang-coast-bang: speed up, coast, brake; of one joint, and of two in step."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.motion.trapezoid_steps import trapezoid_steps
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity, vector
from gelenk.language import marked, translated as _
from gelenk.trajectory.laws.trapezoid import JointMove, PointToPoint, Profile, fastest, point_to_point


class TrapezoidTask(NamedTuple):
    """A length, [m], with the limits of velocity and acceleration, and a time at which the place is asked for, [s]."""

    length: float
    velocity: float
    acceleration: float
    time: float

    @property
    def move(self) -> JointMove:
        """The motion, from rest to rest."""
        return JointMove(self.length, 0.0, 0.0, self.velocity, self.acceleration)

    @property
    def plan(self) -> PointToPoint:
        """The profile of the core."""
        return point_to_point(np.zeros(1), [self.move])

    @property
    def is_long(self) -> bool:
        """Whether it coasts."""
        return self.length > self.velocity**2 / self.acceleration

    def answers(self, ramp: float, total: float, peak: float) -> Answers:
        """Return answers from durations and the coasting speed, with the place while braking."""
        left = total - self.time
        return {"ramp": ramp, "total": total, "peak": peak, "place": self.length - 0.5 * self.acceleration * left**2}


def _draw_profile(draw: Draw) -> TrapezoidTask:
    limits = draw.decimal(0.4, 1.2, 0.1), draw.decimal(0.5, 2.5, 0.25)
    longest = limits[0] ** 2 / limits[1]
    length = draw.decimal(0.1, 3.0, 0.1)
    if draw.choice((True, False)):
        length = max(0.1, round(0.1 * int(10.0 * longest * 0.8), 1))
    return TrapezoidTask(length, *limits, draw.decimal(0.2, 8.0, 0.05))


def _is_useless_profile(one: TrapezoidTask) -> bool:
    """Check whether the two cases nearly meet, or the time is not well within the braking."""
    if abs(one.length - one.velocity**2 / one.acceleration) < 0.15 * one.length:
        return True
    found = fastest(one.move)
    braked = (one.time - found.duration + found.last) / found.last
    return not 0.15 < braked < 0.85


def _profile_answers(one: TrapezoidTask) -> Answers:
    plan = one.plan
    found, place = plan.own[0], plan.motion.at(np.array([one.time]))
    return {"ramp": found.first, "total": found.duration, "peak": found.peak_velocity, "place": float(place[0, 0])}


def _coast_assumed(one: TrapezoidTask) -> Answers:
    v, a = one.velocity, one.acceleration
    return one.answers(v / a, one.length / v + v / a, v)


def _coast_forgotten(one: TrapezoidTask) -> Answers:
    ramp = math.sqrt(one.length / one.acceleration)
    return one.answers(ramp, 2.0 * ramp, one.acceleration * ramp)


def _root_of_half(one: TrapezoidTask) -> Answers:
    if one.is_long:
        raise ValueError("it coasts")
    total = math.sqrt(0.5 * one.length / one.acceleration)
    return {"ramp": 0.5 * total, "total": total}


def _never_braked(one: TrapezoidTask) -> Answers:
    found = fastest(one.move)
    return {"place": found.peak_velocity * (one.time - 0.5 * found.first)}


PROFILE = Exercise(
    id="trajectories.profile",
    title=marked("Bang-coast-bang"),
    difficulty=2,
    draw=_draw_profile,
    is_degenerate=_is_useless_profile,
    text=lambda one: _(
        "A point has to move by L = {length:g} m from rest to rest in the shortest time, with at most {velocity:g} m/s "
        "and {acceleration:g} m/s². How long does it speed up, how long does it take in all, which speed does it "
        "reach, and how far has it come {time:g} s after the start, when it is already braking?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("ramp", _("Time of speeding up"), "s"),
        quantity("total", _("Time in all"), "s"),
        quantity("peak", _("Largest speed"), "m/s"),
        quantity("place", _("Way at that time"), "m"),
    ),
    solve=_profile_answers,
    steps=lambda one: trapezoid_steps([one.move], one.plan),
    wrong={
        "coast_assumed": _coast_assumed,
        "coast_forgotten": _coast_forgotten,
        "root_of_half": _root_of_half,
        "ramps_forgotten": lambda one: {"total": one.length / one.velocity},
        "ramps_added": lambda one: {"total": one.length / one.velocity + 2.0 * one.velocity / one.acceleration},
        "never_braked": _never_braked,
        "still_speeding_up": lambda one: {"place": 0.5 * one.acceleration * one.time**2},
    },
)


class PairTask(NamedTuple):
    """Displacements of two joints in degrees, with the limits of both in degrees per second and per second squared."""

    d1: Annotated[float, Draw.signed, 20.0, 120.0, 5.0]
    d2: Annotated[float, Draw.signed, 20.0, 120.0, 5.0]
    v1: Annotated[float, Draw.decimal, 30.0, 90.0, 10.0]
    v2: Annotated[float, Draw.decimal, 30.0, 90.0, 10.0]
    a1: Annotated[float, Draw.decimal, 40.0, 150.0, 10.0]
    a2: Annotated[float, Draw.decimal, 40.0, 150.0, 10.0]

    @property
    def moves(self) -> list[JointMove]:
        """The motions in degrees, from rest to rest."""
        return [JointMove(self.d1, 0.0, 0.0, self.v1, self.a1), JointMove(self.d2, 0.0, 0.0, self.v2, self.a2)]

    @property
    def plan(self) -> PointToPoint:
        """Both profiles of the core, in step."""
        return point_to_point(np.zeros(2), self.moves)

    @property
    def quick(self) -> int:
        """The joint that is slowed down, 0 or 1."""
        one, other = self.plan.own
        return 0 if one.duration < other.duration else 1

    @property
    def own(self) -> tuple[Profile, float]:
        """The quicker joint's own profile, and k."""
        own = self.plan.own
        return own[self.quick], own[1 - self.quick].duration / own[self.quick].duration


def _pair_answers(one: PairTask) -> Answers:
    plan, slowed = one.plan, one.plan.profiles[one.quick]
    return {
        "times": np.array([own.duration for own in plan.own]),
        "total": plan.motion.duration,
        "factor": one.own[1],
        "velocity": abs(slowed.peak_velocity),
        "acceleration": slowed.acceleration,
    }


def _limit_for_peak(one: PairTask) -> Answers:
    own, k = one.own
    if own.coast > 0.0:
        raise ValueError("it reaches its limit")
    return {"velocity": (one.v1, one.v2)[one.quick] / k}


def _pair_coasting(one: PairTask) -> Answers:
    times = [abs(move.distance) / move.max_velocity + move.max_velocity / move.acceleration for move in one.moves]
    return {"times": np.array(times), "total": max(times), "factor": max(times) / min(times)}


PAIR = Exercise(
    id="trajectories.pair",
    title=marked("Two joints in step"),
    difficulty=3,
    draw=drawn(PairTask),
    is_degenerate=lambda one: not 1.15 < one.own[1] < 3.0,
    text=lambda one: _(
        "Two joints move by {d1:g}° and {d2:g}° from rest to rest, by bang-coast-bang. Their limits are {v1:g}°/s and "
        "{v2:g}°/s, {a1:g}°/s² and {a2:g}°/s². How long would each take alone? Both have to start and end together in "
        "the shortest time, the quicker one slowed down uniformly: how long does the motion take, by which factor k is "
        "the quicker joint slower, and which largest speed and which acceleration has it then?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        vector("times", _("Times of both alone"), 2, "s", 2.0, within=0.01),
        quantity("total", _("Time of the motion"), "s"),
        quantity("factor", _("Factor k")),
        quantity("velocity", _("Largest speed of the quicker joint"), "°/s"),
        quantity("acceleration", _("Acceleration of the quicker joint"), "°/s²"),
    ),
    solve=_pair_answers,
    steps=lambda one: trapezoid_steps(one.moves, one.plan),
    wrong={
        "quickest_sets_time": lambda one: {"total": one.own[0].duration, "factor": 1.0 / one.own[1]},
        "acceleration_once": lambda one: {"acceleration": one.own[0].acceleration / one.own[1]},
        "not_slowed": lambda one: {
            "velocity": abs(one.own[0].peak_velocity),
            "acceleration": one.own[0].acceleration,
        },
        "limit_for_peak": _limit_for_peak,
        "coast_assumed": _pair_coasting,
        "times_added": lambda one: {"total": sum(own.duration for own in one.plan.own)},
    },
)
