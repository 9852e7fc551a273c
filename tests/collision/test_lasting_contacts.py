"""Links in contact wherever the joints stand are left out; links apart somewhere, or everywhere, are not."""

from itertools import product

import coal
import numpy as np
import pinocchio as pin
import pytest

from gelenk.collision.contact.always import without_lasting_contacts
from gelenk.collision.contact.kernels import all_contacts, first_contacts
from gelenk.collision.contact.world import build_world
from gelenk.collision.pairs import LinkPair
from gelenk.collision.robot_bodies import RobotBodies, find_bodies
from gelenk.operations.robot_bodies import bodies_of
from gelenk.package_data import catalogue
from gelenk.robot.notations import placement
from gelenk.robot.urdf import read_urdf
from gelenk.store.records import LoadedRobot, load, read_record
from tests.collision.coal_peer import drawn_shape

BALL = '<link name="l{i}"><collision><geometry><sphere radius="{radius}"/></geometry></collision></link>'
JOINT = """<joint name="j{i}" type="{type}"><parent link="l{before}"/><child link="l{i}"/><origin xyz="{x} 0 0"/>
<axis xyz="0 0 1"/><limit lower="0" upper="{upper}" velocity="1" effort="1"/></joint>"""


def balls(radii: list[float], steps: list[float], last: str = "continuous", upper: float = 1.0) -> RobotBodies:
    """Return a plane arm with a ball at the origin of each link, `steps` apart; only the last joint has limits."""
    links = [BALL.format(i=i, radius=radius) for i, radius in enumerate(radii)]
    types = ["continuous"] * (len(steps) - 1) + [last]
    joints = [
        JOINT.format(i=i, before=i - 1, x=x, type=type_, upper=upper)
        for i, (x, type_) in enumerate(zip(steps, types, strict=True), 1)
    ]
    description = read_urdf(f'<robot name="r">{"".join(links)}{"".join(joints)}</robot>')
    return without_lasting_contacts(description, find_bodies(description, lambda _: None))


def of_catalogue(name: str) -> LoadedRobot:
    record = read_record(catalogue() / name, "catalogue")
    assert record is not None
    return load(record)


def drawn(loaded: LoadedRobot, link: str) -> list[tuple[coal.CollisionGeometry, coal.Transform3s]]:
    """Return the shapes of a link with all joints at zero: triangles, not hulls; placed by Pinocchio."""
    shapes = next(one.shapes for one in loaded.robot.description.links if one.name == link)
    model, data = loaded.robot.model, loaded.robot.data
    pin.framesForwardKinematics(model, data, np.zeros(model.nq))
    place = data.oMf[loaded.robot.frame_id(link)]
    meant = [shape for shape in shapes if shape.role == "collision"] or shapes
    poses = [place * pin.SE3(placement(shape.origin.xyz, shape.origin.rpy)) for shape in meant]
    return [
        (drawn_shape(loaded, shape), coal.Transform3s(pose.rotation, pose.translation))
        for shape, pose in zip(meant, poses, strict=True)
    ]


def touch(loaded: LoadedRobot, a: str, b: str) -> bool:
    request = coal.CollisionRequest()
    return any(
        coal.collide(*one, *other, request, coal.CollisionResult())
        for one, other in product(drawn(loaded, a), drawn(loaded, b))
    )


def test_links_that_overlap_at_every_configuration_are_left_out() -> None:
    # The centres of l0 and l2 are 0.1 m apart, those of l0 and l3 0.2 m to 0.4 m; the others never touch.
    found = balls([0.2, 0.01, 0.2, 0.1, 0.05], [0.0, 0.1, 0.3, 0.9])
    assert [pair for pair in found.pairs if pair.reason != "neighbours"] == [
        LinkPair("l0", "l2", False, "always"),
        LinkPair("l0", "l3", True),
        LinkPair("l0", "l4", True),
        LinkPair("l1", "l3", True),
        LinkPair("l1", "l4", True),
        LinkPair("l2", "l4", True),
    ]


@pytest.mark.parametrize(("upper", "reason"), [(0.99, "always"), (1.01, None)])
def test_a_hundredth_of_the_range_apart_is_enough_to_look(upper: float, reason: str | None) -> None:
    # l2 slides along z, away from l0: their balls part at 1 m.
    pairs = {(pair.a, pair.b): pair for pair in balls([0.5, 0.1, 0.5], [0.0, 0.0], "prismatic", upper).pairs}
    assert pairs["l0", "l2"].reason == reason


def test_samples_are_the_same_each_time() -> None:
    arm = [0.2, 0.1, 0.2, 0.1], [0.0, 0.15, 0.35]
    assert balls(*arm).pairs == balls(*arm).pairs


def test_a_robot_without_srdf_is_free_where_it_is() -> None:
    loaded = of_catalogue("spherical_wrist")
    found = bodies_of(loaded)
    chain = loaded.robot.chain(None, None)
    at_zero = np.zeros((1, len(chain)))
    assert {(pair.a, pair.b) for pair in found.pairs if pair.reason == "always"} == {("link_1", "link_3")}
    assert first_contacts(build_world(loaded.robot, chain, found).flat, at_zero) == [-1]
    looked_at = RobotBodies(found.bodies, tuple(LinkPair(pair.a, pair.b, True) for pair in found.pairs), ())
    assert first_contacts(build_world(loaded.robot, chain, looked_at).flat, at_zero) >= 0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ur5", "ur10", "so100", "z1"])
def test_a_catalogue_arm_is_in_collision_at_zero_only_if_its_shapes_are(name: str) -> None:
    loaded = of_catalogue(name)
    chain = loaded.robot.chain(None, None)
    world = build_world(loaded.robot, chain, bodies_of(loaded))
    distances = all_contacts(world.flat, np.zeros(len(chain)))[0]
    pairs = {(world.names[a], world.names[b]) for a, b in world.flat.pairs[distances < np.inf]}
    assert bool(pairs) == any(touch(loaded, a, b) for a, b in pairs) == (name in {"so100", "z1"})
