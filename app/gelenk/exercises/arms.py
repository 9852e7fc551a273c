"""The arms of exercises: chains by their DH tables in the standard convention, and what wrong models make of them."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, TypeVar

import numpy as np

from gelenk.course.velocity.geometry import ChainGeometry, chain_geometry
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain, FlatChain
from gelenk.robot.dh import DhJoint

if TYPE_CHECKING:
    from matplotlib.figure import Figure

N = TypeVar("N", bound=NamedTuple)
_LINKS, _JOINTS = ("l1", "l2", "l3"), ("q1", "q2", "q3")
Row: TypeAlias = tuple[bool, float, float, float, float]
"""Whether the joint slides, then a, α, d and ϑ without the variable."""


def chain_of(rows: Sequence[Row]) -> Chain:
    """Return the chain of a DH table, from frame 0 to frame n."""
    names = tuple(f"q{i}" for i in range(1, len(rows) + 1))
    joints = [
        DhJoint(name, "prismatic" if slides else "revolute", a, alpha, d, theta)
        for name, (slides, a, alpha, d, theta) in zip(names, rows, strict=True)
    ]
    Ts = [np.eye(4), *(joint.transform(0.0, "standard") for joint in joints)]  # A_i(q) = motion(q) A_i(0)
    flat = FlatChain(
        np.array([np.append(T[:3, :3], T[:3, 3]) for T in Ts]),
        np.array([(row[0], i) for i, row in enumerate(rows)], dtype=np.int64),
        np.array([(1.0, 0.0)] * len(rows)),
    )
    unbounded = np.full(len(rows), np.inf)
    return Chain("0", str(len(rows)), names, frozenset(names), -unbounded, unbounded, flat)


def planar(*lengths: float) -> Chain:
    """Return a planar arm of revolute joints."""
    return chain_of([(False, length, 0.0, 0.0, 0.0) for length in lengths])


def polar() -> Chain:
    """Return a planar arm whose first joint turns and whose second one slides along the link."""
    return chain_of([(False, 0.0, math.pi / 2.0, 0.0, math.pi / 2.0), (True, 0.0, 0.0, 0.0, 0.0)])


def anthropomorphic(upper: float, fore: float) -> Chain:
    """Return an anthropomorphic arm: a vertical axis, then two horizontal ones."""
    links = [(False, length, 0.0, 0.0, 0.0) for length in (upper, fore)]
    return chain_of([(False, 0.0, math.pi / 2.0, 0.0, 0.0), *links])


def scara(first: float, second: float, height: float, tool: float) -> Chain:
    """Return a SCARA of four joints whose tool points down."""
    return chain_of(
        [
            (False, first, 0.0, height, 0.0),
            (False, second, math.pi, 0.0, 0.0),
            (True, 0.0, 0.0, 0.0, 0.0),
            (False, 0.0, 0.0, tool, 0.0),
        ]
    )


def radians(*degrees: float) -> Array:
    """Return angles in radians."""
    return np.radians(degrees)


def at(chain: Chain, q: Array) -> ChainGeometry:
    """Return a chain's axes and lever arms at a configuration, [rad or m]."""
    return chain_geometry(chain.flat, q)


def lever_from_base(geometry: ChainGeometry) -> Array:
    """Return J as it is if every lever arm begins at the base; shape (6, n)."""
    columns = [joint.column(geometry.position + joint.origin) for joint in geometry.joints]
    return np.array(columns).T


# A planar arm is any numbers with links `l1`, `l2`, … in metres and joint angles `q1`, `q2`, … in degrees.


def lengths(arm: NamedTuple) -> tuple[float, ...]:
    """Return the links of a planar arm, [m]."""
    return tuple(value for name, value in arm._asdict().items() if name in _LINKS)


def angles(arm: NamedTuple) -> Array:
    """Return the joint angles of an arm, [rad]."""
    return radians(*(value for name, value in arm._asdict().items() if name in _JOINTS))


def misread(arm: N, *names: str) -> N:
    """Return the numbers of which a calculator in the wrong mode takes the sines: degrees for radians."""
    wrong = names or [name for name in arm._fields if name in _JOINTS]
    return arm._replace(**{name: math.degrees(getattr(arm, name)) for name in wrong})


def posture(arm: NamedTuple) -> ChainGeometry:
    """Return axes and lever arms of a planar arm."""
    return at(planar(*lengths(arm)), angles(arm))


def jacobian(arm: NamedTuple) -> Array:
    """Return J of v_x and v_y of a planar arm; shape (2, n)."""
    return posture(arm).jacobian()[:2]


def angles_not_summed(arm: NamedTuple) -> Array:
    """Return J of a planar arm as it is if each link's angle is counted from the base's x axis; shape (2, n)."""
    q = angles(arm)
    columns = [-np.multiply(lengths(arm), np.sin(q)), np.multiply(lengths(arm), np.cos(q))]
    return np.array([np.cumsum(column[::-1])[::-1] for column in columns])


def own_links(arm: NamedTuple) -> Array:
    """Return J of a planar arm of two links as it is if each joint moves its own link alone; shape (2, 2)."""
    return jacobian(arm) @ [[1.0, 0.0], [-1.0, 1.0]]


def planar_picture(arm: NamedTuple) -> "Figure":
    """Draw a planar arm with its lengths and angles."""
    from gelenk.plots.course.planar_arm import PlanarJoint, planar_arm_figure  # noqa: PLC0415

    pairs = zip(angles(arm).tolist(), lengths(arm), strict=True)
    return planar_arm_figure([PlanarJoint("R", angle, length) for angle, length in pairs], values=True)
