"""Picture of bang-coast-bang, or another law, along a line: σ, σ̇ and σ̈ over time."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from gelenk.language import number, translated as _
from gelenk.plots import figure as style
from gelenk.plots.profiles import curve, time_axes
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_LABELS = ("σ / m", "σ̇ / (m/s)", "σ̈ / (m/s²)")
_COLORS = (style.INK, style.VELOCITY, style.FORCE)
_MARGIN = 0.14
_FEW_PIECES = 6
_ROOM = 0.09
"""Least distance of two times that are both written, as a fraction of the whole."""


def line_picture(length: float, law: PiecewisePolynomial, limits: Sequence[float], kind: style.PictureFormat) -> bytes:
    """Draw σ(t), [m], and two derivatives; limits of velocity and acceleration may be infinite."""
    figure = style.new_figure(6.4, 6.4)
    title = _("Along a line: L = {length:.4g} m in {duration:.4g} s").format(length=length, duration=law.duration)
    style.write(figure, 0.06, 0.975, [title], size=style.TITLE)
    for order, (label, color) in enumerate(zip(_LABELS, _COLORS, strict=True)):
        axes = figure.add_axes((0.14, 0.66 - 0.285 * order, 0.82, 0.25))
        time_axes(axes, label, is_last=order == 2)
        times, values = curve(law.derivative(order))
        axes.plot(times, values[:, 0], color=color, linewidth=1.8, zorder=3)
        _mark(axes, law, is_named=order == 0)
        if order > 0 and np.isfinite(limits[order - 1]):
            _limit(axes, limits[order - 1], "va"[order - 1], is_signed=order == 2)
        axes.margins(y=_MARGIN)
        if law.duration > 0.0:
            axes.set_xlim(law.breaks[0], law.breaks[-1])
    return style.as_bytes(figure, kind)


def _mark(axes: Axes, law: PiecewisePolynomial, *, is_named: bool) -> None:
    """Draw a line where pieces meet, and its time above the first panel if there is room."""
    if len(law.breaks) > _FEW_PIECES:
        return
    shown = float(law.breaks[0])
    for time in law.breaks[1:-1].tolist():
        axes.axvline(time, color=style.LINK, linewidth=1.0, zorder=1)
        if is_named and time - shown > _ROOM * law.duration:
            shown = time
            axes.text(
                time, 1.02, number(time), transform=axes.get_xaxis_transform(), ha="center", va="bottom", **_words()
            )


def _limit(axes: Axes, limit: float, name: str, *, is_signed: bool) -> None:
    dashes: dict[str, Any] = {"color": style.QUIET, "linewidth": 1.0, "linestyle": (0.0, (5.0, 3.0)), "zorder": 2}
    for sign, label in ((1.0, name), (-1.0, f"-{name}"))[: 1 + is_signed]:
        axes.axhline(sign * limit, **dashes)
        place: dict[str, Any] = {"xycoords": axes.get_yaxis_transform(), "textcoords": "offset points"}
        axes.annotate(label, (0.5, sign * limit), (0.0, 8.0 * sign), ha="center", va="center", **place, **_words())


def _words() -> dict[str, Any]:
    return {"fontproperties": style.font(8.0), "color": style.QUIET, "parse_math": False}
