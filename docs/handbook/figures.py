"""Pictures that a page draws of its own numbers with matplotlib, in the style of those that the service draws."""

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from app.plots.figure import INK, QUIET, RULE, TEXT, as_bytes, font


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
