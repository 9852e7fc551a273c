"""An exam: from the joints to a straight line of the tip, and back to the joints."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.cartesian.line import LineLaw, LineMotion, along_line
from gelenk.course.cartesian.line_steps import line_steps
from gelenk.course.cartesian.planar_line import PlanarLine
from gelenk.course.steps import Step, step, tex
from gelenk.course.writing import matrix, vector as written
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import VectorField, quantity, vector
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array


class PlannedTask(NamedTuple):
    """A planar arm that moves its tip along a line: lengths in metres, angles in degrees, limits per second."""

    l1: Annotated[float, Draw.decimal, 0.4, 1.0, 0.1]
    l2: Annotated[float, Draw.decimal, 0.4, 1.0, 0.1]
    q1: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 30.0, 120.0, 5.0]
    x: Annotated[float, Draw.signed, 0.1, 1.5, 0.1]
    y: Annotated[float, Draw.signed, 0.1, 1.5, 0.1]
    velocity: Annotated[float, Draw.decimal, 0.3, 0.9, 0.1]
    acceleration: Annotated[float, Draw.decimal, 0.5, 2.0, 0.5]
    joint_limit: Annotated[float, Draw.decimal, 0.2, 1.0, 0.1]

    @property
    def line(self) -> PlanarLine:
        """The line of the core, on the branch where the arm stands."""
        return PlanarLine((self.l1, self.l2), np.radians([self.q1, self.q2]), complex(self.x, self.y))

    @property
    def motion(self) -> LineMotion:
        """The tip's motion."""
        start = self.line.start
        return along_line(np.array([start.real, start.imag]), np.array([self.x, self.y]), self.law)

    @property
    def law(self) -> LineLaw:
        """Bang-coast-bang."""
        return LineLaw(self.velocity, self.acceleration)

    @property
    def tip_velocity(self) -> Array:
        """ṗ in the middle of the line, where the tip coasts; (2,), [m/s]."""
        found = self.motion
        return self.velocity / found.length * (found.end - found.start)

    def jacobian(self, q: Array) -> Array:
        """Return J of the tip's position at q, [rad]; (2, 2)."""
        s1, c1 = math.sin(q[0]), math.cos(q[0])
        s12, c12 = math.sin(q[0] + q[1]), math.cos(q[0] + q[1])
        first, second = np.array([-s1, c1]), np.array([-s12, c12])
        return np.column_stack((self.l1 * first + self.l2 * second, self.l2 * second))

    def slowed(self, q: Array, rates: Array, ratio: float | None = None) -> Answers:
        """Return the answers about the joints in the middle of the line, from q, [rad], and q̇, [rad/s]."""
        k = max(1.0, float(np.abs(rates).max()) / self.joint_limit if ratio is None else ratio)
        return {"joints": q, "rates": rates, "factor": k, "slowed": k * self.motion.law.duration}


def _is_useless_plan(one: PlannedTask) -> bool:
    """Check whether the line is short, leaves the reach or nears the base or a singularity, or nothing is slowed."""
    line = one.line
    if one.l1 == one.l2 or not 0.4 < line.length < 1.8 or line.length < 1.2 * one.velocity**2 / one.acceleration:
        return True
    q = line.configurations(np.linspace(0.0, 1.0, 9))
    if line.beyond is not None or np.isnan(q).any() or np.abs(np.sin(q[:, 1])).min() < 0.25:
        return True
    if np.abs(line.points(np.linspace(0.0, 1.0, 9))).min() < 0.25:
        return True
    return not 1.1 < _planned_answers(one)["factor"] < 3.0


def _planned_answers(one: PlannedTask) -> Answers:
    line, motion = one.line, one.motion
    q, first, _second, _third = (values[0] for values in line.derivatives(np.array([0.5])))
    total = motion.law.duration
    speed = float(motion.share.derivative().at(np.array([0.5 * total]))[0, 0])
    return {
        "start": motion.start,
        "length": motion.length,
        "total": total,
        **one.slowed(q, speed * first),
    }


def _absolute_angles(one: PlannedTask) -> Answers:
    other = one._replace(q2=one.q2 - one.q1)
    found = other.motion
    return {"start": found.start, "length": found.length, "total": found.law.duration}


def _flipped(one: PlannedTask) -> Answers:
    """The other branch: the same points, the elbow on the other side."""
    start = one.line.start
    q2 = -math.radians(one.q2)
    q1 = math.atan2(start.imag, start.real) - math.atan2(one.l2 * math.sin(q2), one.l1 + one.l2 * math.cos(q2))
    other = _planned_answers(one._replace(q1=math.degrees(q1), q2=-one.q2))
    return {name: other[name] for name in ("joints", "rates", "factor", "slowed")}


def _by(one: PlannedTask, other: Array) -> Answers:
    """Return the answers if a matrix took the place of the inverse of J."""
    right = _planned_answers(one)
    return one.slowed(right["joints"], other @ one.tip_velocity)


def _middle_of_joints(one: PlannedTask) -> Answers:
    """Halfway in joint space, which is not on the line."""
    q = one.line.configurations(np.array([0.0, 1.0])).mean(axis=0)
    return one.slowed(q, np.asarray(np.linalg.solve(one.jacobian(q), one.tip_velocity), float))


def _planned_steps(one: PlannedTask) -> list[Step]:
    found, line = _planned_answers(one), one.line
    q, J = found["joints"], one.jacobian(found["joints"])
    middle = complex(line.points(np.array([0.5]))[0])
    cosine = (abs(middle) ** 2 - one.l1**2 - one.l2**2) / (2.0 * one.l1 * one.l2)
    velocity = J @ found["rates"]
    return [
        step(
            _("Where the tip stands"),
            _("The second angle counts from the first link."),
            r"p_i = (l_1 c_1 + l_2 c_{12},\; l_1 s_1 + l_2 s_{12}) = " + written(found["start"]),
        ),
        *line_steps(one.motion, one.law),
        step(
            _("Joints in the middle"),
            _("The elbow stays on its side."),
            rf"p = {written(np.array([middle.real, middle.imag]))}",
            rf"c_2 = \frac{{x^2 + y^2 - l_1^2 - l_2^2}}{{2 l_1 l_2}} = {tex(cosine)}",
            rf"q_2 = {tex(float(q[1]), 'rad')}",
            rf"q_1 = \mathrm{{atan2}}(y, x) - \mathrm{{atan2}}(l_2 s_2, l_1 + l_2 c_2) = {tex(float(q[0]), 'rad')}",
        ),
        step(
            _("Velocities of the joints"),
            _("The tip coasts; the inverse of the Jacobian gives the joints."),
            rf"\dot p = {written(velocity)}",
            rf"J = {matrix(J)}",
            rf"\dot q = J^{{-1}} \dot p = {written(found['rates'])}",
        ),
        step(
            _("Slowed down"),
            _("The same path in k times the time divides all velocities by k."),
            rf"k = \max\left\{{1, \frac{{\max_j |\dot q_j|}}{{v_{{\max}}}}\right\}} = {tex(found['factor'])}",
            rf"k T = {tex(found['slowed'], 's')}",
        ),
    ]


PLANNED = Exercise(
    id="trajectories.planned",
    title=marked("Exam: a line of the tip and its joints"),
    difficulty=5,
    draw=drawn(PlannedTask),
    is_degenerate=_is_useless_plan,
    text=lambda one: _(
        "A planar arm with l1 = {l1:g} m, l2 = {l2:g} m stands at q1 = {q1:g}°, q2 = {q2:g}°. Its tip has to move on a "
        "straight line to ({x:g}, {y:g}) m, from rest to rest by bang-coast-bang with at most {velocity:g} m/s and "
        "{acceleration:g} m/s²; the elbow stays on its side.\n\n"
        "Where is the tip at first, how long is the line, and how long does the motion take? Which positions and "
        "velocities have the joints in the middle of the line? The joints allow {joint_limit:g} rad/s: by which factor "
        "k has the motion to be slowed down so that they keep this limit there, and how long does it take then?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        vector("start", _("Tip at the start"), 2, "m", 2.0, within=0.005),
        quantity("length", _("Length of the line"), "m"),
        quantity("total", _("Time in all"), "s"),
        VectorField(name="joints", label=_("Joints in the middle"), unit="rad", tolerance=0.01, size=2, points=3.0,
                    is_angle=True),
        vector("rates", _("Joint velocities in the middle"), 2, "rad/s", 3.0, within=0.01),
        quantity("factor", _("Factor k")),
        quantity("slowed", _("Time of the slowed motion"), "s"),
    ),
    solve=_planned_answers,
    steps=_planned_steps,
    wrong={
        "absolute_angles": _absolute_angles,
        "ramps_forgotten": lambda one: {"total": one.motion.length / one.velocity},
        "ramps_added": lambda one: {
            "total": one.motion.length / one.velocity + 2.0 * one.velocity / one.acceleration
        },
        "elbow_flipped": _flipped,
        "middle_of_joints": _middle_of_joints,
        "transpose_for_inverse": lambda one: _by(one, one.jacobian(_planned_answers(one)["joints"]).T),
        "direct_for_inverse": lambda one: _by(one, one.jacobian(_planned_answers(one)["joints"])),
        "smaller_ratio": lambda one: {
            "factor": float(np.abs(_planned_answers(one)["rates"]).min()) / one.joint_limit,
        },
        "time_divided": lambda one: {"slowed": one.motion.law.duration / _planned_answers(one)["factor"]},
    },
)  # fmt: skip
