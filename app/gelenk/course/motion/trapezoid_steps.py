"""Worked solutions of trapezoidal velocity profiles, in the notation of the lecture."""

from collections.abc import Sequence

import numpy as np

from gelenk.course.motion.formulas import SHOWN_JOINTS, of_joint
from gelenk.course.steps import Step, tex, tex_factor
from gelenk.robot.arrays import Array
from gelenk.trajectory.joints.parabolic_blends import Blends
from gelenk.trajectory.laws.trapezoid import JointMove, PointToPoint, Profile


def trapezoid_steps(tasks: Sequence[JointMove], found: PointToPoint) -> tuple[Step, ...]:
    """Return the steps of the profile of each joint, and those that synchronise the joints."""
    steps, joints = [], len(tasks)
    planned = any(factor is None for factor in found.factors)
    for j, task in enumerate(tasks[:SHOWN_JOINTS]):
        own = _rest(task, found.own[j]) if task.is_at_rest else _moving(task, found.own[j])
        steps.append(of_joint(own, j, joints))
    if joints > 1:
        times = ", ".join(tex(own.duration) for own in found.own)
        slowest = rf"T = \max_j T_j = \max({times}) = {tex(max(own.duration for own in found.own))}"
        steps.append(Step("Slowest joint", "It sets the time for all.", (slowest,)))
    for j, factor in enumerate(found.factors[:SHOWN_JOINTS]):
        if factor is None and tasks[j].distance != 0.0:
            steps.append(of_joint(_given(tasks[j], found.profiles[j], found.motion.duration), j, joints))
        elif factor is not None and factor > 1.0:
            profile = found.profiles[j]
            formulas = (
                rf"k = \frac{{T}}{{T_j}} = {tex(factor)}",
                (
                    rf"v = \frac{{v_p}}{{k}} = {tex(abs(profile.peak_velocity))},\quad "
                    rf"a = \frac{{a}}{{k^2}} = {tex(profile.acceleration)}"
                ),
            )
            steps.append(of_joint(Step("In step", "Slowed uniformly: v/k, a/k².", formulas), j, joints))
    if not planned and joints == 1:
        steps.append(_three_pieces(found.profiles[0]))
    return tuple(steps)


def _rest(task: JointMove, own: Profile) -> Step:
    """Return the step from rest to rest: with a coast, or without one if L ≤ v²/a."""
    L, a = tex(abs(task.distance)), tex(task.acceleration)
    reach = task.max_velocity**2 / task.acceleration
    if own.duration == 0.0:
        return Step("Nothing to move", "L = 0: nothing moves, T = 0.", (r"L = 0 \Rightarrow T = 0",))
    if own.coast > 0.0:
        v = tex(task.max_velocity)
        return Step(
            "With a coast",
            "L > v²/a: the limit of the velocity is reached.",
            (
                rf"L = {L} > \frac{{v^2}}{{a}} = {tex(reach)}",
                rf"T_s = \frac{{v}}{{a}} = \frac{{{v}}}{{{a}}} = {tex(own.first)}",
                (
                    rf"T = \frac{{L a + v^2}}{{a v}} = \frac{{{L} \cdot {a} + {v}^2}}{{{a} \cdot {v}}} = "
                    rf"{tex(own.duration)}"
                ),
            ),
        )
    compared = (rf"L = {L} \le \frac{{v^2}}{{a}} = {tex(reach)}",) if np.isfinite(reach) else ()
    return Step(
        "Without a coast",
        "L ≤ v²/a: half of the length speeding up, half of it braking.",
        (
            *compared,
            rf"T_s = \sqrt{{\frac{{L}}{{a}}}} = {tex(own.first)},\quad T = 2 T_s = {tex(own.duration)}",
            rf"v_p = \sqrt{{L a}} = {tex(abs(own.peak_velocity))}",
        ),
    )


def _moving(task: JointMove, own: Profile) -> Step:
    """Return the step with nonzero end velocities."""
    v_i, v_f, a = (tex_factor(value) for value in (own.start_velocity, own.end_velocity, task.acceleration))
    text = "v_p is what the length allows, at most the limit. "
    if own.reverses:
        text += "The ends' velocities already carry the joint too far: it turns back."
    sign = "" if own.peak_velocity >= 0.0 else "-"
    limit = f"{tex(task.max_velocity)},\\ " if np.isfinite(task.max_velocity) else ""
    return Step(
        "With end velocities",
        text.strip(),
        (
            (
                rf"v_p = {sign}\min\left({limit}\sqrt{{{sign}a L + \frac{{v_i^2 + v_f^2}}{{2}}}}\right) = "
                rf"{tex(own.peak_velocity)}"
            ),
            rf"t_a = \frac{{|v_p - v_i|}}{{a}} = \frac{{|{tex(own.peak_velocity)} - {v_i}|}}{{{a}}} = {tex(own.first)}",
            rf"t_d = \frac{{|v_p - v_f|}}{{a}} = \frac{{|{tex(own.peak_velocity)} - {v_f}|}}{{{a}}} = {tex(own.last)}",
            rf"t_c = {tex(own.coast)},\quad T = t_a + t_c + t_d = {tex(own.duration)}",
        ),
    )


def _given(task: JointMove, profile: Profile, duration: float) -> Step:
    """Return the step for a given time, with the acceleration kept."""
    if not task.is_at_rest:
        text = "The acceleration is kept; the coasting velocity follows from the distance, which grows with it."
        return Step("In the given time", text, (rf"T = {tex(duration)},\quad v_p = {tex(profile.peak_velocity)}",))
    L, a, T = tex(abs(task.distance)), tex(task.acceleration), tex(duration)
    root = rf"\sqrt{{{T}^2 - 4 \cdot {L} / {a}}}"
    return Step(
        "In the given time",
        "The acceleration is kept: L = a T_s (T - T_s), of whose roots the smaller one counts.",
        (
            rf"T \ge 2\sqrt{{\frac{{L}}{{a}}}} = {tex(2.0 * np.sqrt(abs(task.distance) / task.acceleration))}",
            (
                rf"T_s = \frac{{T - \sqrt{{T^2 - 4 L / a}}}}{{2}} = \frac{{{T} - {root}}}{{2}} = "
                rf"{tex(profile.first)}"
            ),
            rf"v = a\,T_s = {tex(abs(profile.peak_velocity))}",
        ),
    )


def _three_pieces(profile: Profile) -> Step:
    """Return the step with σ(t) along the path, from rest to rest."""
    if profile.duration == 0.0 or profile.start_velocity != 0.0 or profile.end_velocity != 0.0:
        return Step("Velocity", "A trapezoid over time.", (r"\dot\sigma: v_i \to v_p \to v_p \to v_f",))
    return Step(
        "The three pieces",
        "Speeding up, coasting, braking; each joins the next one with its velocity.",
        (
            r"\sigma(t) = \frac{a t^2}{2},\quad 0 \le t \le T_s",
            r"\sigma(t) = v t - \frac{v^2}{2 a},\quad T_s \le t \le T - T_s",
            r"\sigma(t) = -\frac{a (t - T)^2}{2} + v T - \frac{v^2}{a},\quad T - T_s \le t \le T",
        ),
    )


def blend_steps(found: Blends) -> tuple[Step, ...]:
    """Return the steps of straight segments with parabolic blends, joint by joint."""
    joints = found.velocities.shape[1]
    steps = [
        Step(
            "Straight segments with parabolic blends",
            "A via point's blend lies half before and half after its time; those of both ends lie within the motion, "
            "so that the line of an end segment leads through the middle of its end blend.",
            (
                (
                    r"v_k = \frac{q_{k+1} - q_k}{h_k},\quad v_1 = \frac{q_2 - q_1}{h_1 - t_1/2},\quad "
                    r"v_{N-1} = \frac{q_N - q_{N-1}}{h_{N-1} - t_N/2}"
                ),
                r"a_k t_k = v_k - v_{k-1}",
            ),
        )
    ]
    for j in range(min(joints, SHOWN_JOINTS)):
        formulas = (
            rf"v = ({_row(found.velocities[:, j])})",
            rf"a = ({_row(found.accelerations[:, j])})",
            rf"t = ({_row(found.durations[:, j])})",
            rf"\frac{{|\Delta v_k| t_k}}{{8}} = ({_row(found.deviations[:, j])})",
        )
        text = "Velocities, accelerations, blend times, and by how much the points are passed."
        steps.append(of_joint(Step("Numbers", text, formulas), j, joints))
    return tuple(steps)


def _row(values: Array) -> str:
    shown = ", ".join(tex(float(value)) for value in values[:12])
    return shown if len(values) <= 12 else shown + r", \dots"
