"""Robots and scenes of the tests."""

import numpy as np

from gelenk.collision.bodies import Body
from gelenk.collision.contact.world import World, build_world
from gelenk.collision.robot_bodies import find_bodies
from gelenk.collision.scene import Obstacle, half_space
from gelenk.collision.shapes.covers import covered_body
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf

LINK = """<link name="{name}"><collision><origin xyz="0 0 {half}"/><geometry>{shape}</geometry></collision></link>"""
JOINT = """<joint name="j{i}" type="{type}"><parent link="{a}"/><child link="{b}"/><origin xyz="0 0 {z}"/>
<axis xyz="{axis}"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint>"""


def arm() -> RobotModel:
    """Return an arm of five links of all shapes, with four revolute joints, and two fingers that mirror each other."""
    shapes = (
        '<box size="0.3 0.3 0.1"/>',
        '<capsule radius="0.05" length="0.3"/>',
        '<cylinder radius="0.05" length="0.4"/>',
        '<box size="0.08 0.1 0.3"/>',
        '<sphere radius="0.08"/>',
    )
    halves = (0.05, 0.2, 0.2, 0.15, 0.05)
    links = [LINK.format(name=f"l{i}", half=h, shape=s) for i, (h, s) in enumerate(zip(halves, shapes, strict=True))]
    joints = [
        JOINT.format(i=i, type="revolute", a=f"l{i - 1}", b=f"l{i}", z=2 * halves[i - 1], axis=axis)
        for i, axis in enumerate(("0 0 1", "0 1 0", "0 0.6 0.8", "1 0 0"), start=1)
    ]
    finger = '<box size="0.02 0.04 0.1"/>'
    links += [LINK.format(name=name, half=0.05, shape=finger) for name in ("left", "right")]
    joints.append(JOINT.format(i="f", type="prismatic", a="l4", b="left", z=0.1, axis="1 0 0"))
    mirror = JOINT.format(i="m", type="prismatic", a="l4", b="right", z=0.1, axis="-1 0 0")
    joints.append(mirror.replace("</joint>", '<mimic joint="jf" offset="0.01"/></joint>'))
    text = f'<robot name="arm">{"".join(links)}{"".join(joints)}</robot>'
    return RobotModel(read_urdf(text), ("l0", "l4"))


def obstacles() -> tuple[Obstacle, ...]:
    """Return a floor, a box, a ball, a post and a rod on the last link."""
    box, post, ball = np.eye(4), np.eye(4), np.eye(4)
    box[:3, 3], post[:3, 3], ball[:3, 3] = (0.5, 0.1, 0.3), (-0.4, 0.4, 0.4), (0.0, -0.6, 0.5)
    rod = np.eye(4)
    rod[:3, 3] = (0.0, 0.0, 0.25)
    return (
        Obstacle("floor", (half_space("floor", "l0", np.array([0.0, 0.0, 2.0]), -0.2, np.eye(4)),)),
        Obstacle("box", (covered_body("box", "l0", "box", (0.3, 0.4, 0.5), box),), clearance=0.02),
        Obstacle("post", (covered_body("post", "l0", "cylinder", (0.05, 0.8), post),)),
        Obstacle("ball", (covered_body("ball", "l0", "sphere", (0.2,), ball),)),
        Obstacle("rod", (covered_body("rod", "l4", "capsule", (0.02, 0.2), rod),), "l4", frozenset({"left", "right"})),
    )


def world(others: dict[str, float] | None = None) -> World:
    """Return the arm among its obstacles."""
    robot = arm()
    own = find_bodies(robot.description, lambda _: None)
    return build_world(robot, robot.chain(None, None), own, obstacles(), others)


def random_piece(rng: np.random.Generator, scale: float) -> Body:
    """Return a piece of any kind but a half-space, about as large as `scale`, [m]."""
    kind = str(rng.choice(["sphere", "capsule", "cylinder", "box", "convex"]))
    size = scale * rng.uniform(0.05, 1.0, {"sphere": 1, "box": 3, "convex": 0}.get(kind, 2))
    points = scale * rng.uniform(0.05, 1.0, 3) * rng.normal(size=(int(rng.integers(5, 60)), 3))
    kept = points if kind == "convex" else np.zeros((0, 3))
    return Body(kind, "link", kind, tuple(size), kept, np.eye(4), np.zeros((0, 4)))  # type: ignore[arg-type]
