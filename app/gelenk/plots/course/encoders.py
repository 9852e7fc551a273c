"""Encoders: the channels of an incremental one over the angle or its samples, and the disc of an absolute one."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Wedge

from gelenk.course.actuators.encoders import Code, gray
from gelenk.language import number, translated as _
from gelenk.plots import figure as style
from gelenk.plots.course.sketch import direction
from gelenk.plots.course.titles import TITLES
from gelenk.robot.arrays import Flags, Indices

MOST_TRACKS = 10
MOST_SAMPLES = 48
_APART = 0.2
"""Smallest angle between codes written around a disc, [rad]; of those closer together the first is written."""
_FORWARD = (0, 2, 3, 1)
"""States 2 A + B of the quarters of a line when the shaft turns forward."""


def tracks_figure(states: Sequence[int] | Indices | None = None, index: Sequence[bool] | Flags | None = None) -> Figure:
    """Draw the channels A, B and Z: of two lines turned forward, or of samples, each a state 2 A + B."""
    is_sampled = states is not None
    shown = np.array(_FORWARD * 2 if states is None else states)[:MOST_SAMPLES]
    pulses = np.arange(len(shown)) == 4 if not is_sampled else index
    channels = [("A", shown // 2, style.VELOCITY), ("B", shown % 2, style.FORCE)]
    if pulses is not None:
        channels.append(("Z", np.asarray(pulses)[: len(shown)].astype(int), style.INK))
    figure = style.new_figure(7.4, 3.2)
    style.write(figure, 0.03, 0.96, [_(TITLES["quadrature"])], size=style.TITLE)
    axes = figure.add_axes((0.06, 0.2, 0.91, 0.62))
    label = _("sample") if is_sampled else _("quarters of a line: x4 counts each edge, x2 those of A, x1 one of them")
    _draw_channels(axes, channels, shown, label)
    return figure


def _draw_channels(axes: Axes, channels: Sequence[tuple[str, Indices, str]], states: Indices, label: str) -> None:
    style.light_axes(axes, label, "")
    edges = np.arange(len(states) + 1)
    top = 1.4 * len(channels)
    for row, (name, levels, color) in enumerate(channels):
        base = top - 1.4 * (row + 1)
        axes.step(edges, base + np.append(levels, levels[-1]), where="post", color=color, linewidth=1.8)
        look: dict[str, Any] = {"color": color, "ha": "right", "va": "center", "transform": axes.get_yaxis_transform()}
        axes.text(-0.015, base + 0.5, name, fontproperties=style.font(bold=True), **look)
    size = 8.0 if len(states) <= MOST_SAMPLES // 2 else 5.5
    for i, state in enumerate(states):
        text = f"{state // 2}{state % 2}"
        axes.text(
            i + 0.5, top - 0.1, text, fontproperties=style.font(size), color=style.QUIET, ha="center", va="center"
        )
    axes.set_xlim(0.0, len(states))
    axes.set_ylim(-0.15, top + 0.15)
    axes.set_yticks([])
    axes.set_xticks(edges[:: max(1, len(states) // 12)])
    axes.spines["left"].set_visible(False)


def disc_figure(bits: int, code: Code = "gray", marked: Sequence[int] = ()) -> Figure:
    """Draw the disc of an absolute encoder with 1 to 10 tracks, the highest digit inside; `marked` are positions."""
    figure = style.new_figure(5.6, 6.2)
    name = _("Gray code") if code == "gray" else _("binary code")
    title = _("Absolute encoder: {code}, tracks: {bits}").format(code=name, bits=bits)
    style.write(figure, 0.04, 0.975, [title], size=style.TITLE)
    count = 1 << bits
    text = _("{count} positions of {angle}°; dark is 1, the highest digit is inside")
    style.write(figure, 0.04, 0.925, [text.format(count=count, angle=number(360.0 / count, ".6g"))], color=style.QUIET)
    axes = figure.add_axes((0.02, 0.02, 0.96, 0.86))
    axes.set_axis_off()
    axes.set_aspect("equal")
    style.look_at(axes, np.zeros(2), np.full(2, 1.25 + 0.04 * max(bits, 3)))
    codes = [gray(value) if code == "gray" else value for value in range(count)]
    width = 0.7 / bits
    for track in range(bits):
        digits = [(value >> (bits - 1 - track)) & 1 for value in codes]
        _draw_track(axes, digits, 0.3 + width * (track + 1), width)
    first, last = np.inf, -np.inf
    for value in sorted({*(range(count) if bits <= 4 else ()), *marked}):
        angle = 2.0 * np.pi * (value + 0.5) / count
        color = style.FORCE if value in marked else style.QUIET
        axes.plot(*(1.02 * direction(angle)), marker="o", markersize=2.5, color=color)
        if angle - last >= _APART and angle - first <= 2.0 * np.pi - _APART:
            _write_code(axes, f"{codes[value]:0{bits}b}", angle, color)
            first, last = min(first, angle), angle
    return figure


def _write_code(axes: Axes, code: str, angle: float, color: str) -> None:
    x, y = (1.07 * direction(angle)).tolist()
    ha = "center" if abs(x) < 0.3 else "left" if x > 0.0 else "right"
    axes.text(x, y, code, fontproperties=style.font(8.0), color=color, ha=ha, va="center")


def _draw_track(axes: Axes, digits: Sequence[int], outer: float, width: float) -> None:
    """Draw a ring, dark where a digit is 1; neighbours of the same digit are one sector."""
    count = len(digits)
    step = 360.0 / count
    changes = [i for i in range(count) if digits[i] != digits[i - 1]] or [0]
    for start, end in zip(changes, [*changes[1:], changes[0] + count], strict=True):
        face = style.INK if digits[start] else "white"
        sector = Wedge((0.0, 0.0), outer, start * step, end * step, width=width, facecolor=face)
        sector.set(edgecolor=style.LINK, linewidth=0.5)
        axes.add_patch(sector)
