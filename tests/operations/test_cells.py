"""The bodies of a cell on their way to another process."""

import numpy as np

from gelenk.collision.contact.kernels import nearest_pairs
from gelenk.collision.robot_bodies import find_bodies
from gelenk.operations.cells import CellBodies, read_cell_bodies
from tests.collision.arms import arm, obstacles


def test_another_process_sees_the_same_cell() -> None:
    robot = arm()
    here = CellBodies(find_bodies(robot.description, lambda _: None), obstacles(), (("jf", 0.05),))
    there = read_cell_bodies(here.to_bytes())
    qs = np.random.default_rng(0).uniform(-3.0, 3.0, (64, 4))
    cells = [one.cell(robot, robot.chain(None, None), 0.01) for one in (here, there)]
    for one, other in zip(*(nearest_pairs(cell.world.flat, qs) for cell in cells), strict=True):
        np.testing.assert_array_equal(one, other)
    plain = here.cell(robot, robot.chain(None, None), None)
    np.testing.assert_allclose(nearest_pairs(cells[0].world.flat, qs)[0], nearest_pairs(plain.world.flat, qs)[0] - 0.01)
    assert there.warnings == here.warnings
    assert cells[1].world.others == {"jf": 0.05}
