"""The common style of all pictures, and rendering of figures to bytes.

Figures are created and drawn directly, never through pyplot, whose current figure is shared by the whole process. A
lock lets one thread draw at a time: matplotlib guarantees no more, and nothing is lost, because it holds the GIL.
"""

import threading
from collections.abc import Sequence
from io import BytesIO
from typing import Final, Literal, TypeAlias

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.ticker import ScalarFormatter

from gelenk.language import has_decimal_comma
from gelenk.robot.arrays import Array

PictureFormat: TypeAlias = Literal["svg", "png", "pdf"]

INK: Final = "#1f2933"
QUIET: Final = "#6b7580"
RULE: Final = "#d9dee3"
LINK: Final = "#9aa5b1"
VELOCITY: Final = "#0072b2"
FORCE: Final = "#d55e00"
"""Blue and vermilion of Okabe and Ito, which people with common colour blindness can tell apart."""

TEXT: Final = 9.0
TITLE: Final = 11.0
"""The two font sizes, [pt]."""
LINE: Final = TEXT * 1.75 / 72.0
"""Line spacing, [inch]."""

_PNG_DOTS_PER_INCH = 150
_MOST_TEXT = 48
_BEYOND_FONT = 0x250

# Only affects the ids of an SVG's elements, which would otherwise be random.
mpl.rcParams["svg.hashsalt"] = "gelenk"

drawing = threading.Lock()
"""Held while matplotlib measures or draws text; see above."""


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure of the given size, [inch]."""
    return Figure(figsize=(width, height), facecolor="white")


def as_bytes(figure: Figure, kind: PictureFormat) -> bytes:
    """Render a figure: the same bytes each time, and without need of the font.

    Letters are paths in an SVG, and in a PDF text of a typeface that it contains.
    """
    buffer = BytesIO()
    with drawing:
        match kind:
            case "svg":
                FigureCanvasSVG(figure)
                figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": "Gelenk"})
            case "png":
                FigureCanvasAgg(figure)
                figure.savefig(buffer, format="png", dpi=_PNG_DOTS_PER_INCH, metadata={"Software": "Gelenk"})
            case "pdf":
                FigureCanvasPdf(figure)
                figure.savefig(buffer, format="pdf", metadata={"CreationDate": None, "Creator": "Gelenk"})
    return buffer.getvalue()


def font(size: float = TEXT, *, bold: bool = False) -> FontProperties:
    """Return the only typeface used, which comes with matplotlib; `size` in [pt]."""
    return FontProperties(family="DejaVu Sans", size=size, weight="bold" if bold else "normal")


def metric_axes(axes: Axes, x_label: str, y_label: str) -> None:
    """Style axes of lengths in metres: equal scales, a light grid below everything, labels."""
    axes.set_aspect("equal", adjustable="box")
    light_axes(axes, x_label, y_label)


def light_axes(axes: Axes, x_label: str | None, y_label: str, *, size: float = TEXT) -> None:
    """Style axes: a light grid below everything, labels; numbers of a font size, [pt], below only with a label."""
    axes.set_axisbelow(True)
    axes.grid(color=RULE, linewidth=0.6)
    for side, spine in axes.spines.items():
        spine.set_visible(side in {"left", "bottom"})
        spine.set_color(QUIET)
        spine.set_linewidth(0.8)
    axes.tick_params(colors=QUIET, labelsize=size, length=3, width=0.8, labelbottom=x_label is not None)
    decimal_marks(axes)
    if x_label is not None:
        axes.set_xlabel(x_label, fontproperties=font(), color=INK)
    axes.set_ylabel(y_label, fontproperties=font(), color=INK)


def decimal_marks(axes: Axes) -> None:
    """Write the numbers along axes with the decimal mark of the current language."""
    if has_decimal_comma():
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(_DecimalCommas())


class _DecimalCommas(ScalarFormatter):
    def __call__(self, x: float, pos: int | None = None) -> str:
        return super().__call__(x, pos).replace(".", ",")


def look_at(axes: Axes, middle: Array, half: Array) -> None:
    """Show a rectangle, given by its centre and half size; shape (2,) each."""
    axes.set_xlim(middle[0] - half[0], middle[0] + half[0])
    axes.set_ylim(middle[1] - half[1], middle[1] + half[1])


def axis_name(direction: Array, number: int) -> str:
    """Return x, y or z if a unit vector (3,) is one of these, else a numbered name."""
    for name, unit in zip("xyz", np.eye(3), strict=True):
        if np.abs(direction - unit).max() < 1e-9:
            return name
    return f"in-plane direction {number}"


def write(figure: Figure, x: float, y: float, lines: Sequence[str], *, size: float = TEXT, color: str = INK) -> None:
    """Write lines of text, never parsed as mathematics, with upper left corner (x, y) in fractions of the figure."""
    figure.text(
        x, y, "\n".join(lines), fontproperties=font(size), color=color, va="top", linespacing=1.5, parse_math=False
    )


def plain(name: str) -> str:
    """Shorten a name from a request or a model, and replace characters that the typeface lacks."""
    shown = name if len(name) <= _MOST_TEXT else name[: _MOST_TEXT - 1] + "…"
    return "".join(c if c == "…" or (c.isprintable() and ord(c) < _BEYOND_FONT) else "?" for c in shown)
