"""Title and legend of a picture of ellipsoids: what is drawn, how large, and at which scale."""

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from gelenk.kinematics.ellipsoids.manipulability import Ellipsoids
from gelenk.language import number, separator, translated as _
from gelenk.plots.figure import INK, LINE, QUIET, TITLE, write
from gelenk.plots.shadows import DOTTED, THIN, Arrow, Outline, Quantity
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain

_DIGITS = {1: 4, 2: 4, 3: 3}
_MOST_NAMED = 6
"""Largest number of directions listed in the legend."""


_MOST_LINES = 4
"""Largest number of lines for a configuration."""
_CHARACTER = 0.078
"""Width of a character, [inch]."""


@dataclass(frozen=True, slots=True)
class LegendRow:
    """Lines of text in the legend, with a sample of the drawn line that they describe, if any."""

    lines: tuple[str, ...]
    line: Line2D | None = None
    color: str = INK


def legend(
    quantities: Sequence[Quantity],
    outlines: Sequence[Outline],
    arrows: Sequence[Arrow],
    translation: Ellipsoids | None,
) -> list[LegendRow]:
    """Return the entries of the legend: what is drawn, how large, and at which scale."""
    entries = [_entry(quantity) for quantity in quantities]
    entries += [_outline_entry(outline) for outline in outlines]
    if translation is None:
        entries.append(LegendRow((_("The task has no translation, and only translation is drawn here."),), color=QUIET))
    elif not quantities:
        entries.append(LegendRow((_("No joint moves the tip in the directions of the task."),), color=QUIET))
    else:
        sigmas = translation.sigmas[0]
        isotropy = sigmas[-1] / sigmas[0] if sigmas[0] > 0.0 else 0.0
        rank, d = translation.ranks[0], translation.space.dimension
        measure = _("Yoshikawa's measure {measure:.4g}, isotropy {isotropy:.3g}")
        found = _("Rank {rank} of {d}: singular" if rank < d else "Rank {rank} of {d}").format(rank=rank, d=d)
        entries.append(LegendRow((measure.format(measure=translation.measures[0], isotropy=isotropy), found)))
    if arrows:
        words = [f"{arrow.number}  {arrow.words}" for arrow in arrows[:_MOST_NAMED]]
        more = len(arrows) - len(words)
        words.insert(0, _("Along each direction alone, velocity v and force F:"))
        entries.append(LegendRow((*words, *([_("and {more} more directions").format(more=more)] if more else []))))
    return entries


def _entry(quantity: Quantity) -> LegendRow:
    d = len(quantity.sizes)
    sizes = (_("unbounded") if np.isinf(size) else number(size, f".{_DIGITS[d]}g") for size in quantity.sizes)
    ends = separator().join(sizes)
    text = _("{name} {shape}, semi-axis {ends}" if d == 1 else "{name} {shape}, semi-axes {ends}")
    shape = text.format(name=quantity.name, shape=_(quantity.shape), ends=ends)
    lines = (shape, _scale(quantity.unit, quantity.scale))
    return LegendRow(lines, Line2D([], [], color=quantity.color, linewidth=THIN, linestyle=quantity.dashes))


def _outline_entry(outline: Outline) -> LegendRow:
    if outline.vertices is None:
        text = _("{name} polytope: {missing}").format(name=outline.name, missing=outline.missing)
        return LegendRow((text,), color=QUIET)
    text = _("{name} polytope, within the limits of the joints").format(name=outline.name)
    lines = (text, _scale(outline.unit, outline.scale))
    return LegendRow(lines, Line2D([], [], color=outline.color, linewidth=THIN, linestyle=DOTTED))


def _scale(unit: str, metres: float) -> str:
    return _("1 {unit} is drawn as {metres:g} m").format(unit=unit, metres=metres)


def legend_height(entries: Sequence[LegendRow]) -> float:
    """Return the height of a legend, [inch]."""
    return sum((len(entry.lines) + 0.35) * LINE for entry in entries) + 0.1


def configuration_lines(chain: Chain, q: Array, width: float) -> list[str]:
    """Format joint positions as lines of text for a figure of the given width, [inch]."""
    slides = {int(variable) for prismatic, variable in chain.flat.joints.tolist() if prismatic}
    units = ["m" if i in slides else "rad" for i in range(len(q))]
    mixed = len(set(units)) > 1
    values = [number(value) + f" {unit}" * mixed for value, unit in zip(q + 0.0, units, strict=True)]
    text = f"q = ({separator().join(values)})" + ("" if mixed or not units else f" {units[0]}")
    lines = textwrap.wrap(text, int((width - 0.8) / _CHARACTER))
    return lines if len(lines) <= _MOST_LINES else [*lines[: _MOST_LINES - 1], "…"]


def write_head(figure: Figure, title: str, lines: Sequence[str]) -> None:
    """Write the title, and the configuration below it."""
    left, height = 0.06, figure.get_figheight()
    write(figure, left, 1.0 - 0.19 / height, [title], size=TITLE)
    write(figure, left, 1.0 - 0.46 / height, lines, color=QUIET)


def write_legend(figure: Figure, place: tuple[float, float], entries: Sequence[LegendRow]) -> None:
    """Write the entries one below the other; `place` is their upper left corner in fractions of the figure."""
    left, top = place
    line, swatch = LINE / figure.get_figheight(), 0.36 / figure.get_figwidth()
    for entry in entries:
        if entry.line is not None:
            entry.line.set_data([left, left + swatch], [top - line / 2.0] * 2)
            figure.add_artist(entry.line)
        write(figure, left + 1.35 * swatch, top, entry.lines, color=entry.color)
        top -= (len(entry.lines) + 0.35) * line
