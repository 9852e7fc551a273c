"""Height maps as boxes: the terrain in quarters of quarters, halved where it rises most."""

import heapq
from typing import TypeAlias

import numpy as np

from gelenk.collision.bodies import Body
from gelenk.collision.shapes.clouds import box_bodies
from gelenk.robot.arrays import Array

MAX_PIECES = 2_000
_FLAT = 1e-3
"""A block that rises by no more than this is one box, [m]."""
_THIN = 1e-3
"""Least height of a box, [m]."""

_Block: TypeAlias = tuple[int, int, int, int]
"""First and last row, first and last column of its corners."""


def height_map_bodies(
    name: str, link: str, heights: Array, size: tuple[float, float], base: float, T_link_map: Array
) -> tuple[list[Body], float]:
    """Return boxes that contain everything between a base and a surface through heights, at most `MAX_PIECES`.

    Between four neighbouring heights the surface may run as it likes within them: in two triangles, or curved.

    Args:
        name: Of the object.
        link: In whose frame it is placed.
        heights: At the corners of a grid about the map's z axis; shape (R, C), rows along y and columns along x, [m].
        size: Of the grid along x and y, [m].
        base: Down to where it is solid, [m].
        T_link_map: Pose of the map in the link; shape (4, 4).

    Returns:
        The boxes, and how far at most the top of one is above the lowest height in it, [m].
    """
    rows, columns = heights.shape
    blocks, rises = _blocks(heights)
    xs, ys = (extent * np.linspace(-0.5, 0.5, count) for extent, count in zip(size, (columns, rows), strict=True))
    first_row, last_row, first_column, last_column = np.array(blocks).T
    tops = np.array([_within(heights, block).max() for block in blocks])
    lows = np.column_stack((xs[first_column], ys[first_row], np.minimum(base, tops - _THIN)))
    highs = np.column_stack((xs[last_column], ys[last_row], tops))
    return list(box_bodies(name, link, lows, highs, T_link_map)), max(rises)


def _blocks(heights: Array) -> tuple[list[_Block], list[float]]:
    """Return blocks of cells, always halving the one that rises most, and the rise of each, [m]."""
    rows, columns = heights.shape
    whole = (0, rows - 1, 0, columns - 1)
    waiting, done = [(-_rise(heights, whole), whole)], list[tuple[float, _Block]]()
    while waiting and len(waiting) + len(done) < MAX_PIECES and -waiting[0][0] > _FLAT:
        rise, block = heapq.heappop(waiting)
        halves = _halves(block)
        if not halves:
            done.append((rise, block))
        for half in halves:
            heapq.heappush(waiting, (-_rise(heights, half), half))
    found = [*waiting, *done]
    return [block for _, block in found], [-rise for rise, _ in found]


def _halves(block: _Block) -> list[_Block]:
    """Return both halves of a block, cut across its longer side; none of a single cell."""
    top, bottom, left, right = block
    if max(bottom - top, right - left) < 2:
        return []
    if bottom - top >= right - left:
        middle = (top + bottom) // 2
        return [(top, middle, left, right), (middle, bottom, left, right)]
    middle = (left + right) // 2
    return [(top, bottom, left, middle), (top, bottom, middle, right)]


def _within(heights: Array, block: _Block) -> Array:
    top, bottom, left, right = block
    return heights[top : bottom + 1, left : right + 1]


def _rise(heights: Array, block: _Block) -> float:
    return float(np.ptp(_within(heights, block)))
