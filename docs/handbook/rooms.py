"""The rooms of the package in layers, drawn from the import contract that `./dev lint` checks."""

import ast
import re
import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from gelenk.plots.figure import INK, QUIET, RULE, TEXT, VELOCITY, font

_ROOT = Path(__file__).parents[2]
_CORE = {"trajectory", "dh", "kinematics", "ik", "course", "robot", "errors"}
_ROW, _WIDTH, _LETTER = 0.3, 9.4, 0.078
"""Height of a layer, width of the picture and of a letter, [inch]."""


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
    return re.split(r"[:;]|\. |\.$", sentence)[0]


def rooms_picture() -> Figure:
    """A row a layer: boxes with the rooms' names, and what the first of them is for where it is alone."""
    rows = layers()
    figure, axes = plt.subplots(figsize=(_WIDTH, _ROW * len(rows)))
    axes.set_position((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, _WIDTH), ylim=(_ROW * len(rows), 0.0))
    for number, row in enumerate(rows):
        middle, left = _ROW * (number + 0.5), 0.05
        for room in row:
            width = _LETTER * len(room) + 0.16
            edge = VELOCITY if room.split(".")[0] in _CORE else QUIET
            axes.add_patch(Rectangle((left, middle - 0.11), width, 0.22, facecolor="white", edgecolor=edge))
            axes.text(left + width / 2, middle, room, ha="center", va="center", size=TEXT, color=INK, font=font())
            left += width + 0.08
        if len(row) == 1:
            axes.text(left + 0.04, middle, purpose(row[0]), va="center", size=TEXT, color=QUIET, font=font())
        axes.axhline(_ROW * (number + 1), color=RULE, linewidth=0.4)
    axes.axis("off")
    return figure
