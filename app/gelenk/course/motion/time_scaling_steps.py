"""Worked solution of a uniform time scaling."""

from gelenk.course.steps import Step, step, tex
from gelenk.language import marked, translated as _
from gelenk.trajectory.laws.time_scaling import Bound, Quantity, Scaling

_SYMBOLS: dict[Quantity, tuple[str, str, str]] = {
    "velocity": (r"\dot q", "v", r"k_{\mathrm{vel}}"),
    "acceleration": (r"\ddot q", "a", r"k_{\mathrm{acc}}"),
    "jerk": (r"\dddot q", "j", r"k_{\mathrm{jerk}}"),
}
_TITLES: dict[Quantity, str] = {
    "velocity": marked("Velocity"),
    "acceleration": marked("Acceleration"),
    "jerk": marked("Jerk"),
}
_ROOTS: dict[Quantity, str] = {"velocity": "{}", "acceleration": r"\sqrt{{{}}}", "jerk": r"\sqrt[3]{{{}}}"}


def scaling_steps(scaling: Scaling, duration: float) -> tuple[Step, ...]:
    """Return the worked steps: ratios, the course's k, and k without the 1; `duration` in [s]."""
    roots = ", ".join(_ROOTS[bound.quantity].format(_SYMBOLS[bound.quantity][2]) for bound in scaling.bounds)

    def largest(terms: str, k: float) -> tuple[str, str]:
        return rf"k = \max\{{{terms}\}} = {tex(k)}", rf"k T = {tex(k)} \cdot {tex(duration)} = {tex(k * duration)}"

    scaled = step(
        _("Scaling the time"),
        _("The same path in k times the time: each derivative is divided by k once more."),
        r"T \to k T:\quad \dot q \to \frac{\dot q}{k},\quad \ddot q \to \frac{\ddot q}{k^2}",
    )
    text = _("The 1 in the maximum lets it slow down alone.")
    course = step(_("k of the course"), text, *largest(f"1, {roots}", scaling.course_factor))
    steps = (scaled, *map(_ratio_step, scaling.bounds), course)
    if scaling.factor is None:
        return steps
    text = _(
        'It slows down or speeds up, until a limit is just reached. (The notes say "slow down or speed up" of the '
        "maximum with the 1, which only slows down.)"
    )
    return (*steps, step(_("k without the 1"), text, *largest(roots, scaling.factor)))


def _ratio_step(bound: Bound) -> Step:
    symbol, limit, name = _SYMBOLS[bound.quantity]
    j = bound.joint
    return step(
        _(_TITLES[bound.quantity]),
        _("The largest ratio of a peak to its limit: joint {joint}, at {time:.10g} s.").format(
            joint=j, time=bound.time
        ),
        rf"{name} = \max_j \frac{{\max_t |{symbol}_j|}}{{{limit}_{{\max,j}}}} = "
        rf"\frac{{|{symbol}_{{{j}}}|}}{{{limit}_{{\max,{j}}}}} = "
        rf"\frac{{{tex(abs(bound.peak))}}}{{{tex(bound.limit)}}} = {tex(bound.ratio)}",
    )
