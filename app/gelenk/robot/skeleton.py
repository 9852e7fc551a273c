"""Stand-in bodies for a robot without visible shapes: rods between its joints, and joint bodies; for display only."""

import math
from collections.abc import Container

from gelenk.robot.appearance import Solid, Stock
from gelenk.robot.description import MOVABLE, Description, Joint, Link

_THICKNESS = 0.06
"""Relative radius of a rod, half that of a DH table's, so that it is not taken for the robot's own shape."""


def skeleton(description: Description, without: Container[str]) -> dict[str, list[Solid]]:
    """Create solids for the links that show nothing themselves, each in its link's frame.

    Args:
        description: The robot's description.
        without: Names of meshes whose files are missing.

    Returns:
        Solids by link name: a rod to each joint below, and a body for the joint above if that moves; no link without
        solids. If other links show something, a link with neither a shape nor a movable joint is a mere frame: none.
    """
    stock = Stock((math.hypot(*joint.origin.xyz) for joint in description.joints), _THICKNESS)
    bare = [link for link in description.links if not _shows(link, without)]
    found = {}
    for link in bare:
        above, below = description.joint_above.get(link.name), description.joints_below[link.name]
        moves = any(joint.type in MOVABLE for joint in (above, *below) if joint)
        if moves or link.shapes or len(bare) == len(description.links):
            found[link.name] = _solids(stock, above, below)
    return {name: solids for name, solids in found.items() if solids}


def _shows(link: Link, without: Container[str]) -> bool:
    return any(shape.role == "visual" and shape.mesh not in without for shape in link.shapes)


def _solids(stock: Stock, above: Joint | None, below: tuple[Joint, ...]) -> list[Solid]:
    solids = [rod for joint in below for rod in stock.rod((0.0, 0.0, 0.0), joint.origin.xyz)]
    if above is None or above.type not in MOVABLE:
        return solids
    if above.type == "prismatic":
        return solids + stock.slide(above.limits.lower or 0.0, above.limits.upper or 0.0, above.axis)
    return [*solids, stock.hub(axis=above.axis)]
