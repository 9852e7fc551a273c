"""Pulse width modulation: the switched voltage with its averages, and the current with its ripple."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gelenk.course.actuators.pwm import Pulses
from gelenk.language import number, translated as _
from gelenk.plots import figure as style
from gelenk.robot.arrays import Array

_PERIODS = 3
_POINTS = 60
_UNITS = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))


def pulses_figure(pulses: Pulses, current: Sequence[float] | None = None, time_constant: float = 0.0) -> Figure:
    """Draw three periods of a supply.

    `current` is the lowest and the highest current in the steady state, [A], and where it would settle in a pulse and
    after it; `time_constant` is L/R, [s].
    """
    figure = style.new_figure(6.8, 3.4 if current is None else 5.2)
    period = 1.0 / pulses.frequency
    scale, unit = next((one for one in _UNITS if period >= one[0]), _UNITS[-1])
    bottom = 0.14 if current is None else 0.43
    above = figure.add_axes((0.15, bottom, 0.6, 0.82 - bottom))
    _draw_voltage(above, figure, pulses, period / scale, None if current is not None else _time(unit))
    _write_head(figure, pulses, scale, unit)
    if current is not None:
        below = figure.add_axes((0.15, 0.1, 0.6, 0.26))
        style.light_axes(below, _time(unit), "i / A")
        times, currents = _currents(pulses, current, time_constant)
        below.plot(times / scale, currents, color=style.FORCE, linewidth=1.6)
        below.set_xlim(0.0, _PERIODS * period / scale)
        low, high = current[:2]
        for value in (low, high):
            below.axhline(value, color=style.QUIET, linewidth=0.8, linestyle="--")
        lines = [
            r"$i_{\mathrm{max}}$ = " + f"{number(high, '.5g')} A",
            r"$i_{\mathrm{min}}$ = " + f"{number(low, '.5g')} A",
            r"$\Delta i$ = " + f"{number(high - low)} A",
        ]
        _beside(figure, 0.34, lines, style.FORCE)
    return figure


def _time(unit: str) -> str:
    return f"t / {unit}"


def _draw_voltage(axes: Axes, figure: Figure, pulses: Pulses, period: float, label: str | None) -> None:
    style.light_axes(axes, label, "v / V")
    corners = np.concatenate([[[k, 0], [k, 1], [k + pulses.duty, 1], [k + pulses.duty, 0]] for k in range(_PERIODS)])
    times = np.append(corners[:, 0], _PERIODS) * period
    axes.plot(times, np.append(corners[:, 1], 0.0) * pulses.high_voltage, color=style.INK, linewidth=1.6)
    means = ((pulses.average_voltage, style.VELOCITY, "-"), (pulses.rms_voltage, style.FORCE, "--"))
    for value, color, dashes in means:
        axes.axhline(value, color=color, linewidth=1.2, linestyle=dashes)
    axes.set_xlim(0.0, _PERIODS * period)
    axes.margins(y=0.15)
    lines = [r"$V_s$" + f" = {number(pulses.supply_voltage)} V"]
    _beside(figure, 0.8, lines, style.INK)
    _beside(figure, 0.73, [r"$V_{\mathrm{avg}}$" + f" = {number(pulses.average_voltage)} V"], style.VELOCITY)
    _beside(figure, 0.66, [r"$V_{\mathrm{rms}}$" + f" = {number(pulses.rms_voltage)} V"], style.FORCE)


def _write_head(figure: Figure, pulses: Pulses, scale: float, unit: str) -> None:
    title = _("Pulse width modulation with D = {duty}").format(duty=number(pulses.duty))
    style.write(figure, 0.03, 0.97, [title], size=style.TITLE)
    times = (1.0 / pulses.frequency / scale, pulses.on_time / scale, pulses.off_time / scale)
    period, on, off = (f"{number(time)} {unit}" for time in times)
    text = f"T = {period},  t_on = D T = {on},  t_off = {off}"
    style.write(figure, 0.03, 0.97 - 0.25 / figure.get_figheight(), [text], color=style.QUIET)


def _beside(figure: Figure, y: float, lines: Sequence[str], color: str) -> None:
    """Write lines at the right of the curves, in the colour of one."""
    figure.text(0.77, y, "\n".join(lines), fontproperties=style.font(), color=color, va="top", linespacing=1.8)


def _currents(pulses: Pulses, current: Sequence[float], time_constant: float) -> tuple[Array, Array]:
    """Return times and currents along the two exponentials of each period; shape (N,) each."""
    low, high, driven, idle = current
    start, end = (low, high) if driven >= idle else (high, low)
    times, currents = [], []
    for k in range(_PERIODS):
        for begin, length, first, settled in (
            (k / pulses.frequency, pulses.on_time, start, driven),
            (k / pulses.frequency + pulses.on_time, pulses.off_time, end, idle),
        ):
            s = np.linspace(0.0, length, _POINTS)
            decay = np.exp(-s / time_constant) if time_constant > 0.0 else np.zeros_like(s)
            times.append(begin + s)
            currents.append(settled + (first - settled) * decay)
    return np.concatenate(times), np.concatenate(currents)
