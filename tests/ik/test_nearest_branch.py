"""The nearest branch of one target at a time is the first that all branches of many targets begin with."""

import re
import sys
from concurrent.futures import ThreadPoolExecutor

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


def test_threads_that_call_it_at_once_share_its_memory_in_turns() -> None:
    machine, chain = catalogue_arm("ur5")
    Ts, seed = poses(machine, chain, draw(chain, 100)).matrices(), middle(chain)[0]
    form = closed_form(chain)
    assert form is not None
    nearest = nearest_branch(form, TOLERANCES)
    alone = [answered(nearest(T, seed)) for T in Ts]
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(4) as threads:
            together = list(threads.map(lambda _: [answered(nearest(T, seed)) for T in Ts], range(40)))
    finally:
        sys.setswitchinterval(interval)
    for answers in together:
        np.testing.assert_array_equal(answers, alone)


def answered(q: Array | None) -> Array:
    """Return what is there."""
    assert q is not None
    return q


@pytest.mark.parametrize("name", ["so101", "ur5"])
def test_numbers_that_are_none_get_no_answer(name: str) -> None:
    """Nor that of an earlier target, whose errors are still in the memory."""
    machine, chain = catalogue_arm(name)
    T, seed = poses(machine, chain, middle(chain)).matrices()[0], middle(chain)[0]
    form = closed_form(chain)
    assert form is not None
    nearest = nearest_branch(form, TOLERANCES)
    for wrong in (np.nan, np.inf):
        for part in (np.s_[:3, :3], np.s_[:3, 3], np.s_[1, 2]):
            broken = T.copy()
            broken[part] = wrong
            assert nearest(T, seed) is not None
            assert nearest(broken, seed) is None
    assert nearest(T, np.full_like(seed, np.nan)) is None


def test_wrong_shapes_are_refused() -> None:
    """They would be read, and written, beyond their ends."""
    chain = catalogue_arm("ur5")[1]
    form = closed_form(chain)
    assert form is not None
    nearest = nearest_branch(form)
    for T, seed in ((np.eye(3), np.zeros(6)), (np.eye(4), np.zeros(5)), (np.eye(4), np.zeros(7))):
        with pytest.raises(ValueError, match=re.escape("a target has the shape (4, 4), and a seed (6,); not (")):
            nearest(T, seed)


def test_what_it_is_not_for() -> None:
    """A free elbow needs an angle, and elimination more memory."""
    redundant = [(0.0, 0.5 * np.pi * sign, 0.4 * (i % 2 == 0), 0.0) for i, sign in enumerate((-1, 1, 1, -1, -1, 1, 0))]
    general = [(0.1 + 0.01 * i, 0.3 + 0.2 * i, 0.2, 0.0) for i in range(6)]
    for form in (closed_form(table_arm(redundant, "R" * 7)[1]), elimination(table_arm(general)[1])):
        assert form is not None
        with pytest.raises(ValueError, match="only for arms without a free elbow, in closed form"):
            nearest_branch(form)
