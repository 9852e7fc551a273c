"""The catalogue's robots as the core sees them, each built once."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any, Literal

import numpy as np
import pytest
from _pytest.mark import ParameterSet

from gelenk.dh.tables.convert import describe_dh
from gelenk.dh.tables.housings import housed_bodies
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.description import Description
from gelenk.robot.dh import DhJoint, DhTable
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf, write_urdf
from gelenk.store.records import BUILT_KINDS
from tests.oracles import catalogue, dh_columns

CLASSES = {
    "double_pendulum_continuous": "joints without limits",
    "iris": "no joints",
    "kinova": "a wrist whose axes do not meet",
    "panda": "seven joints",
    "panda_dh": "a modified table",
    "planar_3r": "planar, a standard table",
    "scara": "a slide along an axis of a turn",
    "stanford": "a slide that turns",
    "tiago": "a tree with a slide, and joints that the chain leaves out",
    "ur5": "parallel axes",
}
"""A robot of the catalogue for each kind that computations may take differently."""


def swept(names: Iterable[str], value: Callable[[str], object] = str) -> list[ParameterSet]:
    """Parameters for a test of many robots: one of each kind, and one of each family if asked for `slow`."""
    families = {catalogue.family(name): name for name in reversed(catalogue.NAMES)}
    slow = set(families.values()) - set(CLASSES)
    wanted = [name for name in names if name in slow or name in CLASSES]
    return [pytest.param(value(name), id=name, marks=[pytest.mark.slow] * (name in slow)) for name in wanted]


@cache
def robot(name: str) -> RobotModel:
    """A robot of the catalogue."""
    description = read_urdf(catalogue.urdf_text(name)) if name in catalogue.URDFS else described(name)
    ends = catalogue.entry(name)["default_chain"]
    return RobotModel(description, (ends["base_frame"], ends["tip_frame"]))


def described(name: str) -> Description:
    """A table of the catalogue as the service describes it."""
    about, given = catalogue.entry(name), table(catalogue.dh_table(name))
    bodies = housed_bodies(given, about.get("payload")) if about["kind"] in BUILT_KINDS else None
    return reread(describe_dh(name, given, bodies))


def table(content: Mapping[str, Any]) -> DhTable:
    """A table as the catalogue writes it."""
    joints = tuple(DhJoint(**joint) for joint in content["joints"])
    base, tool = (dh_columns.placement(content.get(key)) for key in ("base", "tool"))
    return DhTable(content["convention"], joints, base, tool)


def rows(
    convention: Literal["standard", "modified"], parameters: Sequence[tuple[float, float, float, float]], types: str
) -> DhTable:
    """A table by its rows of (a, α, d, θ) and one letter a joint, R or P."""
    kinds: dict[str, Literal["revolute", "prismatic"]] = {"R": "revolute", "P": "prismatic"}
    return DhTable(
        convention,
        tuple(
            DhJoint(f"joint_{i}", kinds[letter], *row)
            for i, (row, letter) in enumerate(zip(parameters, types, strict=True), start=1)
        ),
    )


def reread(description: Description) -> Description:
    """A description after a journey through XML."""
    return read_urdf(write_urdf(description))


def of_table(dh: DhTable) -> RobotModel:
    """The robot that a table describes, by way of XML."""
    return RobotModel(reread(describe_dh("arm", dh)))


def samples(chain: Chain, count: int, seed: int = 0) -> Array:
    """Configurations of a chain: all the way round for turning joints, ±1 m for sliding ones; shape (count, n)."""
    slides = {int(variable) for prismatic, variable in chain.flat.joints if prismatic}
    reach = np.array([1.0 if i in slides else np.pi for i in range(len(chain))])
    return np.random.default_rng(seed).uniform(-reach, reach, (count, len(chain)))


def by_name(chain: Chain, qs: Array) -> dict[str, Array]:
    """Configurations of a chain as one array a joint."""
    return dict(zip(chain.joint_names, qs.T, strict=True))


def without_warnings(description: Description) -> Description:
    """The description alone, to be compared with another."""
    return replace(description, warnings=())
