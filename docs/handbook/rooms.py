"""The rooms of the package in layers, drawn from the import contract that `./dev lint` checks."""

import ast
import re
import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from gelenk.plots.figure import INK, QUIET, RULE, TEXT, VELOCITY, font

_ROOT = Path(__file__).parents[2]
_CORE = {"trajectory", "dh", "kinematics", "ik", "collision", "course", "robot", "errors"}
_ROW, _WIDTH, _LETTER, _GAP = 0.3, 9.4, 0.078, 0.08
"""Height of a line, width of the picture, of a letter and of the space between two rooms, [inch]."""


def layers() -> list[list[str]]:
    """Rooms by layer, the highest first: a layer's rooms import from those below alone."""
    contracts = tomllib.loads((_ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]
    of_layers = next(contract for contract in contracts["contracts"] if contract["type"] == "layers")
    return [re.findall(r"gelenk\.([\w.]+)", row) for row in of_layers["layers"]]


def purpose(room: str) -> str:
    """The first sentence of a room's docstring, up to a colon or a semicolon."""
    path = _ROOT / "app" / "gelenk" / Path(*room.split("."))
    file = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    sentence = (ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or "").splitlines()[0]
    return re.split(r"[:;]|\. |\.$", sentence)[0].replace("`", "")


def lines(layer: list[str]) -> list[list[str]]:
    """A layer's rooms in as many lines as they need."""
    found: list[list[str]] = []
    left = _WIDTH
    for room in layer:
        if left + _width(room) > _WIDTH:
            found.append([])
            left = _GAP
        found[-1].append(room)
        left += _width(room) + _GAP
    return found


def rooms_picture() -> Figure:
    """Layers between rules: boxes with the rooms' names, and what the room is for where it is alone."""
    found = layers()
    height = _ROW * sum(len(lines(layer)) for layer in found)
    figure, axes = plt.subplots(figsize=(_WIDTH, height))
    axes.set_position((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, _WIDTH), ylim=(height, 0.0))
    top = 0.0
    for layer in found:
        for line in lines(layer):
            end = _line(axes, line, top + _ROW / 2)
            top += _ROW
        if len(layer) == 1:
            axes.text(end, top - _ROW / 2, purpose(layer[0]), va="center", size=TEXT, color=QUIET, font=font())
        axes.axhline(top, color=RULE, linewidth=0.4)
    axes.axis("off")
    return figure


def _line(axes: Axes, rooms: list[str], middle: float) -> float:
    """Draw rooms beside each other; return where the next one would begin, [inch]."""
    left = _GAP
    for room in rooms:
        edge = VELOCITY if room.split(".")[0] in _CORE else QUIET
        axes.add_patch(Rectangle((left, middle - 0.11), _width(room), 0.22, facecolor="white", edgecolor=edge))
        axes.text(left + _width(room) / 2, middle, room, ha="center", va="center", size=TEXT, color=INK, font=font())
        left += _width(room) + _GAP
    return left + 0.04


def _width(room: str) -> float:
    return _LETTER * len(room) + 0.16
