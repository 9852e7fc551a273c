"""The nearest branch of one target at a time is the first that all branches of many targets begin with."""

import numpy as np
import pytest

from gelenk.ik.closed.closed_form import closed_form, elimination
from gelenk.ik.closed.nearest_branch import nearest_branch
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from tests.ik.arms import catalogue_arm, draw, middle, poses, table_arm

TOLERANCES = 1e-5, 1e-5


@pytest.mark.quick(4)
@pytest.mark.parametrize("name", ["puma560", "ur5", "so101", "stanford", "kinova"])
@pytest.mark.parametrize("respect_limits", [True, False])
def test_the_nearest_of_all_branches(name: str, respect_limits: bool) -> None:
    """Wherever there is one; and none where all are beyond the limits, or the target beyond reach."""
    machine, chain = catalogue_arm(name)
    targets, seed = poses(machine, chain, draw(chain, 40)), middle(chain)[0]
    targets.positions[::4] *= 30.0
    form = closed_form(chain)
    assert form is not None
    table = form.solve(targets, seed[None], tolerances=TOLERANCES, respect_limits=respect_limits)
    nearest = nearest_branch(form, TOLERANCES, respect_limits)
    counts = np.diff(table.firsts)
    # Without limits the Stanford arm reaches everywhere.
    assert np.count_nonzero(counts) == (40 if name == "stanford" and not respect_limits else 30)
    for i, T in enumerate(targets.matrices()):
        q = nearest(T, seed)
        assert (q is None) == (counts[i] == 0)
        if q is not None:
            np.testing.assert_array_equal(q, table.qs[table.firsts[i]])
            assert_reached(machine, chain, q, T)


def assert_reached(machine: RobotModel, chain: Chain, q: Array, T: Array) -> None:
    """Pinocchio finds the tip at the target."""
    np.testing.assert_allclose(poses(machine, chain, q[None]).matrices()[0], T, rtol=0.0, atol=2.0 * TOLERANCES[0])


def test_what_it_is_not_for() -> None:
    """A free elbow needs an angle, and elimination more memory."""
    redundant = [(0.0, 0.5 * np.pi * sign, 0.4 * (i % 2 == 0), 0.0) for i, sign in enumerate((-1, 1, 1, -1, -1, 1, 0))]
    general = [(0.1 + 0.01 * i, 0.3 + 0.2 * i, 0.2, 0.0) for i in range(6)]
    for form in (closed_form(table_arm(redundant, "R" * 7)[1]), elimination(table_arm(general)[1])):
        assert form is not None
        with pytest.raises(ValueError, match="only for arms without a free elbow, in closed form"):
            nearest_branch(form)
