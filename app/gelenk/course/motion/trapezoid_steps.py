"""Worked solutions of trapezoidal velocity profiles, in the notation of the lecture."""

from collections.abc import Sequence

import numpy as np

from gelenk.course.motion.time_law_steps import SHOWN_JOINTS, of_joint, tex_row
from gelenk.course.steps import Step, step, tex, tex_factor
from gelenk.language import translated as _
from gelenk.trajectory.joints.parabolic_blends import Blends
from gelenk.trajectory.laws.trapezoid import JointMove, PointToPoint, Profile


def trapezoid_steps(tasks: Sequence[JointMove], found: PointToPoint) -> tuple[Step, ...]:
    """Return the steps of the profile of each joint, and those that synchronise the joints."""
    joints = len(tasks)
    steps = [
        of_joint(_rest(task, own) if task.is_at_rest else _moving(task, own), j, joints)
        for j, (task, own) in enumerate(zip(tasks[:SHOWN_JOINTS], found.own, strict=False))
    ]
    if joints > 1:
        durations = [own.duration for own in found.own]
        slowest = rf"T = \max_j T_j = \max({', '.join(map(tex, durations))}) = {tex(max(durations))}"
        steps.append(step(_("Slowest joint"), _("It sets the time for all."), slowest))
    for j, factor in enumerate(found.factors[:SHOWN_JOINTS]):
        profile = found.profiles[j]
        if factor is None and tasks[j].distance != 0.0:
            steps.append(of_joint(_given(tasks[j], profile, found.motion.duration), j, joints))
        elif factor is not None and factor > 1.0:
            v, a = tex(abs(profile.peak_velocity)), tex(profile.acceleration)
            slowed = step(
                _("In step"),
                _("Slowed uniformly: v/k, a/k²."),
                rf"k = \frac{{T}}{{T_j}} = {tex(factor)}",
                rf"v = \frac{{v_p}}{{k}} = {v},\quad a = \frac{{a}}{{k^2}} = {a}",
            )
            steps.append(of_joint(slowed, j, joints))
    if joints == 1 and found.factors[0] is not None and found.motion.duration > 0.0:
        steps.append(_pieces(found.profiles[0]))
    return tuple(steps)


def _rest(task: JointMove, own: Profile) -> Step:
    """Return the step from rest to rest: with a coast, or without one if L ≤ v²/a."""
    L, a, v = tex(abs(task.distance)), tex(task.acceleration), tex(task.max_velocity)
    reach = task.max_velocity**2 / task.acceleration
    if own.duration == 0.0:
        return step(_("Nothing to move"), _("L = 0: nothing moves, T = 0."), r"L = 0 \Rightarrow T = 0")
    if own.coast > 0.0:
        quotient = rf"\frac{{{L} \cdot {a} + {v}^2}}{{{a} \cdot {v}}} = {tex(own.duration)}"
        return step(
            _("With a coast"),
            _("L > v²/a: the limit of the velocity is reached."),
            rf"L = {L} > \frac{{v^2}}{{a}} = {tex(reach)}",
            rf"T_s = \frac{{v}}{{a}} = \frac{{{v}}}{{{a}}} = {tex(own.first)}",
            rf"T = \frac{{L a + v^2}}{{a v}} = {quotient}",
        )
    compared = (rf"L = {L} \le \frac{{v^2}}{{a}} = {tex(reach)}",) if np.isfinite(reach) else ()
    return step(
        _("Without a coast"),
        _("L ≤ v²/a: half of the length speeding up, half of it braking."),
        *compared,
        rf"T_s = \sqrt{{\frac{{L}}{{a}}}} = {tex(own.first)},\quad T = 2 T_s = {tex(own.duration)}",
        rf"v_p = \sqrt{{L a}} = {tex(abs(own.peak_velocity))}",
    )


def _moving(task: JointMove, own: Profile) -> Step:
    """Return the step with nonzero end velocities."""
    v_p, a = tex(own.peak_velocity), tex_factor(task.acceleration)
    text = _("v_p is what the length allows, at most the limit.")
    if own.reverses:
        text = _(
            "v_p is what the length allows, at most the limit. The ends' velocities already carry the joint too far: "
            "it turns back."
        )
    sign = "" if own.peak_velocity >= 0.0 else "-"
    limit = f"{tex(task.max_velocity)},\\ " if np.isfinite(task.max_velocity) else ""
    root = rf"\sqrt{{{sign}a L + \frac{{v_i^2 + v_f^2}}{{2}}}}"

    def ramp(end: str, velocity: float) -> str:
        return rf"\frac{{|v_p - v_{end}|}}{{a}} = \frac{{|{v_p} - {tex_factor(velocity)}|}}{{{a}}}"

    return step(
        _("With end velocities"),
        text,
        rf"v_p = {sign}\min\left({limit}{root}\right) = {v_p}",
        rf"t_a = {ramp('i', own.start_velocity)} = {tex(own.first)}",
        rf"t_d = {ramp('f', own.end_velocity)} = {tex(own.last)}",
        rf"t_c = {tex(own.coast)},\quad T = t_a + t_c + t_d = {tex(own.duration)}",
    )


def _given(task: JointMove, profile: Profile, duration: float) -> Step:
    """Return the step for a given time, with the acceleration kept."""
    if not task.is_at_rest:
        text = _("The acceleration is kept; the coasting velocity follows from the distance, which grows with it.")
        return step(_("In the given time"), text, rf"T = {tex(duration)},\quad v_p = {tex(profile.peak_velocity)}")
    L, a, T = tex(abs(task.distance)), tex(task.acceleration), tex(duration)
    shortest = 2.0 * np.sqrt(abs(task.distance) / task.acceleration)
    root = rf"\sqrt{{{T}^2 - 4 \cdot {L} / {a}}}"
    return step(
        _("In the given time"),
        _("The acceleration is kept: L = a T_s (T - T_s), of whose roots the smaller one counts."),
        rf"T \ge 2\sqrt{{\frac{{L}}{{a}}}} = {tex(shortest)}",
        rf"T_s = \frac{{T - \sqrt{{T^2 - 4 L / a}}}}{{2}} = \frac{{{T} - {root}}}{{2}} = {tex(profile.first)}",
        rf"v = a\,T_s = {tex(abs(profile.peak_velocity))}",
    )


def _pieces(profile: Profile) -> Step:
    """Return the step with σ(t) along the path, from rest to rest."""
    if profile.start_velocity != 0.0 or profile.end_velocity != 0.0:
        return step(_("Velocity"), _("A trapezoid over time."), r"\dot\sigma: v_i \to v_p \to v_p \to v_f")
    if profile.coast == 0.0:
        return step(
            _("The two pieces"),
            _("Speeding up to v_p, and braking at once."),
            r"\sigma(t) = \frac{a t^2}{2},\quad 0 \le t \le T_s",
            r"\sigma(t) = L - \frac{a (t - T)^2}{2},\quad T_s \le t \le T",
        )
    return step(
        _("The three pieces"),
        _("Speeding up, coasting, braking; each joins the next one with its velocity."),
        r"\sigma(t) = \frac{a t^2}{2},\quad 0 \le t \le T_s",
        r"\sigma(t) = v t - \frac{v^2}{2 a},\quad T_s \le t \le T - T_s",
        r"\sigma(t) = -\frac{a (t - T)^2}{2} + v T - \frac{v^2}{a},\quad T - T_s \le t \le T",
    )


def blend_steps(found: Blends) -> tuple[Step, ...]:
    """Return the steps of straight segments with parabolic blends, joint by joint."""
    joints = found.velocities.shape[1]
    segments = step(
        _("Straight segments with parabolic blends"),
        _(
            "A via point's blend lies half before and half after its time; those of both ends lie within the motion, "
            "so that the line of an end segment leads through the middle of its end blend."
        ),
        r"v_k = \frac{q_{k+1} - q_k}{h_k},\quad v_1 = \frac{q_2 - q_1}{h_1 - t_1/2},\quad "
        r"v_{N-1} = \frac{q_N - q_{N-1}}{h_{N-1} - t_N/2}",
        r"a_k t_k = v_k - v_{k-1}",
    )
    rows = {
        "v": found.velocities,
        "a": found.accelerations,
        "t": found.durations,
        r"\frac{|\Delta v_k| t_k}{8}": found.deviations,
    }
    text = _("Velocities, accelerations, blend times, and by how much the points are passed.")
    numbers = (
        step(_("Numbers"), text, *(rf"{symbol} = ({tex_row(values[:, j])})" for symbol, values in rows.items()))
        for j in range(min(joints, SHOWN_JOINTS))
    )
    return (segments, *(of_joint(one, j, joints) for j, one in enumerate(numbers)))
