"""Worked solutions of poses: what they end at is Pinocchio's, with a table or without one."""

import numpy as np
import pinocchio as pin
import pytest

from gelenk.dh.table_steps import forward_steps, placement_steps
from gelenk.dh.tables.from_chain import dh_from_chain
from gelenk.robot.arrays import Array
from gelenk.robot.robot import RobotModel
from tests.oracles.written import matrix, vector
from tests.robots import of_table, robot, rows, samples, swept

ARMS = ["planar_3r", "stanford", "scara", "panda", "ur5", "so100"]


def by_pinocchio(found: RobotModel, q: Array) -> pin.SE3:
    chain = found.chain(None, None)
    expansion = found.expansion(chain)
    data = found.model.createData()
    pin.framesForwardKinematics(found.model, data, expansion.offset + expansion.matrix @ q)
    base, tip = (data.oMf[found.frame_id(name)] for name in (chain.base_frame, chain.tip_frame))
    return base.inverse() * tip


@pytest.mark.parametrize("name", swept(ARMS))
@pytest.mark.parametrize("by_table", [True, False])
def test_the_product_ends_at_the_pose_of_pinocchio(name: str, by_table: bool) -> None:
    """To the ten digits that are shown; the products in between are those of the transforms that are shown."""
    found = robot(name)
    chain = found.chain(None, None)
    q = samples(chain, 1)[0]
    if by_table:
        steps = forward_steps(dh_from_chain(found.description, chain, "standard").table, q, "matrix")
    else:
        steps = placement_steps(chain.flat, q, "matrix")
    neighbours, products, pose = steps[-3:]
    expected = by_pinocchio(found, q)
    assert vector(pose.latex[0]) == pytest.approx(expected.translation, abs=1e-9)
    assert matrix(pose.latex[1]) == pytest.approx(expected.rotation, abs=1e-9)
    T = np.eye(4)
    for i in range(len(chain.flat.joints)):
        T = T @ matrix(neighbours.latex[i + by_table])
        assert matrix(products.latex[i]) == pytest.approx(T, abs=1e-8)


def test_item_20_in_both_notations_of_its_wrist() -> None:
    """The Stanford arm of the lecture, whose table is not that of the catalogue's axes."""
    quarter = np.pi / 2
    wrist = [(0.0, -quarter, 0.0, 0.0), (0.0, quarter, 0.0, 0.0), (0.0, 0.0, 0.263, 0.0)]
    first = [(0.0, -quarter, 0.412, 0.0), (0.0, quarter, 0.154, 0.0), (0.0203, 0.0, 0.0, -quarter)]
    arm = rows("standard", [*first, *wrist], "RRPRRR")
    q = np.array([0.2, 0.5, 0.6, -0.3, 0.7, 0.1])
    steps = forward_steps(arm, q, "zyz")
    pose, angles = steps[-2:]
    assert vector(pose.latex[0]) == pytest.approx([0.338967591045, 0.039977404438, 1.139083062081], abs=1e-9)
    phi, theta, psi = vector(angles.latex[-2])
    turned = pin.utils.rotate("z", phi) @ pin.utils.rotate("y", theta) @ pin.utils.rotate("z", psi)
    assert turned == pytest.approx(by_pinocchio(of_table(arm), q).rotation, abs=1e-9)
    assert r"d_{3} = q_{3} = 0.6" in steps[1].latex[3]
    assert r"\vartheta_{3}" not in steps[1].latex[3]
