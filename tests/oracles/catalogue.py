"""The robots of the catalogue as texts and tables, read from the files."""

import json
import sysconfig
from pathlib import Path
from typing import Any

CATALOGUE = Path(__file__).parents[2] / "robots"
DATA = Path(sysconfig.get_paths()["purelib"]) / "cmeel.prefix/share/example-robot-data"


def entry(name: str) -> dict[str, Any]:
    """What the catalogue says about a robot."""
    content: dict[str, Any] = json.loads((CATALOGUE / name / "robot.json").read_text())
    return content


def family(name: str) -> str:
    """The folder that a robot's description shares with its variants; a table is its own."""
    return entry(name)["model"]["path"].split("/")[1] if entry(name)["format"] == "urdf" else name


def urdf_text(name: str) -> str:
    """The description of a robot that has one."""
    path: str = entry(name)["model"]["path"]
    return (DATA / path).read_text()


def dh_table(name: str) -> dict[str, Any]:
    """The table of a robot that has one."""
    content: dict[str, Any] = json.loads((CATALOGUE / name / "dh.json").read_text())
    return content


NAMES = sorted(path.parent.name for path in CATALOGUE.glob("*/robot.json"))
URDFS = [name for name in NAMES if entry(name)["format"] == "urdf"]
TABLES = [name for name in NAMES if entry(name)["format"] == "dh"]
