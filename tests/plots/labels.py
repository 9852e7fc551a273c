"""The texts of a picture as a reader sees them: which there are, and whether they get in each other's way."""

from itertools import combinations, pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox

_TOUCH = 0.5
"""By how much texts may overlap, [pixel]: letters do not fill their boxes."""


def texts(figure: Figure) -> list[Text]:
    """All texts that are drawn, numbers at axes included."""
    figure.draw_without_rendering()
    found = list(figure.texts)
    for axes in figure.axes:
        found += [*axes.texts, *(axes.findobj(lambda one: isinstance(one, Text)) if axes.axison else ())]
        found = [text for text in found if text not in _beyond(axes)]
    return [text for text in dict.fromkeys(found) if text.get_visible() and text.get_text().strip()]


def _beyond(axes: Axes) -> list[Text]:
    """The numbers beyond the ends of the axes, which exist but are not drawn."""
    return [
        label
        for axis in (axes.xaxis, axes.yaxis)
        for tick in axis.get_major_ticks()
        for label in (tick.label1, tick.label2)
        if not min(axis.get_view_interval()) <= tick.get_loc() <= max(axis.get_view_interval())
    ]


def words(figure: Figure) -> str:
    return "\n".join(text.get_text() for text in texts(figure))


def flaws(figure: Figure) -> list[str]:
    """Texts that overlap, that leave the paper, or that a line crosses in a drawing without axes."""
    boxes = _boxes(figure)
    found = [f"{a} and {b} overlap" for (a, one), (b, two) in combinations(boxes, 2) if _overlap(one, two)]
    paper = figure.bbox
    found += [
        f"{name} leaves the paper"
        for name, box in boxes
        if box.x0 < paper.x0 or box.y0 < paper.y0 or box.x1 > paper.x1 or box.y1 > paper.y1
    ]
    bare = [axes for axes in figure.axes if not axes.axison]
    return found + [f"{name} is crossed" for name, box in boxes for axes in bare if _is_crossed(box, axes)]


def _boxes(figure: Figure) -> list[tuple[str, Bbox]]:
    renderer: Any = FigureCanvasAgg(figure).get_renderer()  # type: ignore[no-untyped-call]
    return [(repr(text.get_text()), text.get_window_extent(renderer)) for text in texts(figure)]


def _overlap(one: Bbox, two: Bbox) -> bool:
    across = min(one.x1, two.x1) - max(one.x0, two.x0)
    upwards = min(one.y1, two.y1) - max(one.y0, two.y0)
    return bool(min(across, upwards) > _TOUCH)


def _is_crossed(box: Bbox, axes: Axes) -> bool:
    middle = (box.x0 + box.x1) / 2.0, (box.y0 + box.y1) / 2.0
    if any(patch.contains_point(middle) for patch in axes.patches):  # which covers what is below it
        return False
    for line in axes.lines:
        corners = axes.transData.transform(np.column_stack([np.atleast_1d(np.asarray(v)) for v in line.get_data()]))
        for a, b in pairwise(corners):
            points = np.linspace(a, b, max(2, int(np.hypot(*(b - a)))))
            inside = (points > (box.x0, box.y0)) & (points < (box.x1, box.y1))
            if inside.all(axis=1).any():
                return True
    return False
