"""Pictures that a page draws of its own numbers with matplotlib, in the style of those that the service draws."""

import re

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from gelenk.plots.figure import INK, QUIET, RULE, TEXT, as_bytes, font

_LONG = re.compile(r"(?<![\w.])-?\d+\.\d{2,}(?!\w)")
_HASHED = re.compile(r"\b([mp])([0-9a-f]{10})\b")
_AGAIN = re.compile(r"(L (\S+ \S+) )(?:L \2 )+")
"""A point of a line that is there twice; on which processors, rounding decides."""
_METADATA = re.compile(r"<metadata>.*?</metadata>", re.DOTALL)


def compact(drawing: str) -> str:
    """An SVG of matplotlib with as many digits as can be seen, without metadata, and with names that do not change."""
    names: dict[str, str] = {}
    short = _LONG.sub(lambda number: f"{float(number[0]):.1f}" if abs(float(number[0])) > 2 else number[0], drawing)
    short = _HASHED.sub(lambda name: names.setdefault(name[2], f"{name[1]}{len(names)}"), _METADATA.sub("", short))
    return _AGAIN.sub(r"\1", " ".join(short.split())).replace("> <g", ">\n<g") + "\n"


def svg(figure: Figure) -> bytes:
    """A figure as SVG; it is closed."""
    for axes in figure.axes:
        if axes.name != "3d":
            axes.grid(color=RULE, linewidth=0.6)
            axes.set_axisbelow(True)
            axes.spines[["top", "right"]].set_visible(False)
            axes.spines[["left", "bottom"]].set_color(QUIET)
        axes.tick_params(colors=QUIET, labelsize=TEXT)
        for label in (axes.xaxis.label, axes.yaxis.label, axes.title):
            label.set(fontproperties=font(), color=INK)
    plt.close(figure)
    return as_bytes(figure, "svg")
