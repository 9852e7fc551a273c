"""A DC motor: its circuit with the shaft, and its torque-speed line with the operating point."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gelenk.course.actuators.dc_motor import Motor, operating_point, torque_speed_line
from gelenk.language import number, translated as _
from gelenk.plots import figure as style
from gelenk.plots.course.sketch import Sketch, arc
from gelenk.plots.course.titles import TITLES


def circuit_figure() -> Figure:
    """Draw the circuit of a DC motor, V, R, L and the back-EMF, and its shaft with J, b and the load."""
    sketch = Sketch(7.0, 3.1)
    sketch.write(_(TITLES["dc-motor"]), (0.2, 2.85), size=style.TITLE, ha="left")
    _draw_circuit(sketch)
    return sketch.figure()


def motor_figure(motor: Motor, voltage: float, load_torque: float) -> Figure:
    """Draw the circuit of a motor with its values, and below it the torque-speed line at a voltage, [V]."""
    sketch = Sketch(7.0, 6.4)
    _draw_circuit(sketch, 3.7, motor, voltage, load_torque)
    figure = sketch.figure()
    axes = figure.add_axes((0.13, 0.1, 0.8, 0.42))
    _draw_line(axes, motor, voltage, load_torque)
    return figure


def _draw_circuit(
    sketch: Sketch, bottom: float = 0.0, motor: Motor | None = None, voltage: float = 0.0, load: float = 0.0
) -> None:
    low, high = bottom + 0.45, bottom + 2.05
    left, right = 0.8, 3.6
    middle = (low + high) / 2.0
    coil = np.concatenate([arc((2.35 + 0.16 * i, high), 0.08, np.pi, 0.0) for i in range(4)])
    sketch.line([(left, middle + 0.22), (left, high), (1.2, high)])
    sketch.line([(1.75, high), *coil, (right, high), (right, middle + 0.36)])
    sketch.line([(right, middle - 0.36), (right, low), (left, low), (left, middle - 0.22)])
    sketch.shape([(1.2, high - 0.1), (1.75, high - 0.1), (1.75, high + 0.1), (1.2, high + 0.1)])
    sketch.disc((left, middle), 0.22)
    sketch.write("+", (left, middle + 0.1))
    sketch.write("−", (left, middle - 0.1))
    sketch.shape([(right - 0.1, middle - 0.46), (right + 0.1, middle - 0.46), (right + 0.1, middle + 0.46),
                  (right - 0.1, middle + 0.46)], face=style.INK)  # fmt: skip
    sketch.disc((right, middle), 0.36, order=3.5)
    sketch.write("M", (right, middle), bold=True)
    sketch.arrow((1.85, low), (2.25, low), color=style.FORCE)
    sketch.label("$i$", (2.05, low), (0.0, -1.0), color=style.FORCE)
    sketch.arrow((right - 0.5, middle - 0.4), (right - 0.5, middle + 0.4), color=style.VELOCITY, width=1.0)
    sketch.label(r"$k_e\,\omega$", (right - 0.5, middle), (-1.0, 0.0), color=style.VELOCITY)
    _draw_shaft(sketch, right + 0.36, middle, motor, load)
    sketch.label(_valued("V", voltage, "V", motor), (left - 0.22, middle), (-1.0, 0.0))
    resistance, inductance = (motor.resistance, motor.inductance) if motor else (0.0, 0.0)
    sketch.label(_valued("R", resistance, "Ω", motor), (1.475, high + 0.1))
    sketch.label(_valued("L", inductance, "H", motor), (2.59, high + 0.08))


def _draw_shaft(sketch: Sketch, start: float, y: float, motor: Motor | None, load: float) -> None:
    inertia, friction = (motor.inertia, motor.viscous_friction) if motor else (0.0, 0.0)
    sketch.line([(start, y), (5.95, y)], color=style.LINK, width=5.0)
    sketch.shape([(4.75, y - 0.45), (5.0, y - 0.45), (5.0, y + 0.45), (4.75, y + 0.45)], face=style.RULE)
    sketch.label(_valued("J", inertia, "kg m²", motor), (4.875, y + 0.45))
    for side in (-0.09, 0.09):
        sketch.line([(5.3, y + side), (5.6, y + side)])
    sketch.hatch((5.3, y - 0.16), (5.6, y - 0.16))
    sketch.label(_valued("b", friction, "N m s/rad", motor), (5.45, y - 0.25), (0.0, -1.0))
    for x, sense, color, name in ((4.35, 1.0, style.VELOCITY, r"$\omega,\ k_t i$"), (5.85, -1.0, style.FORCE, "")):
        s = np.linspace(-2.2, 2.2, 40) * sense
        sketch.arrow(*np.column_stack((x + 0.1 * np.cos(s), y + 0.3 * np.sin(s))), color=color)
        text = name or _valued(r"\tau_L", load, "N m", motor)
        sketch.label(text, (x, y + 0.3), (0.0, 1.0), color=color)


def _valued(symbol: str, value: float, unit: str, motor: Motor | None) -> str:
    """Return the symbol of a quantity, with its value if there is a motor."""
    return f"${symbol}$" if motor is None else f"${symbol}$ = {number(value)} {unit}".replace("-", "−")


def _draw_line(axes: Axes, motor: Motor, voltage: float, load: float) -> None:
    line, point = torque_speed_line(motor, voltage), operating_point(motor, voltage, load)
    no_load, stall = line.no_load_angular_velocity, line.stall_torque
    style.light_axes(axes, _("load torque / (N m)"), _("speed / (rad/s)"))
    torques = np.array(sorted({0.0, stall, load}))
    slope = -motor.resistance / motor.stiffness
    axes.plot(torques, no_load + slope * torques, color=style.VELOCITY, linewidth=1.8)
    axes.axhline(0.0, color=style.QUIET, linewidth=0.8)
    axes.plot([load, load], [0.0, point.angular_velocity], color=style.FORCE, linewidth=1.0, linestyle="--")
    for x, y, color in ((0.0, no_load, "white"), (stall, 0.0, "white"), (load, point.angular_velocity, style.FORCE)):
        axes.plot(x, y, "o", markersize=6.0, color=color, markeredgecolor=style.INK, zorder=4)
    axes.margins(x=0.05, y=0.12)
    texts = (
        _("no load: {speed} rad/s").format(speed=number(no_load)),
        _("stall: {torque} N m, {current} A").format(torque=number(stall), current=number(line.stall_current)),
        _("at the load: {speed} rad/s, {current} A").format(
            speed=number(point.angular_velocity), current=number(point.current)
        ),
    )
    axes.set_title("   ·   ".join(texts), fontproperties=style.font(), color=style.INK, loc="left")
