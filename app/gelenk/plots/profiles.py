"""Picture of a motion over time: position, velocity, acceleration and jerk, with the limits as lines."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from gelenk.language import marked, translated as _
from gelenk.plots import figure as style
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_COLORS: Final = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6b4c9a", "#1f2933")
"""The colours of Okabe and Ito that are visible on white, and two more."""
_DASHES: Final[tuple[tuple[float, ...], ...]] = ((), (4.0, 1.5), (1.2, 1.2), (6.0, 1.5, 1.2, 1.5))
_POINTS = 600
_A_ROW = 4
_MARGIN = 0.06
_QUANTITIES: Final = (marked("position"), marked("velocity"), marked("acceleration"), marked("jerk"))
_FEW_PIECES = 30
_LIMIT_DASHES: Final = (0.0, (5.0, 3.0))
_ROOM = 0.012
"""Width of a character, as a fraction of a panel's width."""


@dataclass(frozen=True, slots=True)
class Span:
    """A part of the motion, [s], with its own limits of velocity, acceleration and jerk; shape (n,) each."""

    label: str
    start: float
    end: float
    limits: Sequence[Array]


@dataclass(frozen=True, slots=True)
class ProfileLines:
    """What is drawn in addition to the motion.

    Attributes:
        units: Units of position, velocity, acceleration and jerk.
        limits: Limits of velocity, acceleration and jerk; shape (n,) each, None for no limit.
        knots: Times and positions to mark; shapes (K,) and (K, n); None for none.
        spans: Consecutive parts whose limits replace `limits`; their ends are marked.
    """

    names: Sequence[str]
    units: Sequence[str]
    limits: Sequence[Array | None]
    knots: tuple[Array, Array] | None = None
    spans: Sequence[Span] = ()


def profiles_picture(title: str, motion: PiecewisePolynomial, lines: ProfileLines, kind: style.PictureFormat) -> bytes:
    """Draw the profiles of a motion, which gives positions over time."""
    joints = motion.coefficients.shape[2]
    rows = -(-joints // _A_ROW) if joints > 1 else 0
    height = 8.0 + rows * style.LINE
    figure = style.new_figure(7.2, height)
    style.write(figure, 0.03, 1.0 - 0.14 / height, [style.plain(title)], size=style.TITLE)
    top, bottom = 1.0 - (0.55 + rows * style.LINE) / height, 0.5 / height
    step = (top - bottom) / 4.0
    for order, name in enumerate(_QUANTITIES):
        axes = figure.add_axes((0.14, top - (order + 1) * step + 0.012, 0.825, step - 0.024))
        time_axes(axes, f"{_(name)}\n{_(lines.units[order])}", is_last=order == 3)
        _draw(axes, motion.derivative(order))
        if order > 0:
            _limit(axes, lines, order - 1)
        elif lines.knots is not None:
            _mark(axes, *lines.knots)
        _frame(axes, motion)
        _divide(axes, lines.spans, is_named=order == 0)
    if joints > 1:
        _legend(figure, lines.names, height)
    return style.as_bytes(figure, kind)


def _look(joint: int) -> tuple[str, tuple[float, ...]]:
    """Return colour and dashes of a joint; the dashes change when all colours have been used."""
    return _COLORS[joint % len(_COLORS)], _DASHES[joint // len(_COLORS) % len(_DASHES)]


def time_axes(axes: Axes, label: str, *, is_last: bool) -> None:
    """Style the axes of a quantity over time; only the last of several stacked panels has a label for the time."""
    style.light_axes(axes, "t / s" if is_last else None, label, size=8.0)
    axes.yaxis.set_label_coords(-0.09, 0.5)


def curve(motion: PiecewisePolynomial) -> tuple[Array, Array]:
    """Return times (N,), [s], and values (N, n) to plot: each piece with both ends, so that a jump is vertical."""
    pieces, degree = len(motion.breaks) - 1, motion.coefficients.shape[1] - 1
    count = 2 if degree == 0 else max(3, _POINTS // pieces)
    lengths = np.diff(motion.breaks)
    local = lengths[:, None] * np.linspace(0.0, 1.0, count)
    values = np.broadcast_to(motion.coefficients[:, -1:], (pieces, count, motion.coefficients.shape[2]))
    for k in range(degree - 1, -1, -1):
        values = values * local[:, :, None] + motion.coefficients[:, k : k + 1]
    return (motion.breaks[:-1, None] + local).ravel(), values.reshape(pieces * count, -1)


def _draw(axes: Axes, motion: PiecewisePolynomial) -> None:
    times, values = curve(_trimmed(motion))
    for j in range(values.shape[1]):
        color, dashes = _look(j)
        axes.plot(times, values[:, j], color=color, linewidth=1.5, dashes=dashes, zorder=3)


def _limit(axes: Axes, lines: ProfileLines, which: int) -> None:
    """Draw the limits of all joints in both directions, with one line for joints that share a limit."""
    look: dict[str, Any] = {"linewidth": 1.0, "linestyle": _LIMIT_DASHES, "zorder": 2}
    limit = lines.limits[which]
    if lines.spans:
        # NaN between two spans leaves a gap in the line.
        times = np.array([(span.start, span.end, np.nan) for span in lines.spans]).ravel()
        limits = np.repeat([span.limits[which] for span in lines.spans], 3, axis=0)
        for bound, color in _bounds(limits):
            for side in (bound, -bound):
                axes.plot(times, side, color=color, **look)
    elif limit is not None:
        for bound, color in _bounds(limit[None]):
            for height in (float(bound[0]), -float(bound[0])):
                axes.axhline(height, color=color, **look)


def _bounds(limits: Array) -> list[tuple[Array, str]]:
    """Return each distinct limit over time, and its colour; shared limits are grey; shape (K, n) → (K,) each."""
    found, joints, counts = np.unique(limits, axis=1, return_index=True, return_counts=True)
    return [
        (found[:, k], _look(int(joints[k]))[0] if counts[k] == 1 and limits.shape[1] > 1 else style.QUIET)
        for k in range(found.shape[1])
    ]


def _divide(axes: Axes, spans: Sequence[Span], *, is_named: bool) -> None:
    """Mark where one part ends and the next begins, and write each part's name above it if there is room."""
    whole = spans[-1].end - spans[0].start if spans else 0.0
    for span in spans[1:]:
        axes.axvline(span.start, color=style.LINK, linewidth=1.2, zorder=1)
    for span in spans if is_named else ():
        if span.end - span.start > _ROOM * len(span.label) * whole:
            axes.text(
                0.5 * (span.start + span.end),
                1.02,
                style.plain(span.label),
                transform=axes.get_xaxis_transform(),
                fontproperties=style.font(8.0),
                color=style.QUIET,
                ha="center",
                va="bottom",
                parse_math=False,
            )


def _trimmed(motion: PiecewisePolynomial) -> PiecewisePolynomial:
    """Drop leading powers whose coefficients are zero in all pieces."""
    used = np.flatnonzero(np.abs(motion.coefficients).max(axis=(0, 2)) > 0.0)
    size = int(used[-1]) + 1 if len(used) > 0 else 1
    return PiecewisePolynomial(motion.breaks, motion.coefficients[:, :size])


def _mark(axes: Axes, times: Array, positions: Array) -> None:
    for j in range(positions.shape[1]):
        color = _look(j)[0]
        edge: dict[str, Any] = {"markerfacecolor": "white", "markeredgecolor": color, "markeredgewidth": 1.2}
        axes.plot(times, positions[:, j], "o", markersize=4.5, zorder=4, clip_on=False, **edge)


def _frame(axes: Axes, motion: PiecewisePolynomial) -> None:
    """Set the time range of the motion, mark its switching times if they are few, and leave room around the values."""
    start, end = float(motion.breaks[0]), float(motion.breaks[-1])
    if end > start:
        axes.set_xlim(start, end)
    if len(motion.breaks) <= _FEW_PIECES:
        for time in motion.breaks[1:-1]:
            axes.axvline(float(time), color=style.RULE, linewidth=1.0, zorder=1)
    axes.margins(y=_MARGIN)
    low, high = axes.dataLim.intervaly
    if high - low == 0.0:
        room = max(1.0, 0.1 * abs(low))
        axes.set_ylim(low - room, high + room)


def _legend(figure: Figure, names: Sequence[str], height: float) -> None:
    top = 1.0 - 0.42 / height
    for j, name in enumerate(names):
        x, y = 0.14 + 0.22 * (j % _A_ROW), top - (j // _A_ROW) * style.LINE / height
        color, dashes = _look(j)
        swatch = Line2D([x, x + 0.03], [y - 0.075 / height] * 2, color=color, linewidth=1.5, dashes=dashes)
        swatch.set(transform=figure.transFigure)
        figure.add_artist(swatch)
        shown = style.plain(name)
        style.write(figure, x + 0.037, y, [shown if len(shown) <= 18 else shown[:17] + "…"])
