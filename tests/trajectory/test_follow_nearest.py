"""The configuration next to another one at a pose, and its rates, against Pinocchio and pseudo-inverses."""

import numpy as np
import pinocchio as pin
import pytest

from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.follow.kernels.nearest import nearest
from tests.robots import robot

TWIST = np.array([0.3, -0.2, 0.1, 0.4, 0.2, -0.5])
STEP = 1e-4


def judged(machine: RobotModel, chain: Chain, q: Array) -> tuple[pin.SE3, Array]:
    """Pinocchio's pose of the tip, and its Jacobian in the base's axes."""
    expansion, tip = machine.expansion(chain), machine.frame_id(chain.tip_frame)
    full = expansion.offset + expansion.matrix @ q
    J = pin.computeFrameJacobian(machine.model, machine.data, full, tip, pin.LOCAL_WORLD_ALIGNED)
    pin.framesForwardKinematics(machine.model, machine.data, full)
    return machine.data.oMf[tip].copy(), J @ expansion.matrix


@pytest.mark.parametrize("name", ["panda", "ur5"])
def test_it_is_exact_and_its_rates_are_the_shortest(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    start = np.array([0.1, -0.8, 0.2, -2.3, 0.1, 1.6, 0.8][: len(chain)])
    pose = judged(machine, chain, start + 0.02)[0]

    found = nearest(chain.flat, pose.translation, pose.rotation, TWIST, np.zeros(6), start)
    is_found, q, dq, ddq, sigma, span, change = found
    assert is_found
    judge, J = judged(machine, chain, q)
    assert np.abs(judge.homogeneous - pose.homogeneous).max() < 1e-12
    assert dq == pytest.approx(np.linalg.pinv(J) @ TWIST, abs=1e-11)
    assert sigma == pytest.approx(np.linalg.svd(J, compute_uv=False)[-1], abs=1e-12)
    assert span.T @ span == pytest.approx(np.linalg.pinv(J) @ J, abs=1e-10)
    rates = [np.linalg.pinv(judged(machine, chain, q + k * STEP * dq)[1]) @ TWIST for k in (-1, 1)]
    assert ddq == pytest.approx((rates[1] - rates[0]) / (2.0 * STEP), rel=1e-5, abs=1e-5)
    changes = [judged(machine, chain, q + k * STEP * dq)[1] for k in (-1, 1)]
    assert change == pytest.approx(np.linalg.norm(changes[1] - changes[0]) / (2.0 * STEP), rel=1e-6)


def test_what_is_out_of_reach_is_not_found() -> None:
    chain = robot("ur5").chain(None, None)
    assert not nearest(chain.flat, np.full(3, 9.0), np.eye(3), TWIST, np.zeros(6), np.full(6, 0.3))[0]
