"""Objects around a robot, and attached to it, as bodies."""

from dataclasses import dataclass

import numpy as np

from gelenk.collision.bodies import Body
from gelenk.collision.shapes.covers import covered_body
from gelenk.errors import InvalidField, quoted
from gelenk.robot.arrays import Array
from gelenk.robot.chain import rotation_to_axis
from gelenk.robot.description import Description
from gelenk.robot.poses import transform


@dataclass(frozen=True, slots=True, eq=False)
class Obstacle:
    """An object of a scene.

    Attributes:
        bodies: Its pieces, in the frame of the link that it is attached to, else in the robot's root.
        link: That link; None of an object at rest.
        touch_links: Links that may touch it.
        clearance: What comes nearer than this counts as in contact, [m].
        note: Where its bodies are larger than it is, by how much; a sentence.
    """

    name: str
    bodies: tuple[Body, ...]
    link: str | None = None
    touch_links: frozenset[str] = frozenset()
    clearance: float = 0.0
    note: str | None = None


def half_space(name: str, link: str, normal: Array, offset: float, T_link_object: Array) -> Body:
    """Return all points x of the object's frame with normal · x ≤ offset, for a normal of any length but 0."""
    up = normal / np.linalg.norm(normal)
    T = T_link_object @ transform(offset * up, rotation_to_axis((float(up[0]), float(up[1]), float(up[2]))))
    return covered_body(name, link, "half_space", (), T)


def check_scene(description: Description, obstacles: tuple[Obstacle, ...]) -> None:
    """Refuse frames that the robot does not have, and objects named like a link; raises InvalidField."""
    for i, one in enumerate(obstacles):
        if one.name in description.joints_below:
            raise InvalidField(f"scene/objects/{i}/name", f"{quoted(one.name)} is the name of a link")
        for field, names in (("attached_to", (one.link,) if one.link else ()), ("touch_links", one.touch_links)):
            for name in names:
                if name not in description.joints_below:
                    raise InvalidField(f"scene/objects/{i}/{field}", f"the robot has no frame {quoted(name)}")
