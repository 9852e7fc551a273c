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
    """What a robot shares with its variants: the folder of its description, or, of a maker's arm, its geometry."""
    if entry(name)["format"] == "urdf":
        return str(entry(name)["model"]["path"].split("/")[1])
    return f"{len(dh_table(name)['joints'])}, {entry(name).get('closed_form')}" if name in ARMS else name


def urdf_text(name: str) -> str:
    """The description of a robot that has one."""
    path: str = entry(name)["model"]["path"]
    return (DATA / path).read_text()


def dh_table(name: str) -> dict[str, Any]:
    """The table of a robot that has one."""
    content: dict[str, Any] = json.loads((CATALOGUE / name / "dh.json").read_text())
    return content


ARMS = set(json.loads((Path(__file__).parents[1] / "dh" / "arms.json").read_text()))
NAMES = sorted(path.parent.name for path in CATALOGUE.glob("*/robot.json"))
URDFS = [name for name in NAMES if entry(name)["format"] == "urdf"]
TABLES = [name for name in NAMES if entry(name)["format"] == "dh"]
