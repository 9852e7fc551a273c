"""Pictures that are the same for all variants of an exercise: arms with frames, and names of lengths and angles."""

import math
from typing import TYPE_CHECKING

import numpy as np

from gelenk.exercises.table_field import table_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SQUARE = 0.5 * math.pi
_POSTURE = (0.6, 0.9, -0.5, 0.7, 0.8, 0.5)
"""Of an arm of revolute joints where all names have room, [rad]."""


def _frames(rows: list[list[float]], slides: tuple[bool, ...], q: tuple[float, ...]) -> "Figure":
    from gelenk.plots.dh_frames import frames_figure  # noqa: PLC0415

    return frames_figure(table_of(np.array(rows), slides), q)


def one_row() -> "Figure":
    """Draw two frames and what leads from one to the other."""
    return _frames([[0.6, _SQUARE / 2.0, 0.5, 0.0]], (False,), (0.9,))


def anthropomorphic(height: float = 0.5) -> "Figure":
    """Draw an anthropomorphic arm whose second axis is at a height, [m]."""
    rows = [[0.0, _SQUARE, height, 0.0], [0.6, 0.0, 0.0, 0.0], [0.5, 0.0, 0.0, 0.0]]
    return _frames(rows, (False,) * 3, _POSTURE[:3])


def scara() -> "Figure":
    """Draw a SCARA whose tool points down."""
    rows = [[0.5, 0.0, 0.6, 0.0], [0.4, math.pi, 0.0, 0.0], [0.0] * 4, [0.0, 0.0, 0.15, 0.0]]
    return _frames(rows, (False, False, True, False), (*_POSTURE[:2], 0.25, _POSTURE[3]))


def six_joints() -> "Figure":
    """Draw an anthropomorphic arm with a spherical wrist."""
    turns = [_SQUARE, 0.0, _SQUARE, -_SQUARE, _SQUARE, 0.0]
    sizes = [(0.0, 0.5), (0.6, 0.0), (0.0, 0.0), (0.0, 0.6), (0.0, 0.0), (0.0, 0.25)]
    rows = [[a, alpha, d, 0.0] for alpha, (a, d) in zip(turns, sizes, strict=True)]
    return _frames(rows, (False,) * 6, (*_POSTURE[:2], 0.9, *_POSTURE[3:]))
