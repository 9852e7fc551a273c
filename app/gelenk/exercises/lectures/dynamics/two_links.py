"""Two links in a vertical plane: gravity, mass matrix, Coriolis terms, and all together."""

from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.writing import matrix, vector
from gelenk.dh.lagrangian.bodies import STANDARD_GRAVITY, LinkBody
from gelenk.dh.lagrangian.numeric import NumericMotion, numeric_motion
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import MatrixField, VectorField
from gelenk.exercises.lectures.dynamics.pendulum import FALL
from gelenk.exercises.table_field import table_of
from gelenk.language import marked, translated as _


class TwoBodies(NamedTuple):
    """Two links with masses, centres and inertias; angles in degrees, rates in rad/s and rad/s²."""

    length: Annotated[float, Draw.decimal, 0.4, 0.9, 0.1]
    m1: Annotated[float, Draw.decimal, 2.0, 6.0, 0.5]
    m2: Annotated[float, Draw.decimal, 1.0, 4.0, 0.5]
    c1: Annotated[float, Draw.decimal, 0.2, 0.35, 0.05]
    c2: Annotated[float, Draw.decimal, 0.15, 0.4, 0.05]
    i1: Annotated[float, Draw.decimal, 0.05, 0.3, 0.05]
    i2: Annotated[float, Draw.decimal, 0.02, 0.1, 0.02]
    q1: Annotated[float, Draw.signed, 15.0, 70.0, 5.0]
    q2: Annotated[float, Draw.signed, 30.0, 120.0, 5.0]
    v1: Annotated[float, Draw.signed, 0.5, 2.5, 0.5]
    v2: Annotated[float, Draw.signed, 0.5, 2.5, 0.5]
    a1: Annotated[float, Draw.signed, 1.0, 6.0, 1.0]
    a2: Annotated[float, Draw.signed, 1.0, 6.0, 1.0]

    @property
    def motion(self) -> NumericMotion:
        """The equations of motion of the core; how long the second link is does not matter."""
        table = table_of(np.array([[self.length, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]), (False, False))
        bodies = LinkBody(self.m1, self.c1, self.i1), LinkBody(self.m2, self.c2, self.i2)
        return numeric_motion(table, bodies, FALL, np.radians([self.q1, self.q2]), np.array([self.v1, self.v2]))

    def answers(self, *names: str) -> Answers:
        """Return some of all terms."""
        found = self.motion
        products = found.coriolis_vector
        speed = np.zeros(2) if products is None else products
        torque = found.mass_matrix @ np.array([self.a1, self.a2]) + speed + found.gravity_vector
        everything = {
            "mass": found.mass_matrix,
            "speed": speed,
            "gravity": found.gravity_vector,
            "torque": torque,
            "release": -np.linalg.solve(found.mass_matrix, found.gravity_vector),
        }
        return {name: everything[name] for name in names}

    @property
    def coupling(self) -> float:
        """H = m_2 a_1 l_c2 s_2."""
        return float(self.m2 * self.length * self.c2 * np.sin(np.radians(self.q2)))


def _is_useless(one: TwoBodies) -> bool:
    if abs(one.q2) == 90.0 or abs(one.v1 + one.v2) < 0.2 or abs(2.0 * one.v1 + one.v2) < 0.4:
        return True
    return any(float(np.abs(values).min()) < 0.15 for values in one.answers("gravity", "speed", "torque").values())


def _steps(one: TwoBodies) -> list[Step]:
    found = one.answers("mass", "speed", "gravity", "torque", "release")
    return [
        step(
            _("Mass matrix"),
            _("From the kinetic energy; the second link moves with both joints."),
            r"M_{11} = m_1 l_{c1}^2 + I_1 + m_2 (a_1^2 + l_{c2}^2 + 2 a_1 l_{c2} c_2) + I_2",
            r"M_{12} = m_2 (l_{c2}^2 + a_1 l_{c2} c_2) + I_2,\quad M_{22} = m_2 l_{c2}^2 + I_2",
            rf"M = {matrix(found['mass'])}",
        ),
        step(
            _("Coriolis and centrifugal torques"),
            _("From the derivatives of M by q2."),
            r"h = m_2 a_1 l_{c2} s_2",
            r"C \dot q = (-h (2 \dot q_1 \dot q_2 + \dot q_2^2),\; h \dot q_1^2) = " + vector(found["speed"]),
        ),
        step(
            _("Torques of gravity"),
            _("The slopes of the potential energy."),
            r"g_2 = m_2 g\,l_{c2} c_{12},\quad g_1 = (m_1 l_{c1} + m_2 a_1) g\,c_1 + g_2",
            rf"g(q) = {vector(found['gravity'])}",
        ),
        step(
            _("Equations of motion"),
            _("Inverse dynamics give the torques; from rest without torques the arm falls."),
            rf"\tau = M \ddot q + C \dot q + g = {vector(found['torque'])}",
            rf"\ddot q = -M^{{-1}} g = {vector(found['release'])}",
        ),
    ]


def _arm(one: TwoBodies) -> str:
    return _(
        "A planar arm moves in a vertical plane, y upwards; g = 9.81 m/s². The first link is {length:g} m long. The "
        "links have the masses {m1:g} kg and {m2:g} kg, their centres are {c1:g} m and {c2:g} m behind their joints, "
        "and their inertias about the centres are {i1:g} kg m² and {i2:g} kg m². It stands at q1 = {q1:g}°, "
        "q2 = {q2:g}°."
    ).format(**one._asdict())


def _moving(one: TwoBodies) -> str:
    return _(
        "It moves at {v1:g} rad/s and {v2:g} rad/s, with the accelerations {a1:g} rad/s² and {a2:g} rad/s²."
    ).format(**one._asdict())


def _text(one: TwoBodies, question: str) -> str:
    return "\n\n".join((f"{_arm(one)} {_moving(one)}", question))


def _vector(name: str, label: str, unit: str, points: float = 2.0) -> VectorField:
    return VectorField(name=name, label=label, unit=unit, tolerance=0.005, is_relative=True, size=2, points=points)


def _mass(points: float = 3.0) -> MatrixField:
    label = _("Mass matrix M")
    return MatrixField(name="mass", label=label, unit="kg m²", tolerance=0.005, is_relative=True, rows=2, columns=2,
                       points=points)  # fmt: skip


def _gravity_of(first: float, second: float) -> Answers:
    return {"gravity": np.array([first, second])}


def _own_angle(one: TwoBodies) -> Answers:
    second = one.m2 * STANDARD_GRAVITY * one.c2 * float(np.cos(np.radians(one.q2)))
    right = one.answers("gravity")["gravity"]
    return _gravity_of(float(right[0] - right[1]) + second, second)


def _second_link_unloaded(one: TwoBodies) -> Answers:
    first = one.m1 * STANDARD_GRAVITY * one.c1 * float(np.cos(np.radians(one.q1)))
    return _gravity_of(first, float(one.answers("gravity")["gravity"][1]))


GRAVITY = Exercise(
    id="dynamics.gravity",
    title=marked("Torques against gravity"),
    difficulty=2,
    draw=drawn(TwoBodies),
    is_degenerate=_is_useless,
    text=lambda one: _text(one, _("Which torques balance gravity?")),
    fields=lambda _one: (_vector("gravity", _("Torques against gravity"), "N m"),),
    solve=lambda one: one.answers("gravity"),
    steps=lambda one: _steps(one)[2:3],
    wrong={
        "angle_of_last_link": _own_angle,
        "second_link_forgotten": _second_link_unloaded,
        "center_for_length": lambda one: one._replace(length=one.c1).answers("gravity"),
    },
)


MASS = Exercise(
    id="dynamics.mass_matrix",
    title=marked("The mass matrix of two links"),
    difficulty=3,
    draw=drawn(TwoBodies),
    is_degenerate=_is_useless,
    text=lambda one: _text(one, _("What is its mass matrix?")),
    fields=lambda _one: (_mass(),),
    solve=lambda one: one.answers("mass"),
    steps=lambda one: _steps(one)[:1],
    wrong={
        "coupling_forgotten": lambda one: {"mass": np.diag(np.diag(one.answers("mass")["mass"]))},
        "own_inertia_forgotten": lambda one: one._replace(i1=0.0, i2=0.0).answers("mass"),
        "sine_in_mass": lambda one: one._replace(q2=90.0 - one.q2).answers("mass"),
        "second_inertia_once": lambda one: {"mass": one.answers("mass")["mass"] - np.diag([one.i2, 0.0])},
    },
)


def _speed_of(one: TwoBodies, first: float, second: float) -> Answers:
    return {"speed": one.coupling * np.array([first, second])}


SPEED = Exercise(
    id="dynamics.coriolis",
    title=marked("Coriolis and centrifugal torques"),
    difficulty=4,
    draw=drawn(TwoBodies),
    is_degenerate=_is_useless,
    text=lambda one: _text(one, _("How large are the Coriolis and centrifugal torques C q̇?")),
    fields=lambda _one: (_vector("speed", _("Torques C q̇"), "N m", 3.0),),
    solve=lambda one: one.answers("speed"),
    steps=lambda one: _steps(one)[:2],
    wrong={
        "two_of_coriolis": lambda one: _speed_of(one, -(one.v1 * one.v2 + one.v2**2), one.v1**2),
        "centrifugal_forgotten": lambda one: _speed_of(one, -2.0 * one.v1 * one.v2, 0.0),
        "coriolis_forgotten": lambda one: _speed_of(one, -(one.v2**2), one.v1**2),
    },
)


def _without(one: TwoBodies, name: str) -> Answers:
    right = one.answers("torque", name)
    return {"torque": right["torque"] - right[name]}


EXAM = Exercise(
    id="dynamics.equations",
    title=marked("Exam: the equations of motion of two links"),
    difficulty=5,
    draw=drawn(TwoBodies),
    is_degenerate=_is_useless,
    text=lambda one: _text(
        one,
        _(
            "What are the mass matrix, the torques C q̇, the torques against gravity, and the torques of the joints? "
            "With which accelerations does the arm begin to fall if it is released here at rest, without torques?"
        ),
    ),
    fields=lambda _one: (
        _mass(),
        _vector("speed", _("Torques C q̇"), "N m"),
        _vector("gravity", _("Torques against gravity"), "N m"),
        _vector("torque", _("Torques of the joints"), "N m"),
        _vector("release", _("Accelerations when released"), "rad/s²"),
    ),
    solve=lambda one: one.answers("mass", "speed", "gravity", "torque", "release"),
    steps=_steps,
    wrong={
        "coupling_forgotten": lambda one: {
            "mass": np.diag(np.diag(one.answers("mass")["mass"])),
            "release": -one.answers("gravity")["gravity"] / np.diag(one.answers("mass")["mass"]),
        },
        "two_of_coriolis": lambda one: _speed_of(one, -(one.v1 * one.v2 + one.v2**2), one.v1**2),
        "angle_of_last_link": _own_angle,
        "gravity_forgotten": lambda one: _without(one, "gravity"),
        "speeds_forgotten": lambda one: _without(one, "speed"),
    },
)
