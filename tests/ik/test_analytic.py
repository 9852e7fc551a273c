"""Closed forms in batches: what one target gets does not depend on the others, and tasks count as they are meant."""

from dataclasses import replace

import numpy as np
import pytest

from gelenk.ik.closed.closed_form import closed_form
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.search.words import DIRECTIONS
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.robot.poses import Poses
from tests.ik.arms import PLANAR, catalogue_arm, draw, poses, table_arm

HALF = np.pi / 2.0


@pytest.mark.quick(6)
@pytest.mark.parametrize("unreachable", range(10))
@pytest.mark.parametrize("name", ["planar_2r", "puma560"])
def test_unreachable_neighbours_take_no_solution_away(name: str, unreachable: int) -> None:
    """Also where there happen to be as many solutions as targets."""
    machine, chain = catalogue_arm(name)
    task = PLANAR if name == "planar_2r" else FULL_POSE
    one = poses(machine, chain, draw(chain, 1, seed=3))
    options = Options(task=task, every=True, respect_limits=False)
    alone = inverse_kinematics(machine, chain, one, np.zeros((1, len(chain))), options)
    far = np.full((unreachable, 3), 50.0)
    positions = np.concatenate((one.positions, far))
    rotations = np.concatenate((one.rotations, np.tile(np.eye(3), (unreachable, 1, 1))))
    together = inverse_kinematics(machine, chain, Poses(positions, rotations), np.zeros((1, len(chain))), options)
    np.testing.assert_array_equal(together.qs[: together.firsts[1]], alone.qs)
    assert together.complete is not None
    assert together.complete[0]


def test_a_tip_on_the_last_axis_leaves_that_joint_free() -> None:
    """For its position, whatever the target's orientation, which does not count."""
    _, chain = table_arm([(0.2, -HALF, 0.0, 0.3), (0.3, HALF, 0.1, 0.3), (0.0, 0.4, 0.2, 0.0)], "RRR")
    assert closed_form(chain, Task(("x", "y", "z"))) is None


@pytest.mark.parametrize("tool", [(HALF, 0.0), (-HALF, 0.0)])
def test_a_turn_about_what_the_arm_cannot_turn_about_is_no_task_for_a_closed_form(tool: tuple[float, float]) -> None:
    """The target's z lies in the plane of the arm: `rz` constrains nothing."""
    rows = [(0.4, 0.0, 0.0, 0.0), (0.3, 0.0, 0.0, 0.0), (0.2, tool[0], 0.0, tool[1])]
    _, chain = table_arm(rows, "RRR")
    assert closed_form(chain, Task(("x", "y", "rz"))) is None
    assert closed_form(chain) is not None


def test_a_position_that_does_not_tell_its_joints_is_none_to_begin_with() -> None:
    """A planar arm of two turns and a slide: its wrist's point moves in a plane only."""
    machine, chain = table_arm([(0.3, 0.0, 0.0, 0.3), (0.2, -HALF, 0.1, 0.0), (0.0, 0.0, 0.1, 0.0)], "RRP")
    targets = poses(machine, chain, np.array([[0.4, -0.8, 0.3], [1.2, 0.9, -0.2]]))
    options = Options(every=True, respect_limits=False)
    answer = inverse_kinematics(machine, chain, targets, np.zeros((1, 3)), options)
    searched = inverse_kinematics(
        machine, chain, targets, np.zeros((1, 3)), Options(respect_limits=False, max_iterations=40)
    )
    assert searched.statuses == ["solved"] * 2
    assert answer.statuses == ["solved"] * 2
    for i, q in enumerate(([0.4, -0.8, 0.3], [1.2, 0.9, -0.2])):
        own = answer.qs[answer.firsts[i] : answer.firsts[i + 1]] - q
        own[:, :2] -= 2.0 * np.pi * np.rint(own[:, :2] / (2.0 * np.pi))
        assert np.abs(own).max(axis=1).min() < 1e-6


def test_all_six_directions_are_a_whole_pose() -> None:
    rng = np.random.default_rng(8)
    rows = [tuple(rng.uniform(-0.5, 0.5, 4) * (1.0, 6.0, 1.0, 6.0)) for _ in range(6)]
    machine, chain = table_arm(rows, "RRRRRR")
    targets = poses(machine, chain, rng.uniform(-3.0, 3.0, (3, 6)))
    for method in ("auto", "analytic"):
        options = Options(task=Task(DIRECTIONS), method=method, every=True, respect_limits=False)
        answer = inverse_kinematics(machine, chain, targets, np.zeros((1, 6)), options)
        assert answer.form is not None
        assert answer.form.method == "elimination"


def test_analytic_gives_what_the_closed_form_gives_and_nothing_else() -> None:
    """A little out of reach, within loose tolerances: a search finds it, but no branch does."""
    machine, chain = catalogue_arm("puma560")
    targets = poses(machine, chain, np.zeros((1, 6)))
    targets.positions[0] *= 1.2 / np.linalg.norm(targets.positions[0])
    for tolerance in (0.05, 0.3, 1.0):
        options = Options(method="analytic", position_tolerance=tolerance, orientation_tolerance=tolerance)
        answer = inverse_kinematics(machine, chain, targets, np.zeros((1, 6)), options)
        assert (answer.codes >= 0).all()
        listed = inverse_kinematics(machine, chain, targets, np.zeros((1, 6)), replace(options, every=True))
        assert listed.complete == [len(listed.qs) > 0]
